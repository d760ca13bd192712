// The temperatures of a print over its time, for the curve.
import { signal } from "@preact/signals";
import type { Print, Temperatures } from "../server/types";

export interface Sample extends Temperatures {
    /** Since the machine was connected, s. */
    at: number;
}

export const samples = signal<Sample[]>([]);

/** More samples than a curve has pixels are of no use: then every second one goes. */
const most = 1200;
/** Samples are so far apart at least, s. Grows with the print. */
let apart = 1;

export function forget_temperatures(): void {
    samples.value = [];
    apart = 1;
}

export function note_temperatures({ temperatures, seconds, state }: Print): void {
    if (!temperatures || state === "connecting") return;
    const known = samples.value;
    if (known.length && seconds < known[known.length - 1]!.at + apart) return;
    const all = [...known, { at: seconds, ...temperatures }];
    if (all.length > most) {
        apart *= 2;
        samples.value = all.filter((_, i) => i % 2 === 0);
    } else {
        samples.value = all;
    }
}
