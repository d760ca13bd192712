// The server's events: progress, outputs, and whether it is there at all.
import { signal } from "@preact/signals";
import type { News } from "./analysis";
import { with_token } from "./http";
import { session } from "./token";
import type { Output, Print, PrintMessage, Progress, Sending } from "./types";

/** Whether the line to the server is broken. EventSource tries again by itself. */
export const away = signal(false);

export interface Listener {
    /** The server is there again after it was away: it may have lost its jobs. */
    back(): void;
    progress(progress: Progress): void;
    output(output: Output): void;
    print(print: Print): void;
    print_message(message: PrintMessage): void;
    analysis(news: News): void;
    sending(sending: Sending): void;
}

/** How long a closed line stays closed until it is opened anew, ms. */
const wait = 2000;

export function listen(listener: Listener): void {
    const stream = new EventSource(with_token(`/api/events?session=${session}`));
    stream.addEventListener("hello", () => {
        if (!away.value) return;
        away.value = false;
        listener.back();
    });
    stream.addEventListener("progress", (event) => listener.progress(JSON.parse(event.data) as Progress));
    stream.addEventListener("output", (event) => listener.output(JSON.parse(event.data) as Output));
    stream.addEventListener("print", (event) => listener.print(JSON.parse(event.data) as Print));
    stream.addEventListener("print_message", (event) =>
        listener.print_message(JSON.parse(event.data) as PrintMessage),
    );
    stream.addEventListener("analysis", (event) => listener.analysis(JSON.parse(event.data) as News));
    stream.addEventListener("sending", (event) => listener.sending(JSON.parse(event.data) as Sending));
    stream.addEventListener("error", () => {
        away.value = true;
        if (stream.readyState !== EventSource.CLOSED) return;
        setTimeout(() => listen(listener), wait); // the server answered with an error: open a new line
    });
}
