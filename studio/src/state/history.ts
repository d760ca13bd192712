// Undo and redo: a stack of texts. Quick changes of the same key are one step.
import { computed, signal } from "@preact/signals";

interface Step {
    text: string;
    /** What the step changed, so that a slider's way is one step. */
    what: string;
    at: number;
}

const past = signal<Step[]>([]);
const future = signal<string[]>([]);
const most = 200;
/** Changes of the same thing within this time are one step, ms. */
const together = 1500;

export const can_undo = computed(() => past.value.length > 0);
export const can_redo = computed(() => future.value.length > 0);

export function remember(before: string, what: string): void {
    const last = past.value.at(-1);
    const now = Date.now();
    future.value = [];
    if (last && last.what === what && now - last.at < together) {
        last.at = now;
        return;
    }
    past.value = [...past.value, { text: before, what, at: now }].slice(-most);
}

/** Returns the text before the last step; null when there is none. */
export function step_back(now: string): string | null {
    const last = past.value.at(-1);
    if (!last) return null;
    past.value = past.value.slice(0, -1);
    future.value = [...future.value, now];
    return last.text;
}

export function step_forward(now: string): string | null {
    const next = future.value.at(-1);
    if (next === undefined) return null;
    future.value = future.value.slice(0, -1);
    past.value = [...past.value, { text: now, what: "", at: 0 }];
    return next;
}
