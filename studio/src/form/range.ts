// The range of a slider. Accepted ranges are wide, so that of a length is taken round its value.
import type { Setting } from "../server/types";

export interface Range {
    lo: number;
    hi: number;
    log: boolean;
    whole: boolean;
}

const steps = 1000;
/** A range that spans more than this is logarithmic. */
const wide = 100;
const around = 8;

/** Returns null for numbers that need no slider: seeds, coordinates and the like. */
export function range_of(setting: Setting, value: number): Range | null {
    const { lo, hi } = setting;
    if (lo === null || hi === null || !Number.isFinite(value)) return null;
    const whole = setting.type === "integer";
    if (whole) return hi - lo <= 200 ? { lo, hi, log: false, whole } : null;
    if (lo < 0) return hi - lo <= 1000 ? { lo, hi, log: false, whole } : null;
    if (lo > 0 && hi / lo <= wide) return { lo, hi, log: false, whole };
    if (hi <= 1) return { lo, hi, log: false, whole };
    if (lo === 0)
        return { lo, hi: value > 0 ? Math.min(hi, 4 * value) : Math.min(hi, 10), log: false, whole };
    const least = Math.max(lo, value / around),
        most = Math.min(hi, value * around);
    return { lo: least, hi: most, log: most / least > wide / 10, whole };
}

export const inside = (range: Range, value: number): boolean =>
    value >= range.lo * 0.999 && value <= range.hi * 1.001;

export function to_slider(range: Range, value: number): number {
    const share = range.log
        ? Math.log(value / range.lo) / Math.log(range.hi / range.lo)
        : (value - range.lo) / (range.hi - range.lo);
    return Math.round(Math.max(0, Math.min(1, share)) * steps);
}

export function from_slider(range: Range, at: number): number {
    const share = at / steps;
    const value = range.log
        ? range.lo * (range.hi / range.lo) ** share
        : range.lo + (range.hi - range.lo) * share;
    if (range.whole) return Math.round(value);
    const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.max(range.hi - range.lo, 1e-6))));
    return range.log ? Number(value.toPrecision(3)) : Number(value.toFixed(Math.min(6, digits)));
}

export const slider_steps = steps;
