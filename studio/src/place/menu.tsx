// The menu of things to put at a place: from the button, to be followed by a click, or at the place that was clicked.
import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Triple } from "../server/types";
import { job } from "../state/store";
import { placing, put_thing, type Thing, things } from "./things";

interface Opened {
    /** Where the menu opens, pixels of the window. */
    x: number;
    y: number;
    /** The place that was clicked; null: the next click says it. */
    at: Triple | null;
    /** Gets the focus back. */
    from: HTMLElement | null;
}

export const opened = signal<Opened | null>(null);

export function open_menu(x: number, y: number, at: Triple | null): void {
    opened.value = { x, y, at, from: document.activeElement as HTMLElement | null };
}

function close(): void {
    const from = opened.value?.from;
    opened.value = null;
    from?.focus();
}

function choose(thing: Thing): void {
    const at = opened.value?.at;
    close();
    if (at) put_thing(thing, at);
    else placing.value = thing;
}

const groups = [...new Set(things.map((one) => one.group))];

export function PlaceMenu() {
    const menu = useRef<HTMLDivElement>(null);
    const open = opened.value;
    const made = job.value;
    useEffect(() => {
        const box = menu.current;
        if (!open || !box) return;
        const { width, height } = box.getBoundingClientRect();
        box.style.setProperty("left", `${Math.max(4, Math.min(open.x, innerWidth - width - 4))}px`);
        box.style.setProperty("top", `${Math.max(4, Math.min(open.y, innerHeight - height - 4))}px`);
        box.querySelector<HTMLElement>("button:not([aria-disabled=true])")?.focus();
        const outside = (event: PointerEvent) => {
            if (!box.contains(event.target as Node)) opened.value = null;
        };
        addEventListener("pointerdown", outside, true);
        return () => removeEventListener("pointerdown", outside, true);
    }, [open]);
    if (!open || !made) return null;
    const on_key = (event: KeyboardEvent) => {
        const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
        if (event.key === "Escape" || event.key === "Tab") {
            event.preventDefault();
            close();
        } else if (step) {
            event.preventDefault();
            const items = [...menu.current!.querySelectorAll<HTMLElement>("[role=menuitem]")];
            const now = items.indexOf(document.activeElement as HTMLElement);
            items[(now + step + items.length) % items.length]!.focus();
        }
    };
    return (
        <div class="place-menu" role="menu" aria-label="Put here" ref={menu} onKeyDown={on_key}>
            {groups.map((group) => (
                <div key={group} role="group" aria-label={group}>
                    <p aria-hidden="true">{group}</p>
                    {things
                        .filter((one) => one.group === group)
                        .map((thing) => {
                            const lacks = made.axes ? thing.lacks(made) : "several parts are on the plate";
                            return (
                                <button
                                    key={thing.word}
                                    role="menuitem"
                                    tabIndex={-1}
                                    aria-disabled={lacks !== null}
                                    title={lacks ? `Not now: ${lacks}` : undefined}
                                    onClick={() => lacks ?? choose(thing)}
                                >
                                    {thing.label}
                                    {lacks && <small>{lacks}</small>}
                                </button>
                            );
                        })}
                </div>
            ))}
        </div>
    );
}

/** Opens the menu; while a thing waits for its place, says so. */
export function PlaceButton() {
    const waiting = placing.value;
    return waiting ? (
        <span class="placing" role="status">
            {waiting.label}: click the place
            <button
                class="quiet"
                onClick={() => {
                    placing.value = null;
                }}
            >
                cancel
            </button>
        </span>
    ) : (
        <button
            class="quiet"
            aria-haspopup="menu"
            title="Put something at a place of the part (or right click there)"
            onClick={(event) => {
                const box = event.currentTarget.getBoundingClientRect();
                open_menu(box.left, box.top - 330, null);
            }}
        >
            Put…
        </button>
    );
}
