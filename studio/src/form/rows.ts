// Rows of a table as the knots of a curve: reading, writing, moving, and a drawn stroke made into few rows.

export type Knot = [position: number, value: number];

/** The knots of a value such as "0,1;10,3"; null when it is something else. */
export function knots_of(value: string | undefined): Knot[] | null {
    const rows = (value ?? "").split(";").map((row) => row.split(",").map(Number));
    return rows.every((row) => row.length === 2 && row.every(Number.isFinite)) && value?.trim()
        ? (rows as Knot[])
        : null;
}

export const knots_text = (knots: Knot[]) => knots.map((knot) => knot.join(",")).join(";");

/** What a curve shows: a little more than its knots. */
export interface Span {
    lo: Knot;
    hi: Knot;
}

export function span_of(knots: Knot[]): Span {
    const ends = [0, 1].map((k) => {
        const all = knots.map((one) => one[k]!);
        const lo = Math.min(...all),
            hi = Math.max(...all);
        // values leave room to be drawn into; positions less, as the curve goes on level beyond its ends
        const margin = Math.max(0.12 * (hi - lo), k ? 0.3 * Math.max(Math.abs(lo), Math.abs(hi)) : 0) || 1;
        return [lo - margin, hi + margin] as const;
    });
    return { lo: [ends[0]![0], ends[1]![0]], hi: [ends[0]![1], ends[1]![1]] };
}

/** A number as a row has it: to a thousandth of the span. */
export function rounded_knot(knot: Knot, span: Span): Knot {
    return knot.map((value, k) => {
        const digits = Math.max(0, Math.ceil(-Math.log10((span.hi[k]! - span.lo[k]!) / 1000)));
        return Number(value.toFixed(Math.min(digits, 9))) + 0;
    }) as Knot;
}

/** Moves a knot; it stays between its neighbours. */
export function moved(knots: Knot[], index: number, to: Knot, span: Span): Knot[] {
    const gap = (span.hi[0] - span.lo[0]) / 1000;
    const lo = index > 0 ? knots[index - 1]![0] + gap : -Infinity;
    const hi = index + 1 < knots.length ? knots[index + 1]![0] - gap : Infinity;
    const at = rounded_knot([Math.max(lo, Math.min(hi, to[0])), to[1]], span);
    return knots.map((one, i) => (i === index ? at : one));
}

/** The value of the curve between its knots, and beyond them that of the ends. */
export function value_at(knots: Knot[], position: number): number {
    const next = knots.findIndex((one) => one[0] >= position);
    if (next < 0) return knots.at(-1)![1];
    if (next === 0) return knots[0]![1];
    const [a, b] = [knots[next - 1]!, knots[next]!];
    return a[1] + ((b[1] - a[1]) * (position - a[0])) / (b[0] - a[0]);
}

/** Knots of a stroke that were drawn from left to right or back, with those outside it: no more than needed. */
export function drawn(knots: Knot[], stroke: Knot[], span: Span): Knot[] {
    const along = [...stroke].sort((a, b) => a[0] - b[0]);
    const gap = (span.hi[0] - span.lo[0]) / 200;
    const spaced = along.filter((one, i) => i === 0 || i === along.length - 1 || one[0] - along[i - 1]![0] > 0);
    const thinned: Knot[] = [];
    for (const one of spaced) if (!thinned.length || one[0] - thinned.at(-1)![0] >= gap) thinned.push(one);
    if (thinned.length < 2) return knots;
    const lo = thinned[0]![0],
        hi = thinned.at(-1)![0];
    const middle = simplified(thinned, 0.02 * (span.hi[1] - span.lo[1])).map((one) => rounded_knot(one, span));
    return [...knots.filter((one) => one[0] < lo - gap), ...middle, ...knots.filter((one) => one[0] > hi + gap)];
}

/** Ramer, Douglas and Peucker, with distances along the value's axis. */
function simplified(line: Knot[], tolerance: number): Knot[] {
    const first = line[0]!,
        last = line.at(-1)!;
    let worst = tolerance;
    let at = 0;
    for (let i = 1; i + 1 < line.length; ++i) {
        const off = Math.abs(line[i]![1] - value_at([first, last], line[i]![0]));
        if (off > worst) {
            worst = off;
            at = i;
        }
    }
    if (!at) return [first, last];
    return [...simplified(line.slice(0, at + 1), tolerance).slice(0, -1), ...simplified(line.slice(at), tolerance)];
}
