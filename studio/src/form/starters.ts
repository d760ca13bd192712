// Which keys the form shows of itself, and the values with which a section begins.
import type { Setting, Table } from "../server/types";
import { chosen_kind, type Given, kind_key, needed, settings_of } from "./applies";

/** Sections that the form always shows, in its order. The others are added when they are wanted. */
export const main_sections = ["part", "foam", "skin", "frame", "support", "layers", "printer"];
/** Sections that need no adding: every recipe has them. */
export const fixed_sections = ["part", "layers", "printer"];

const essential: Record<string, string[]> = {
    part: ["mesh", "shape", "unit", "scale", "turn"],
    foam: ["kind", "seed"],
    skin: ["thickness", "side", "pattern"],
    frame: ["beam", "interior"],
    support: ["kind", "spacing", "tip"],
    layers: ["height", "first"],
    printer: ["profile"],
    region: ["field", "make", "blend"],
    field: ["name", "kind", "at"],
    grading: ["name", "kind"],
    hole: ["at", "radius", "through"],
};

/** Keys that are shown of a section when none is given. */
export function essentials(table: Table, section: string): string[] {
    return (
        essential[section] ??
        settings_of(table, section)
            .slice(0, 4)
            .map((one) => one.key)
    );
}

const starters: Record<string, string> = {
    "part.radius": "10",
    "part.size": "20,20,20",
    "part.height": "20",
    "part.tube": "3",
    "part.period": "8",
    "part.thickness": "1",
    "foam.cell": "3",
    "foam.beam": "0.4",
    "foam.wall": "0.6",
    "foam.unit_cell": "octet",
    "skin.thickness": "0.8",
    "skin.window": "3",
    "skin.strut": "0.8",
    "frame.beam": "0.5",
    "field.radius": "5",
    "field.size": "10,10,10",
    "field.height": "20",
    "field.tube": "1.5",
    "field.formula": "sqrt(x*x + y*y + z*z) - 5",
    "field.kind": "sphere",
    "field.at": "0,0,0",
    "grading.kind": "formula",
    "grading.formula": "2 + 0.1*d",
    "grading.value": "1",
    "grading.near": "1",
    "grading.far": "3",
    "grading.radius": "10",
    "grading.at": "0,0,0",
    "grading.normal": "0,0,1",
    "grading.along": "z",
    "grading.points": "[[0, 0, 0]]",
    "grading.rows": "[[0, 1], [10, 3]]",
    "grading.a": "0,0,0",
    "grading.b": "0,0,10",
    "region.make": "solid",
    "region.thickness": "1.2",
    "hole.at": "0,0,0",
    "hole.radius": "1.5",
    "element.length": "10",
    "element.diameter": "8",
    "element.width": "1.5",
};

/** Sections that begin with values of their own. */
const first: Record<string, Given> = {
    support: { kind: "bridges" },
    material: { name: "pla" },
    load: { face: "+z", force: "0,0,-10" },
    anchor: { face: "-z" },
    cavity: { wall: "1" },
    shield: { gap: "2" },
    check: { process: "usual" },
    cut: { at: "0,0,0", normal: "0,0,1" },
    output: { beams: "beams.3mf" },
    plate: { copies: "2" },
};

/** The default as a value, when it is one and not a description. */
export function plain_default(setting: Setting): string | null {
    const text = setting.default;
    const is_number = /^-?[0-9.]+(e-?[0-9]+)?$/.test(text);
    switch (setting.type) {
        case "number":
        case "integer":
        case "graded":
            return is_number ? text : null;
        case "boolean":
            return text === "true" || text === "false" ? text : null;
        case "choice":
            return setting.choices.includes(text) ? text : null;
        case "triple":
            return /^[-0-9., ]+$/.test(text) ? text.replaceAll(" ", "") : null;
        default:
            return null;
    }
}

/** A value to begin with; null when only the user can know it. */
export function starter(setting: Setting): string | null {
    return (
        starters[`${setting.section}.${setting.key}`] ?? plain_default(setting) ?? setting.choices[0] ?? null
    );
}

/** Values of a new section, or of a new entry of a list. `taken`: names that other entries have. */
export function first_values(table: Table, section: string, fields: string[], taken: string[]): Given {
    const settings = settings_of(table, section);
    const values: Given = { ...first[section] };
    const put = (key: string) => {
        const setting = settings.find((one) => one.key === key);
        const value = setting && !(key in values) ? starter(setting) : null;
        if (value !== null) values[key] = value;
    };
    if (!first[section] && settings.some((one) => one.key === "name")) {
        let number = 1;
        while (taken.includes(`${section}_${number}`)) ++number;
        values.name = `${section}_${number}`;
    }
    if (section === "region" && fields[0]) values.field = fields[0];
    const chooser = kind_key(table, section);
    if (chooser && (!chooser.default || `${section}.${chooser.key}` in starters)) put(chooser.key);
    for (const key of needed(table, section, chosen_kind(table, section, values), values)) put(key);
    for (const { key, default: text } of settings) {
        const is_required = text === "required" || text === `required in [${section}]`;
        if (is_required && (!chooser || `${section}.${key}` in starters)) put(key);
    }
    if (!Object.keys(values).length) {  // any key will do: it takes its default
        const usable = settings.find((one) => plain_default(one) !== null);
        if (usable) put(usable.key);
    }
    return values;
}
