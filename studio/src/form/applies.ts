// Which keys of a section apply: some keys go with some kinds only.
import type { KindKey, Setting, Table } from "../server/types";

export type Given = Record<string, string>;

export function kind_key(table: Table, section: string): KindKey | undefined {
    return table.kinds.find((one) => one.section === section);
}

/** The chosen kind of a section or of an entry of a list; its default when none is given. */
export function chosen_kind(table: Table, section: string, given: Given): string {
    const chooser = kind_key(table, section);
    if (!chooser) return "";
    const word = given[chooser.key] ?? chooser.default;
    return word in chooser.words ? word : "";
}

const keys_in = (needs: string[]) => needs.flatMap((need) => need.split("|"));

/** Whether a kind takes a key. Keys that no kind lists apply to all. */
export function applies(table: Table, section: string, key: string, kind: string): boolean {
    const chooser = kind_key(table, section);
    const chosen = chooser?.words[kind];
    if (!chooser || !chosen || key === chooser.key) return true;
    const mine = [...keys_in(chosen.needs), ...chosen.takes];
    if (mine.includes(key)) return true;
    return !Object.values(chooser.words).some(
        (one) => keys_in(one.needs).includes(key) || one.takes.includes(key),
    );
}

/** The keys that a kind requires; of alternatives that which is given, else the first. */
export function needed(table: Table, section: string, kind: string, given: Given): string[] {
    const chosen = kind_key(table, section)?.words[kind];
    return (chosen?.needs ?? []).map((need) => {
        const keys = need.split("|");
        return keys.find((key) => key in given) ?? keys[0]!;
    });
}

export function settings_of(table: Table, section: string): Setting[] {
    return table.settings.filter((one) => one.section === section);
}

/** A body is a mesh, a field or a shape: what goes with the others has no place in [part]. */
export function fits_body(key: string, given: Given): boolean {
    const shaped = (given.shape ?? "none") !== "none";
    if (key === "mesh" || key === "field" || key === "unit") return !shaped;
    return true;
}
