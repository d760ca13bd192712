// A value that is being typed: it is sent when typing pauses, and stays until the field loses the focus.
import { useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";

/** A pause of this length ends a word, ms. */
const pause = 450;

export interface Typed {
    shown: string;
    input(next: string): void;
    /** Enter, or the field loses the focus. */
    leave(): void;
}

export function use_typed(value: string, send: (value: string) => void): Typed {
    const draft = useSignal<string | null>(null);
    const timer = useRef(0);
    const sender = useRef(send);
    sender.current = send;
    const last = useRef(value);
    if (draft.value === null) last.current = value;
    const commit = () => {
        clearTimeout(timer.current);
        if (draft.value === null || draft.value === last.current) return;
        last.current = draft.value;
        sender.current(draft.value);
    };
    useEffect(() => () => clearTimeout(timer.current), []);
    return {
        shown: draft.value ?? value,
        input: (next) => {
            draft.value = next;
            clearTimeout(timer.current);
            timer.current = window.setTimeout(commit, pause);
        },
        leave: () => {
            commit();
            draft.value = null;
        },
    };
}
