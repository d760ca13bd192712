// A handle as it is drawn: a dot in the middle of a ring. The pointer drags the dot.
import { useRef } from "preact/hooks";
import type { Job, Triple } from "../server/types";
import { chosen, type Handle, handles, move, remove } from "./handles";

interface Props {
    handle: Handle;
    held: boolean;
    take: (element: HTMLElement | null) => void;
    /** Moves the handle under a point, pixels from the upper left corner of the marks. */
    drag: (x: number, y: number) => void;
    on_key: (event: KeyboardEvent) => void;
}

/** Movements of less than this are a click, px. */
const slack = 3;

export function Mark({ handle, held, take, drag, on_key }: Props) {
    const from = useRef<{ x: number; y: number; moved: boolean } | null>(null);
    const press = (event: PointerEvent) => {
        if (event.button !== 0) return;
        event.stopPropagation();
        (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
        from.current = { x: event.clientX, y: event.clientY, moved: false };
    };
    const pull = (event: PointerEvent) => {
        const begun = from.current;
        if (!begun) return;
        if (!begun.moved && Math.hypot(event.clientX - begun.x, event.clientY - begun.y) < slack) return;
        begun.moved = true;
        const room = (event.currentTarget as HTMLElement).closest(".marks")!.getBoundingClientRect();
        drag(event.clientX - room.left, event.clientY - room.top);
    };
    const release = () => {
        const clicked = from.current?.moved === false;
        from.current = null;
        if (clicked) chosen.value = held ? null : handle.id;
    };
    return (
        <div class={`mark ${handle.tone}${held ? " chosen" : ""}`} ref={take}>
            {handle.reach > 0 && <i />}
            <button
                title={`${handle.title}: drag to move, click for its keys`}
                aria-label={`${handle.title}. Arrow keys and Page up and down move it, Delete removes it.`}
                aria-pressed={held}
                onPointerDown={press}
                onPointerMove={pull}
                onPointerUp={release}
                onPointerCancel={() => {
                    from.current = null;
                }}
                onKeyDown={on_key}
            />
        </div>
    );
}

/** Arrow keys move along x and y, Page up and down along z, Shift by a tenth; Enter opens the card. */
export function move_by_key(made: Job, handle: Handle, event: KeyboardEvent): void {
    const step = event.shiftKey ? 0.1 : 1; // mm
    const steps: Record<string, Triple> = {
        ArrowLeft: [-step, 0, 0],
        ArrowRight: [step, 0, 0],
        ArrowDown: [0, -step, 0],
        ArrowUp: [0, step, 0],
        PageDown: [0, 0, -step],
        PageUp: [0, 0, step],
    };
    const by = steps[event.key];
    const others: Record<string, () => void> = {
        Delete: () => remove(handle),
        Enter: () => {
            chosen.value = handle.id;
        },
        Escape: () => {
            chosen.value = null;
        },
    };
    const act = by
        ? () => {
              const now = handles.value.find((one) => one.id === handle.id) ?? handle;
              move(made, now, now.at.map((one, k) => one + by[k]!) as Triple);
          }
        : others[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
}
