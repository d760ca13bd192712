// The cut through the part: an axis, a place along it, and the side that is taken away.
import { computed, signal } from "@preact/signals";
import type { Job, Triple } from "../server/types";
import { plane_of } from "../state/heights";
import { job, layer } from "../state/store";

export type CutAxis = "none" | "x" | "y" | "z" | "layer";

export const cut_axis = signal<CutAxis>("none");
/** Position of the cut as a share of the part's size. */
export const cut_share = signal(0.5);
/** Whether the side of smaller coordinates is taken away. */
export const cut_below = signal(false);

export interface Cut {
    /** -1: no cut. */
    axis: number;
    at: number;
    below: boolean;
}

export const no_cut: Cut = { axis: -1, at: 0, below: false };

export function cut_of(made: Job | null): Cut {
    const chosen = cut_axis.value;
    if (!made || chosen === "none") return no_cut;
    if (chosen === "layer") return { axis: 2, at: plane_of(made, layer.value), below: false };
    const axis = "xyz".indexOf(chosen);
    const lo = made.bounds.lo[axis]!,
        hi = made.bounds.hi[axis]!;
    return { axis, at: lo + (hi - lo) * cut_share.value, below: cut_below.value };
}

export const cut = computed(() => cut_of(job.value));

/** What the cut leaves of a box. */
export function clipped(lo: Triple, hi: Triple, by: Cut): { lo: Triple; hi: Triple } {
    const rest = { lo: [...lo] as Triple, hi: [...hi] as Triple };
    if (by.axis < 0) return rest;
    const at = Math.max(lo[by.axis]!, Math.min(hi[by.axis]!, by.at));
    (by.below ? rest.lo : rest.hi)[by.axis] = at;
    return rest;
}
