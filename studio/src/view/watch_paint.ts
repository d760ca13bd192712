// Loads the colours of the part that is shown.
import { effect } from "@preact/signals";
import { get_modulus, get_structure } from "../server/analysis";
import { Latest } from "../server/latest";
import { report } from "../state/notices";
import { job } from "../state/store";
import { choose_paint, paint_choice, read_paint, shown_paint } from "./paint";
import type { Stage } from "./stage";

/** Voxels along the longest side: the modulus changes from cell to cell at most, and boundaries are interpolated. */
const voxels = 96;

export function watch_paint(on: Stage): () => void {
    const latest = new Latest();
    const stop = effect(() => {
        const made = job.value;
        const choice = paint_choice.value;
        if (shown_paint.peek()?.of !== choice) {
            on.set_paint(null);
            shown_paint.value = null;
        }
        if (!made || choice === "plain") {
            latest.cancel();
            return;
        }
        const ask = choice === "modulus" ? get_modulus : get_structure;
        latest.run(async (signal) => {
            try {
                const paint = read_paint(choice, await ask(made, voxels, signal));
                if (job.value?.job !== made.job || paint_choice.value !== choice) return;
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
