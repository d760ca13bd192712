// The one message that the page shows when something went wrong.
import { signal } from "@preact/signals";
import { Failure } from "../server/http";

export interface Notice {
    text: string;
    kind: "error" | "done";
}

export const notice = signal<Notice | null>(null);

/** Shows a failure. Outdated requests and an absent server, which has a banner of its own, say nothing. */
export function report(error: unknown): void {
    if (error instanceof Failure && (error.outdated || error.status === 0)) return;
    const mistakes = error instanceof Failure ? error.mistakes.map((one) => one.text).join("; ") : "";
    notice.value = {
        text: mistakes || (error instanceof Error ? error.message : String(error)),
        kind: "error",
    };
}

let timer = 0;

/** Shows a short confirmation for a while. */
export function confirm_done(text: string): void {
    const mine: Notice = { text, kind: "done" };
    notice.value = mine;
    clearTimeout(timer);
    timer = window.setTimeout(() => {
        if (notice.value === mine) notice.value = null;
    }, 2500);
}
