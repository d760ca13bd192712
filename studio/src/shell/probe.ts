// window.__studio: what tests and the curious may read of the page.
import { faults } from "../check/faults";
import { counted, curve_choice } from "../layers/curves";
import { path_look } from "../layers/path_look";
import { lines, picture } from "../layers/shown_layer";
import { messages, print } from "../print/print";
import { away } from "../server/events";
import { building, job, layer, mistakes, tab, text } from "../state/store";
import { homogenizing, searching } from "../stiffness/analyses";
import { shown_design } from "../view/design";
import { shown_paint } from "../view/paint";
import { shown_voxels, stage } from "../view/shown";

export interface Probe {
    /** Frames a second of the last movement of the view. */
    readonly fps: number;
    readonly state: Record<string, unknown>;
}

export const probe: Probe = {
    get fps() {
        return stage.value?.pace.fps ?? 0;
    },
    get state() {
        return {
            job: job.value?.job ?? null,
            layers: job.value?.layers.count ?? 0,
            layer: layer.value,
            shown: picture.value
                ? { job: picture.value.job, layer: picture.value.layer, exact: picture.value.exact }
                : lines.value
                  ? { job: lines.value.job, layer: lines.value.layer }
                  : null,
            voxels: shown_voxels.value,
            scale: stage.value?.pace.scale ?? 0,
            text: text.value,
            mistakes: mistakes.value,
            faults: faults.value.length,
            building: building.value,
            away: away.value,
            tab: tab.value,
            print: print.value,
            print_messages: messages.value.map((one) => one.text),
            homogenized: homogenizing.value?.analysis ?? null,
            searched: searching.value?.analysis ?? null,
            design: shown_design.value,
            paint: shown_paint.value && {
                of: shown_paint.value.of,
                ...(shown_paint.value.of === "structure" ? { parts: shown_paint.value.parts } : shown_paint.value.scale),
            },
            path_look: path_look.value,
            curve: { of: curve_choice.value, job: counted.value?.job.job ?? null, ...(counted.value?.islands ?? counted.value?.times) },
        };
    },
};
