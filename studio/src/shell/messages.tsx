// The banner of an absent server, and the one message of what went wrong.
import { away } from "../server/events";
import { sending } from "../start/take_model";
import { notice } from "../state/notices";

export function Messages() {
    const shown = notice.value;
    return (
        <div class="messages">
            {away.value && (
                <div class="banner" role="alert">
                    The server is away. The page goes on as soon as it is back.
                </div>
            )}
            {sending.value && (
                <div class="notice done" role="status">
                    Sending {sending.value}…
                </div>
            )}
            {shown && (
                <div class={`notice ${shown.kind}`} role={shown.kind === "error" ? "alert" : "status"}>
                    <span>{shown.text}</span>
                    <button
                        class="quiet"
                        aria-label="Close the message"
                        onClick={() => {
                            notice.value = null;
                        }}
                    >
                        ×
                    </button>
                </div>
            )}
        </div>
    );
}
