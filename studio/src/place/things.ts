// Things that can be put at a place of the part: each is a few entries of the recipe.
import { signal } from "@preact/signals";
import { headers } from "../form/places";
import type { Change, Job, Triple } from "../server/types";
import { edit, place_of } from "../state/recipe";
import { job, text, values } from "../state/store";
import { chosen } from "./handles";
import { rounded, size_of, to_recipe } from "./space";

export interface Thing {
    word: string;
    label: string;
    group: "Foam" | "Solid" | "Supports" | "Loads";
    /** Why it cannot be put anywhere now; null: it can. */
    lacks: (made: Job) => string | null;
    /** `at`: in the recipe's coordinates, mm. */
    changes: (made: Job, at: Triple) => Change[];
}

/** The thing that the next click on the part puts there. */
export const placing = signal<Thing | null>(null);

const given = (name: string) => values.value.given.includes(name);
const has = (section: string) => values.value.given.some((name) => name.startsWith(`${section}.`));
const entries = (section: string) => values.value.lists[section] ?? [];
const next_index = (section: string) => headers(text.value).filter((one) => one.section === section).length;

function free_name(stem: string): string {
    const taken = new Set(["field", "grading"].flatMap((section) => entries(section).map((one) => one.name)));
    let number = 1;
    while (taken.has(`${stem}_${number}`)) ++number;
    return `${stem}_${number}`;
}

const joined = (made: Job, p: Triple) => p.map((one) => rounded(made, one)).join(",");

/** A length that suits the part: a share of its diagonal, to two digits, mm. */
const length_of = (made: Job, share: number) => Number((share * size_of(made)).toPrecision(2));

const put = (section: string, index: number, keys: Record<string, string>): Change[] =>
    Object.entries(keys).map(([key, value]) => ({ section, index, key, value }));

/** A ball, and a region in it. */
function ball(stem: string, share: number, region: (made: Job) => Record<string, string>) {
    return (made: Job, at: Triple): Change[] => {
        const name = free_name(stem);
        return [
            ...put("field", next_index("field"), {
                name,
                kind: "sphere",
                radius: `${length_of(made, share)}`,
                at: joined(made, at),
            }),
            ...put("region", next_index("region"), { field: name, ...region(made) }),
        ];
    };
}

const number_of = (name: string): number | null => {
    const value = Number(values.value.values[name] ?? NaN);
    return Number.isFinite(value) ? value : null;
};

const no_foam = () => (has("foam") ? null : "the part has no foam");

/** The grading of attractors that was given last. */
function last_attractors(): { index: number; keys: Record<string, string> } | null {
    for (let index = entries("grading").length - 1; index >= 0; --index) {
        const keys = entries("grading")[index]!;
        if (keys.kind === "attractors") return { index, keys };
    }
    return null;
}

/** Attracts: as one more place of the last attractors, or of new ones, which the cells then follow. */
function attract(key: "points" | "segments", place: (made: Job, at: Triple) => string) {
    return (made: Job, at: Triple): Change[] => {
        const last = last_attractors();
        if (last) {
            const before = last.keys[key];
            const value = before ? `${before};${place(made, at)}` : place(made, at);
            return [{ section: "grading", index: last.index, key, value }];
        }
        const cell = number_of("foam.cell")!;
        const name = free_name("attractors");
        return [
            ...put("grading", next_index("grading"), {
                name,
                kind: "attractors",
                [key]: place(made, at),
                near: `${Number((cell / 2).toPrecision(3))}`,
                far: `${cell}`,
                radius: `${length_of(made, 0.3)}`,
            }),
            { section: "foam", key: "cell", value: name },
        ];
    };
}

const no_attractors = () => {
    if (!has("foam")) return "the part has no foam";
    if (last_attractors() || number_of("foam.cell") !== null) return null;
    return given("foam.cell") ? "the cell is a formula already" : "the cell is not given";
};

function upright(made: Job, at: Triple): string {
    const up = to_recipe(made, [0, 0, length_of(made, 0.2)])!;
    return `${joined(made, at)},${joined(made, at.map((one, k) => one + up[k]!) as Triple)}`;
}

function box_around(made: Job, at: Triple): string {
    const half = length_of(made, 0.05);
    return [-half, half].map((by) => joined(made, at.map((one) => one + by) as Triple)).join(";");
}

const always = () => null;
const support_kind = (made: Job) => (made.process === "filament" ? "bridges" : "pillars");

export const things: Thing[] = [
    { word: "point", label: "Finer cells here", group: "Foam", lacks: no_attractors, changes: attract("points", joined) },
    {
        word: "segment",
        label: "Finer cells along a line",
        group: "Foam",
        lacks: no_attractors,
        changes: attract("segments", upright),
    },
    {
        word: "foam",
        label: "Other foam in a ball",
        group: "Foam",
        lacks: () => no_foam() ?? (number_of("foam.cell") === null ? "the cell is no number" : null),
        changes: ball("zone", 0.12, (made) => ({
            make: "foam",
            cell: `${Number((number_of("foam.cell")! * 1.6).toPrecision(3))}`,
            blend: `${length_of(made, 0.04)}`,
        })),
    },
    { word: "solid", label: "Solid ball", group: "Solid", lacks: always, changes: ball("solid", 0.08, () => ({ make: "solid" })) },
    { word: "empty", label: "Empty ball", group: "Solid", lacks: always, changes: ball("empty", 0.08, () => ({ make: "empty" })) },
    {
        word: "hole",
        label: "Hole through the skin",
        group: "Solid",
        lacks: () => (has("skin") ? null : "the part has no skin"),
        changes: (made, at) =>
            put("hole", next_index("hole"), { at: joined(made, at), radius: `${length_of(made, 0.02)}` }),
    },
    {
        word: "enforcer",
        label: "Supports here",
        group: "Supports",
        lacks: always,
        changes: (made, at) => [
            ...(has("support") ? [] : [{ section: "support", key: "kind", value: support_kind(made) }]),
            ...ball("held", 0.06, () => ({ make: "enforcer" }))(made, at),
        ],
    },
    {
        word: "blocker",
        label: "No supports here",
        group: "Supports",
        lacks: () => (has("support") ? null : "the part has no supports"),
        changes: ball("free", 0.06, () => ({ make: "blocker" })),
    },
    {
        word: "load",
        label: "Load of 10 N",
        group: "Loads",
        lacks: always,
        changes: (made, at) =>
            put("load", next_index("load"), { box: box_around(made, at), force: "0,0,-10" }),
    },
    {
        word: "anchor",
        label: "Hold",
        group: "Loads",
        lacks: always,
        changes: (made, at) => put("anchor", next_index("anchor"), { box: box_around(made, at) }),
    },
];

/** Puts a thing at a place of the job; its handle is then chosen. */
export function put_thing(thing: Thing, place: Triple): void {
    placing.value = null;
    const made = job.value;
    const at = made && to_recipe(made, place);
    if (!made || !at || thing.lacks(made)) return;
    const changes = thing.changes(made, at);
    const first = changes.find((one) => ["points", "segments", "at", "box"].includes(one.key ?? ""));
    edit(changes, `put ${thing.word} ${Date.now()}`);
    if (!first) return;
    const number = (first.value!.match(/;/g) ?? []).length * (first.key === "segments" ? 2 : 1);
    chosen.value = `${place_of(first.section, first.index!, first.key!)}.${first.key === "box" ? 0 : number}`;
}
