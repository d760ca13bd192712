// What colours show on the part: nothing, what it is made of, the modulus of its foam, or a graded number.
import { computed, signal } from "@preact/signals";
import type { Structure, Triple } from "../server/types";
import { job } from "../state/store";
import { shown_design } from "./design";

export type PaintChoice = "plain" | "structure" | "modulus" | "number";

const wanted = signal<PaintChoice>("plain");

/** What the part that is shown can be painted by. */
export const paint_choices = computed<PaintChoice[]>(() => {
    const made = job.value;
    if (!made || shown_design.value) return ["plain"];
    const there: PaintChoice[] = ["plain"];
    if (made.structure.length) there.push("structure");
    if (made.modulus) there.push("modulus");
    if (made.numbers.length) there.push("number");
    return there;
});

/** What is wanted and possible. */
export const paint_choice = computed<PaintChoice>(() =>
    paint_choices.value.includes(wanted.value) ? wanted.value : "plain",
);

const wanted_number = signal("");

/** The name of the number that is wanted, or the first of those that vary. */
export const paint_number = computed(() => {
    const names = (job.value?.numbers ?? []).map(({ name }) => name);
    return names.includes(wanted_number.value) ? wanted_number.value : (names[0] ?? "");
});

export function choose_number(name: string): void {
    wanted_number.value = name;
}

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

/** Codes by voxels: 0 plain, 3 to 255 evenly along the scale. */
export interface NumberPaint extends Samples {
    of: "number";
    scale: { lo: number; hi: number; unit: string };
}

export type Paint = ModulusPaint | StructurePaint | NumberPaint;

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
