// Changes that touch several keys: another kind, another body, a section that comes or goes.
import type { Change, Setting } from "../server/types";
import { edit } from "../state/recipe";
import { table, text, values } from "../state/store";
import { applies, type Given, kind_key, needed, settings_of } from "./applies";
import { headers } from "./places";
import { first_values, starter } from "./starters";

export interface Spot {
    section: string;
    /** Entry of a list; absent for plain sections. */
    index?: number;
}

export function given_at({ section, index }: Spot): Given {
    if (index !== undefined) return values.value.lists[section]?.[index] ?? {};
    const mine = values.value.given.filter((name) => name.startsWith(`${section}.`));
    return Object.fromEntries(
        mine.map((name) => [name.slice(section.length + 1), values.value.values[name] ?? ""]),
    );
}

function change_kind(spot: Spot, key: string, word: string): Change[] {
    const given = given_at(spot);
    const changes: Change[] = [{ ...spot, key, value: word }];
    for (const other of Object.keys(given)) {
        if (!applies(table.value, spot.section, other, word))
            changes.push({ ...spot, key: other, value: null });
    }
    for (const need of needed(table.value, spot.section, word, given)) {
        const setting = settings_of(table.value, spot.section).find((one) => one.key === need);
        const value = setting && !(need in given) ? starter(setting) : null;
        if (value !== null) changes.push({ ...spot, key: need, value });
    }
    return changes;
}

/** Sets one key, and what has to change with it. */
export function set_key(spot: Spot, setting: Setting, value: string | null): void {
    const { section, key } = setting;
    if (kind_key(table.value, section)?.key !== key || value === null) {
        edit([{ ...spot, key, value }]);
        return;
    }
    const changes = change_kind(spot, key, value);
    if (section === "part") {
        const given = given_at(spot);
        if (value === "none") changes[0] = { ...spot, key, value: null };
        else
            for (const body of ["mesh", "field", "unit"]) {
                if (body in given) changes.push({ ...spot, key: body, value: null });
            }
    }
    edit(changes);
}

/** Changes that make a mesh the body of the part. */
export function mesh_changes(mesh: string): Change[] {
    const given = given_at({ section: "part" });
    const shape = Object.keys(given).filter((key) =>
        ["shape", "field", "radius", "size", "height", "tube", "period", "thickness"].includes(key),
    );
    return [
        { section: "part", key: "mesh", value: mesh },
        ...shape.map((key) => ({ section: "part", key, value: null })),
    ];
}

const names_in = (section: string) =>
    (values.value.lists[section] ?? []).flatMap((entry) => (entry.name ? [entry.name] : []));

export function add_section(section: string): void {
    const first = first_values(table.value, section, names_in("field"), names_in(section));
    edit(
        Object.entries(first).map(([key, value]) => ({ section, key, value })),
        `add ${section}`,
    );
}

function entry_changes(section: string, fields: string[]): Change[] {
    const index = headers(text.value).filter((one) => one.section === section).length;
    const first = first_values(table.value, section, fields, names_in(section));
    return Object.entries(first).map(([key, value]) => ({ section, index, key, value }));
}

/** Adds an entry to a list. A region is where a field is: without fields it brings one. */
export function add_entry(section: string): void {
    const fields = names_in("field");
    const before = section === "region" && !fields.length ? entry_changes("field", []) : [];
    const made = before.find((one) => one.key === "name")?.value;
    const changes = [...before, ...entry_changes(section, made ? [made] : fields)];
    edit(changes, `add ${section} ${Date.now()}`);
}

export function remove(spot: Spot): void {
    edit([{ ...spot, key: null, value: null }], `remove ${spot.section}`);
}
