// How toolpaths look: coloured by role, speed or width, with travel or without.
import { computed, signal } from "@preact/signals";
import type { Path } from "../server/types";
import { colour_on_scale } from "../shell/colour_scale";
import { role_colour } from "./roles";
import { lines } from "./shown_layer";

export type PathColour = "role" | "speed" | "width";

export const path_colour = signal<PathColour>("role");
export const shows_travel = signal(false);

/** The least and the greatest of the figure that colours show. */
export interface Range {
    lo: number;
    hi: number;
}

export interface PathLook {
    colour: PathColour;
    range: Range | null;
    travel: boolean;
}

const figures = (path: Path, of: "speed" | "width"): number[] =>
    (of === "speed" ? path.speeds : path.widths) ?? [path[of]];

/** Over all paths of the layer that is shown; null where colours show no figure. */
export const path_range = computed<Range | null>(() => {
    const of = path_colour.value;
    const paths = lines.value?.paths?.paths;
    if (of === "role" || !paths?.length) return null;
    let lo = Infinity,
        hi = -Infinity;
    for (const path of paths) {
        for (const value of figures(path, of)) {
            lo = Math.min(lo, value);
            hi = Math.max(hi, value);
        }
    }
    return { lo, hi };
});

export const path_look = computed<PathLook>(() => ({
    colour: path_colour.value,
    range: path_range.value,
    travel: shows_travel.value,
}));

/** Colours are told apart in so many steps, so that paths of one colour can be drawn together. */
const steps = 48;

/** The colour of a segment of a path. */
export function segment_colour(path: Path, segment: number, { colour, range }: PathLook): string {
    if (colour === "role" || !range) return role_colour(path.role);
    const all = figures(path, colour);
    const value = all.length > 1 ? all[segment]! : all[0]!;
    const share = range.hi > range.lo ? (value - range.lo) / (range.hi - range.lo) : 1;
    return colour_on_scale(Math.round(share * steps) / steps);
}
