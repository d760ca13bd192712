// Handles: the places that the recipe names, to be moved by mouse: attractors, fields, holes, loads.
import { computed, signal } from "@preact/signals";
import { applies, chosen_kind, type Given } from "../form/applies";
import type { Change, Job, Triple } from "../server/types";
import { edit, pending, place_of } from "../state/recipe";
import { table, values } from "../state/store";
import { rounded } from "./space";

export type Tone = "attract" | "field" | "support" | "hole" | "load";

export interface Handle {
    id: string;
    section: string;
    index: number;
    key: string;
    /** Numbers of the key, and where in them the points lie that the handle moves. */
    rows: number[][];
    corners: [row: number, offset: number][];
    title: string;
    tone: Tone;
    /** In the recipe's coordinates, mm. */
    at: Triple;
    /** Radius of the ring round it, mm; 0: none. */
    reach: number;
}

/** The handle whose keys are shown. */
export const chosen = signal<string | null>(null);

/** Numbers of a value such as "1,2,3;4,5,6"; null when they are no numbers. */
export function rows_of(value: string): number[][] | null {
    const rows = value.split(";").map((row) => row.split(",").map(Number));
    return value.trim() && rows.every((row) => row.every(Number.isFinite)) ? rows : null;
}

export const rows_text = (rows: number[][]) => rows.map((row) => row.join(",")).join(";");

/** An entry of a list, with the changes that the server has not answered yet. */
export function entry_of(section: string, index: number): Given {
    const entry: Given = { ...values.value.lists[section]?.[index] };
    const prefix = place_of(section, index, "");
    for (const [place, value] of Object.entries(pending.value)) {
        if (!place.startsWith(prefix)) continue;
        if (value === null) delete entry[place.slice(prefix.length)];
        else entry[place.slice(prefix.length)] = value;
    }
    return entry;
}

const names: Record<string, string[]> = {
    grading: ["points", "segments", "at", "a", "b"],
    field: ["at"],
    hole: ["at"],
    load: ["at", "box"],
    anchor: ["at", "box"],
    cut: ["at"],
};

const shapes = ["sphere", "box", "cylinder", "capsule", "torus"];

function corners_of(key: string, rows: number[][]): [number, number][][] {
    if (key === "box") return [[[0, 0], [1, 0]]];
    return rows.flatMap((row, i) => row.flatMap((_, k) => (k % 3 === 0 ? [[[i, k] as [number, number]]] : [])));
}

/** What is made where the field is. */
function regions_of(field: string | undefined): Given[] {
    return (values.value.lists.region ?? []).filter((one) => one.field === field);
}

function tone_of(section: string, entry: Given): Tone {
    if (section === "grading") return "attract";
    if (section === "hole") return "hole";
    if (section === "load" || section === "anchor") return "load";
    const makes = regions_of(entry.name).map((one) => one.make ?? "");
    return makes.length && makes.every((make) => make === "blocker" || make === "enforcer")
        ? "support"
        : "field";
}

function reach_of(section: string, entry: Given): number {
    if (section === "grading" && entry.kind === "attractors") return Number(entry.radius) || 0;
    return section === "hole" || (section === "field" && entry.kind === "sphere") ? Number(entry.radius) || 0 : 0;
}

function title_of(section: string, index: number, entry: Given, key: string, number: number): string {
    const name = entry.name ?? entry.case ?? `${index + 1}`;
    const makes = section === "field" ? regions_of(entry.name).map((one) => one.make) : [];
    const what = makes.length ? `${makes.join(", ")} in ${name}` : `${section} ${name}`;
    return key === "at" || key === "box" ? what : `${what}, ${key} ${number + 1}`;
}

function value_of(section: string, key: string, entry: Given): string | undefined {
    const is_shape = section === "field" && shapes.includes(entry.kind ?? "");
    return entry[key] ?? (is_shape ? "0,0,0" : undefined);
}

function handles_of(section: string, index: number): Handle[] {
    const entry = entry_of(section, index);
    const kind = chosen_kind(table.value, section, entry);
    return names[section]!.flatMap((key) => {
        const rows = rows_of(value_of(section, key, entry) ?? "");
        if (!rows || !applies(table.value, section, key, kind)) return [];
        return corners_of(key, rows).flatMap((corners, number) => {
            const points = corners.map(([row, offset]) => rows[row]?.slice(offset, offset + 3) ?? []);
            if (points.some((point) => point.length !== 3)) return [];
            const at = [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k]!, 0) / points.length);
            return {
                id: `${place_of(section, index, key)}.${number}`,
                section,
                index,
                key,
                rows,
                corners,
                title: title_of(section, index, entry, key, number),
                tone: tone_of(section, entry),
                at: at as Triple,
                reach: reach_of(section, entry),
            };
        });
    });
}

export const handles = computed(() =>
    Object.keys(names).flatMap((section) =>
        (values.value.lists[section] ?? []).flatMap((_, index) => handles_of(section, index)),
    ),
);

/** Moves a handle to a point of the recipe. All of a movement is one step of undo. */
export function move(made: Job, handle: Handle, to: Triple): void {
    const rows = handle.rows.map((row) => [...row]);
    for (const [row, offset] of handle.corners) {
        for (let k = 0; k < 3; ++k) rows[row]![offset + k]! = rounded(made, rows[row]![offset + k]! + to[k]! - handle.at[k]!);
    }
    const { section, index, key } = handle;
    edit([{ section, index, key, value: rows_text(rows) }], `move ${handle.id}`);
}

/** A grading that is the whole value of a key leaves a number behind. */
function without_grading(entry: Given): Change[] {
    const number = entry.far ?? entry.value;
    if (!entry.name || number === undefined) return [];
    return Object.entries(values.value.values)
        .filter(([, value]) => value === entry.name)
        .map(([name]) => {
            const [section, key] = name.split(".");
            return { section: section!, key: key!, value: number };
        });
}

/** Removes the place: a point of several, or the entry with the regions that are made in it. */
export function remove(handle: Handle): void {
    const { section, index, key, rows } = handle;
    const entry = entry_of(section, index);
    chosen.value = null;
    const row = handle.corners[0]![0];
    if (section === "grading" && ["points", "segments"].includes(key)) {
        const other = entry[key === "points" ? "segments" : "points"];
        if (rows.length > 1 || other !== undefined) {
            const rest = rows.filter((_, i) => i !== row);
            edit([{ section, index, key, value: rest.length ? rows_text(rest) : null }], `remove ${handle.id}`);
            return;
        }
    }
    const changes: Change[] = section === "grading" ? without_grading(entry) : [];
    if (section === "field") {
        const regions = values.value.lists.region ?? [];
        for (let i = regions.length - 1; i >= 0; --i) {
            if (regions[i]!.field === entry.name) changes.push({ section: "region", index: i, key: null, value: null });
        }
    }
    edit([...changes, { section, index, key: null, value: null }], `remove ${handle.id}`);
}
