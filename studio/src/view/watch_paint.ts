// Loads the colours of the part that is shown.
import { effect } from "@preact/signals";
import { get_modulus } from "../server/analysis";
import { Latest } from "../server/latest";
import { report } from "../state/notices";
import { job } from "../state/store";
import { paint_choice, painted, read_paint, shown_scale } from "./paint";
import type { Stage } from "./stage";

/** Voxels along the longest side: the modulus changes from cell to cell at most. */
const voxels = 96;

export function watch_paint(on: Stage): () => void {
    const latest = new Latest();
    const stop = effect(() => {
        const made = job.value;
        if (!made || !painted.value) {
            latest.cancel();
            on.set_paint(null);
            shown_scale.value = null;
            return;
        }
        latest.run(async (signal) => {
            try {
                const paint = read_paint(await get_modulus(made, voxels, signal));
                if (job.value?.job !== made.job || !painted.value) return;
                on.set_paint(paint);
                shown_scale.value = paint.scale;
            } catch (error) {
                report(error);
                if (!signal.aborted) paint_choice.value = "plain";
            }
        });
    });
    return () => {
        stop();
        latest.cancel();
    };
}
