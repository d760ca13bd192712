// Loads the colours of the part that is shown.
import { effect } from "@preact/signals";
import { get_modulus, get_numbers, get_structure } from "../server/analysis";
import { Latest } from "../server/latest";
import type { Job } from "../server/types";
import { report } from "../state/notices";
import { job } from "../state/store";
import { choose_paint, paint_choice, paint_number, type PaintChoice, read_paint, shown_paint } from "./paint";
import type { Stage } from "./stage";

/** Voxels along the longest side: the modulus changes from cell to cell at most, and boundaries are interpolated. */
const voxels = 96;

type Painted = Exclude<PaintChoice, "plain">;

const ask: Record<Painted, (made: Job, number: string, signal: AbortSignal) => Promise<ArrayBuffer>> = {
    structure: (made, _, signal) => get_structure(made, voxels, signal),
    modulus: (made, _, signal) => get_modulus(made, voxels, signal),
    number: (made, number, signal) => get_numbers(made, number, voxels, signal),
};

export function watch_paint(on: Stage): () => void {
    const latest = new Latest();
    const stop = effect(() => {
        const made = job.value;
        const choice = paint_choice.value;
        const number = paint_number.value;
        if (shown_paint.peek()?.of !== choice) {
            on.set_paint(null);
            shown_paint.value = null;
        }
        if (!made || choice === "plain") {
            latest.cancel();
            return;
        }
        latest.run(async (signal) => {
            try {
                const paint = read_paint(choice, await ask[choice](made, number, signal));
                if (job.value?.job !== made.job || paint_choice.value !== choice || paint_number.value !== number) return;
                on.set_paint(paint);
                shown_paint.value = paint;
            } catch (error) {
                report(error);
                if (!signal.aborted) choose_paint("plain");
            }
        });
    });
    return () => {
        stop();
        latest.cancel();
    };
}
