// Points of the recipe and points of the job: a part that is turned takes what stands in its recipe with it.
import type { Job, Triple } from "../server/types";

/** Returns null where a point of the recipe has several places, or none. */
export function to_job(made: Job, p: Triple): Triple | null {
    return made.axes && (made.axes.map((row) => row[0] * p[0] + row[1] * p[1] + row[2] * p[2]) as Triple);
}

export function to_recipe(made: Job, p: Triple): Triple | null {
    const rows = made.axes;
    // the inverse of an orthogonal matrix is its transpose
    return rows && ([0, 1, 2].map((k) => rows.reduce((sum, row, i) => sum + row[k]! * p[i]!, 0)) as Triple);
}

export function size_of(made: Job): number {
    return Math.hypot(...made.bounds.hi.map((one, k) => one - made.bounds.lo[k]!));
}

/** A coordinate as a recipe has it: to a ten-thousandth of the part's size. */
export function rounded(made: Job, value: number): number {
    const digits = Math.max(0, Math.min(4, Math.floor(4 - Math.log10(Math.max(size_of(made), 1e-3)))));
    return Number(value.toFixed(digits)) + 0; // no -0
}
