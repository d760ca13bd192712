// The window of the layer pane: which part of the plane it shows, and how large.
import { signal } from "@preact/signals";
import type { Window } from "../server/api";
import type { Job } from "../server/types";

export interface Frame {
    /** Middle of the window, mm, and its scale, screen pixels a mm. */
    x: number;
    y: number;
    scale: number;
}

/** Null: all of the job, as large as the pane allows. */
export const frame = signal<Frame | null>(null);
/** Size of the pane in screen pixels. */
export const pane = signal({ width: 1, height: 1 });

const most_scale = 4000;

export function whole(made: Job): Frame {
    const { lo, hi } = made.bounds;
    const width = Math.max(1e-3, hi[0] - lo[0]),
        height = Math.max(1e-3, hi[1] - lo[1]);
    const scale = 0.94 * Math.min(pane.value.width / width, pane.value.height / height);
    return { x: (lo[0] + hi[0]) / 2, y: (lo[1] + hi[1]) / 2, scale };
}

export const current = (made: Job): Frame => frame.value ?? whole(made);

/** The window that the pane shows, mm. */
export function window_of({ x, y, scale }: Frame): Window {
    const w = pane.value.width / scale / 2,
        h = pane.value.height / scale / 2;
    return { x0: x - w, y0: y - h, x1: x + w, y1: y + h };
}

/** Zooms about a point of the pane, in screen pixels from its upper left corner. */
export function zoom_about(made: Job, px: number, py: number, factor: number): void {
    const now = current(made);
    const least = whole(made).scale * 0.5;
    const scale = Math.max(least, Math.min(most_scale, now.scale * factor));
    const dx = px - pane.value.width / 2,
        dy = pane.value.height / 2 - py;
    frame.value = { x: now.x + dx / now.scale - dx / scale, y: now.y + dy / now.scale - dy / scale, scale };
}

export function pan(made: Job, dx: number, dy: number): void {
    const now = current(made);
    frame.value = { ...now, x: now.x - dx / now.scale, y: now.y + dy / now.scale };
}

/** The place in mm of a point of the pane. */
export function place_of(made: Job, px: number, py: number): [number, number] {
    const { x, y, scale } = current(made);
    return [x + (px - pane.value.width / 2) / scale, y - (py - pane.value.height / 2) / scale];
}
