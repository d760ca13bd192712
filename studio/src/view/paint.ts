// What colours show on the part: nothing, or the modulus of its foam.
import { computed, signal } from "@preact/signals";
import type { Triple } from "../server/types";
import { job } from "../state/store";
import { shown_design } from "./design";

export type PaintChoice = "plain" | "modulus";

export const paint_choice = signal<PaintChoice>("plain");
/** Whether there is a modulus to show. */
export const can_paint = computed(() => Boolean(job.value?.modulus) && shown_design.value === null);
export const painted = computed(() => paint_choice.value === "modulus" && can_paint.value);

/** Codes by voxels: 0 plain, 1 softer and 2 stiffer than asked, 3 to 255 along the scale. */
export interface Paint {
    size: Triple;
    lo: Triple;
    hi: Triple;
    data: Uint8Array;
    scale: { lo_mpa: number; hi_mpa: number; is_asked: boolean };
}

/** The scale that is shown; null: none. */
export const shown_scale = signal<Paint["scale"] | null>(null);

export function read_paint(bytes: ArrayBuffer): Paint {
    const length = new DataView(bytes).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length))) as Omit<Paint, "data">;
    const data = new Uint8Array(bytes, 4 + length);
    if (data.length < head.size[0] * head.size[1] * head.size[2])
        throw new Error("The modulus is shorter than its head says.");
    return { ...head, data };
}
