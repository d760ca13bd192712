// The running print in the status line, for the other tabs.
import { starting, tab } from "../state/store";
import { print, running } from "./print";

export function PrintWord() {
    const shown = print.value;
    if (!shown || !running.value || (tab.value === "print" && !starting.value)) return null;
    const at = shown.layer === null ? "" : ` layer ${shown.layer + 1} of ${shown.layers}`;
    return (
        <button
            class="link"
            onClick={() => {
                tab.value = "print";
                starting.value = false;
            }}
        >
            {shown.question ? "the printer waits for you" : `${shown.state}${at}`}
        </button>
    );
}
