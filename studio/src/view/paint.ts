// What colours show on the part: nothing, the modulus of its foam, or what it is made of.
import { computed, signal } from "@preact/signals";
import type { Structure, Triple } from "../server/types";
import { job } from "../state/store";
import { shown_design } from "./design";

export type PaintChoice = "plain" | "modulus" | "structure";

const wanted = signal<PaintChoice>("plain");

/** What the part that is shown can be painted by. */
export const paint_choices = computed<PaintChoice[]>(() => {
    const made = job.value;
    if (!made || shown_design.value) return ["plain"];
    const there: PaintChoice[] = ["plain"];
    if (made.structure.length) there.push("structure");
    if (made.modulus) there.push("modulus");
    return there;
});

/** What is wanted and possible. */
export const paint_choice = computed<PaintChoice>(() =>
    paint_choices.value.includes(wanted.value) ? wanted.value : "plain",
);

export function choose_paint(choice: PaintChoice): void {
    wanted.value = choice;
}

export interface Scale {
    lo_mpa: number;
    hi_mpa: number;
    is_asked: boolean;
}

interface Samples {
    size: Triple;
    lo: Triple;
    hi: Triple;
    data: Uint8Array;
}

/** Codes by voxels: 0 plain, 1 softer and 2 stiffer than asked, 3 to 255 along the scale. */
export interface ModulusPaint extends Samples {
    of: "modulus";
    scale: Scale;
}

/** Three bytes by voxels: how far it lies within skin, frame and solid regions, 128 at their boundaries. */
export interface StructurePaint extends Samples {
    of: "structure";
    parts: Structure[];
}

export type Paint = ModulusPaint | StructurePaint;

/** What of the part lies in nothing else. */
export const rest_of = (parts: Structure[]) => parts.filter((part) => part !== "supports").at(-1) ?? "body";

/** The paint that is shown; null: none. */
export const shown_paint = signal<Paint | null>(null);

export function read_paint(of: Paint["of"], bytes: ArrayBuffer): Paint {
    const length = new DataView(bytes).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length))) as Paint & {
        channels: number;
    };
    const data = new Uint8Array(bytes, 4 + length);
    if (data.length < head.size[0] * head.size[1] * head.size[2] * head.channels)
        throw new Error(`The ${of} is shorter than its head says.`);
    return { ...head, of, data } as Paint;
}
