// The picture of the layer: zoom about the pointer, drag to pan.
import { effect, signal, type Signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { shown_fault, wanted_place } from "../check/faults";
import { get_contours, get_paths } from "../server/api";
import { LayerMarks } from "../place/layer_marks";
import { open_menu } from "../place/menu";
import { placing, put_thing } from "../place/things";
import { Latest } from "../server/latest";
import type { Job, Triple } from "../server/types";
import { plane_of } from "../state/heights";
import { job, layer } from "../state/store";
import { draw, type Lines } from "./draw";
import { load_mask, type Picture } from "./mask";
import { path_look } from "./path_look";
import { lines, picture } from "./shown_layer";
import { current, type Frame, frame, pan, pane, place_of, zoom_about } from "./window";

export type LayerMode = "mask" | "contours" | "paths";

/** What the user chose to see; null: what suits the machine. */
export const wanted_mode = signal<LayerMode | null>(null);

export function mode_of(made: Job): LayerMode {
    const usual = made.process === "filament" ? "paths" : made.display ? "mask" : "contours";
    const wanted = wanted_mode.value ?? usual;
    return wanted === "paths" && made.process !== "filament" ? "contours" : wanted;
}

/** Shows another picture. The one before gives its memory back: the drawing no longer uses it. */
function show_picture(next: Picture | null): void {
    const before = picture.peek();
    picture.value = next;
    before?.bitmap.close();
}

async function load_lines(made: Job, k: number, mode: LayerMode, signal: AbortSignal): Promise<Lines> {
    if (mode === "paths") return { job: made.job, layer: k, paths: await get_paths(made, k, signal) };
    const [part, supports] = await Promise.all([
        get_contours(made, k, "part", signal),
        made.supports ? get_contours(made, k, "supports", signal) : null,
    ]);
    return { job: made.job, layer: k, contours: { part, supports } };
}

/** A layer that takes longer is given up for another one, ms: toolpaths may take seconds. */
const patience = 300;
/** Lines that take longer are preceded by the layer's mask, ms. */
const soon = 200;

/** Shows the mask of a layer after a while, unless its lines came before. */
async function show_before(lines_come: Promise<unknown>, made: Job, k: number, shown: Frame, signal: AbortSignal) {
    let came = false;
    const end = () => {
        came = true;
    };
    lines_come.then(end, end);
    await new Promise((resolve) => setTimeout(resolve, soon));
    if (came || signal.aborted) return;
    const mask = await load_mask(made, k, shown, signal);
    if (came || signal.aborted) return mask.bitmap.close();
    show_picture(mask);
    lines.value = null;
}

function watch_layer(): () => void {
    const latest = new Latest(patience);
    const stop = effect(() => {
        const made = job.value;
        if (!made || pane.value.width < 8) return;
        const k = layer.value;
        const mode = mode_of(made);
        const shown = current(made);
        if (mode === "mask") {
            latest.run(async (signal) => {
                show_picture(await load_mask(made, k, shown, signal));
                lines.value = null;
            });
        } else if (lines.peek()?.job !== made.job || lines.peek()?.layer !== k || !lines.peek()?.[mode]) {
            latest.run(async (signal) => {
                const lines_come = load_lines(made, k, mode, signal);
                show_before(lines_come, made, k, shown, signal).catch(() => {}); // the lines' fault is told
                lines.value = await lines_come;
                show_picture(null);
            });
        }
    });
    return () => {
        stop();
        latest.cancel();
    };
}

function watch_drawing(canvas: HTMLCanvasElement): () => void {
    let asked = 0;
    const stop = effect(() => {
        const made = job.value;
        if (!made) return;
        const fault = shown_fault.value;
        const mark = fault?.place.layer === layer.value ? fault.place.at_mm : null;
        void pane.value;
        const drawing = {
            job: made,
            frame: current(made),
            picture: picture.value,
            lines: lines.value,
            look: path_look.value,
            mark: mark && ([mark[0], mark[1]] as [number, number]),
        };
        cancelAnimationFrame(asked);
        asked = requestAnimationFrame(() => draw(canvas, drawing));
    });
    return () => {
        stop();
        cancelAnimationFrame(asked);
    };
}

/** A part of another size is shown as a whole. */
function watch_sizes(): () => void {
    let before: number[] = [];
    return effect(() => {
        const made = job.value;
        if (!made) return;
        const size = [0, 1].map((k) => made.bounds.hi[k]! - made.bounds.lo[k]!);
        const same = before.every((one, k) => Math.abs(size[k]! / one - 1) < 0.25);
        before = size;
        if (!same) frame.value = null;
    });
}

function watch_places(): () => void {
    return effect(() => {
        const place = wanted_place.value;
        if (!place) return;
        frame.value = {
            x: place.x,
            y: place.y,
            scale: Math.min(pane.peek().width, pane.peek().height) / place.across,
        };
    });
}

function watch_pointer(room: HTMLElement, pointer: Signal<[number, number] | null>): () => void {
    const held = new Map<number, [number, number]>();
    const local = (event: MouseEvent): [number, number] => {
        const box = room.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
    };
    const spread = () => {
        const [a, b] = [...held.values()];
        return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
    };
    const listeners: Record<string, (event: PointerEvent) => void> = {
        pointerdown: (event) => {
            held.set(event.pointerId, local(event));
            room.setPointerCapture(event.pointerId);
        },
        pointermove: (event) => {
            const made = job.value;
            if (!made) return;
            const [x, y] = local(event);
            pointer.value = place_of(made, x, y);
            const before = held.get(event.pointerId);
            if (!before) return;
            const wide = spread();
            held.set(event.pointerId, [x, y]);
            if (held.size === 1) pan(made, x - before[0], y - before[1]);
            else if (wide > 0) zoom_about(made, x, y, spread() / wide);
        },
        pointerup: (event) => {
            held.delete(event.pointerId);
        },
        pointercancel: (event) => {
            held.delete(event.pointerId);
        },
        pointerleave: () => {
            pointer.value = null;
        },
    };
    const wheel = (event: WheelEvent) => {
        event.preventDefault();
        if (job.value) zoom_about(job.value, ...local(event), Math.exp(-event.deltaY * 0.0016));
    };
    for (const [name, listener] of Object.entries(listeners))
        room.addEventListener(name, listener as EventListener);
    room.addEventListener("wheel", wheel, { passive: false });
    return () => {
        for (const [name, listener] of Object.entries(listeners))
            room.removeEventListener(name, listener as EventListener);
        room.removeEventListener("wheel", wheel);
    };
}

/** A right click opens the menu of what can be put there; a click puts what waits for a place. */
function watch_placing(room: HTMLElement): () => void {
    const place_of_event = (made: Job, event: MouseEvent): Triple => {
        const box = room.getBoundingClientRect();
        return [...place_of(made, event.clientX - box.left, event.clientY - box.top), plane_of(made, layer.value)];
    };
    const open = (event: MouseEvent) => {
        event.preventDefault();
        if (job.value) open_menu(event.clientX, event.clientY, place_of_event(job.value, event));
    };
    const click = (event: MouseEvent) => {
        if (job.value && placing.value) put_thing(placing.value, place_of_event(job.value, event));
    };
    room.addEventListener("contextmenu", open);
    room.addEventListener("click", click);
    return () => {
        room.removeEventListener("contextmenu", open);
        room.removeEventListener("click", click);
    };
}

function on_key(made: Job, event: KeyboardEvent): void {
    const step = event.shiftKey ? 8 : 40;
    const { width, height } = pane.value;
    const moves: Record<string, () => void> = {
        ArrowLeft: () => pan(made, step, 0),
        ArrowRight: () => pan(made, -step, 0),
        ArrowUp: () => pan(made, 0, step),
        ArrowDown: () => pan(made, 0, -step),
        "+": () => zoom_about(made, width / 2, height / 2, 1.3),
        "=": () => zoom_about(made, width / 2, height / 2, 1.3),
        "-": () => zoom_about(made, width / 2, height / 2, 1 / 1.3),
        Home: () => {
            frame.value = null;
        },
    };
    const move = moves[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move();
}

export function LayerPicture({ made, pointer }: { made: Job; pointer: Signal<[number, number] | null> }) {
    const room = useRef<HTMLDivElement>(null);
    const canvas = useRef<HTMLCanvasElement>(null);
    useEffect(() => {
        const measured = room.current!;
        const measure = () => {
            pane.value = { width: measured.clientWidth, height: measured.clientHeight };
        };
        frame.value = null;
        const watcher = new ResizeObserver(measure);
        measure();
        watcher.observe(measured);
        const stops = [
            watch_sizes(),
            watch_layer(),
            watch_drawing(canvas.current!),
            watch_places(),
            watch_pointer(room.current!, pointer),
            watch_placing(room.current!),
        ];
        return () => {
            watcher.disconnect();
            for (const stop of stops) stop();
        };
    }, []);
    const middle = () => [pane.value.width / 2, pane.value.height / 2] as const;
    return (
        <div class="layer-picture">
            <div
                class="layer-room"
                ref={room}
                tabIndex={0}
                role="application"
                onKeyDown={(event) => on_key(made, event)}
                aria-label={`Picture of layer ${layer.value + 1}. Arrow keys move it, plus and minus zoom, Home fits it.`}
            >
                <canvas ref={canvas} aria-hidden="true" />
            </div>
            <LayerMarks />
            <div class="zoom-buttons">
                <button
                    title="Larger (+)"
                    aria-label="Larger"
                    onClick={() => zoom_about(made, ...middle(), 1.5)}
                >
                    +
                </button>
                <button
                    title="Smaller (-)"
                    aria-label="Smaller"
                    onClick={() => zoom_about(made, ...middle(), 1 / 1.5)}
                >
                    −
                </button>
                <button
                    title="Show the whole layer (Home)"
                    onClick={() => {
                        frame.value = null;
                    }}
                >
                    fit
                </button>
            </div>
        </div>
    );
}
