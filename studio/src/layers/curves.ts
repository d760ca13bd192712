// Figures of the layers over the height: which one is shown, and how it is loaded.
import { effect, signal, untracked } from "@preact/signals";
import { get_curve, get_islands, get_times } from "../server/api";
import { Latest } from "../server/latest";
import type { Curve, Islands, Job, Times } from "../server/types";
import { slab_of } from "../state/heights";
import { job } from "../state/store";
import { after_layer } from "./layer_first";

export type CurveChoice = "area" | "islands" | "time";

export const curve_choice = signal<CurveChoice>("area");

export const curve = signal<{ job: Job; curve: Curve } | null>(null);

/** The islands or the times that are chosen; null while none are there. */
export const counted = signal<{ job: Job; islands?: Islands; times?: Times } | null>(null);

/** Whether the time of a layer is known: of beads by their moves, of resin by its exposures. */
export const has_times = (made: Job) => made.process === "filament" || made.process === "resin";

/** Volume of part and supports by the curve, mm3. */
export function volume_of({ job: made, curve: got }: { job: Job; curve: Curve }): {
    part: number;
    supports: number;
} {
    const sum = (areas: number[]) =>
        areas.reduce((all, area, i) => {
            const first = i * got.layers_a_value;
            const next = Math.min(made.layers.count, first + got.layers_a_value);
            const thick =
                slab_of(made, next - 1).begin + slab_of(made, next - 1).height - slab_of(made, first).begin;
            return all + area * thick;
        }, 0);
    return { part: sum(got.area_mm2), supports: sum(got.support_area_mm2) };
}

/** Numbers of values that times of beads are asked for one after the other: each costs a layer's toolpaths. */
const finer = [12, 48, 192];
/** Exposures cost nothing. */
const all_at_once = [400];

async function load_counted(made: Job, choice: CurveChoice, signal: AbortSignal): Promise<void> {
    if (choice === "islands") counted.value = { job: made, islands: await get_islands(made, signal) };
    if (choice !== "time") return;
    if (!has_times(made)) counted.value = null;
    else await load_times(made, signal);
}

async function load_times(made: Job, signal: AbortSignal): Promise<void> {
    for (const values of made.process === "resin" ? all_at_once : finer) {
        const times = await get_times(made, values, signal);
        counted.value = { job: made, times };
        if (times.layers_a_value === 1) return;
    }
}

function watch_counted(): () => void {
    const latest = new Latest(0);
    let call_off = () => {};
    const stop = effect(() => {
        const made = job.value;
        const choice = curve_choice.value;
        call_off();
        if (choice === "area" || !made) {
            latest.cancel();
            return;
        }
        call_off = untracked(() =>
            after_layer(made, () => latest.run((signal) => load_counted(made, choice, signal))),
        );
    });
    return () => {
        stop();
        call_off();
        latest.cancel();
    };
}

function watch_areas(): () => void {
    const latest = new Latest();
    let call_off = () => {};
    const stop = effect(() => {
        const made = job.value;
        call_off();
        if (!made) {
            curve.value = null;
            return;
        }
        call_off = untracked(() =>
            after_layer(made, () =>
                latest.run(async (signal) => {
                    curve.value = { job: made, curve: await get_curve(made, signal) };
                }),
            ),
        );
    });
    return () => {
        stop();
        call_off();
        latest.cancel();
    };
}

export function load_curves(): () => void {
    const stops = [watch_areas(), watch_counted()];
    return () => {
        for (const stop of stops) stop();
    };
}
