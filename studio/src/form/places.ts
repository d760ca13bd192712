// Where mistakes belong: the key that a message names, and the entry of a list in which its line lies.
import { computed } from "@preact/signals";
import type { Mistake } from "../server/types";
import { edit_mistakes, mistakes, table, text } from "../state/store";

export interface Placed {
    mistake: Mistake;
    section: string;
    key: string;
    index: number;
}

/** Lines at which the sections of a recipe begin, from 1. */
export function headers(recipe: string): { section: string; index: number; line: number }[] {
    const counts = new Map<string, number>();
    const found: { section: string; index: number; line: number }[] = [];
    recipe.split("\n").forEach((line, i) => {
        const head = /^\s*(\[\[?)\s*([\w-]+)\s*\]/.exec(line);
        if (!head) return;
        const index = head[1] === "[[" ? (counts.get(head[2]!) ?? 0) : 0;
        counts.set(head[2]!, index + 1);
        found.push({ section: head[2]!, index, line: i + 1 });
    });
    return found;
}

/** Names of the sections that the recipe has, also empty ones. */
export const present = computed(() => new Set(headers(text.value).map((one) => one.section)));

const all = computed<{ placed: Placed[]; others: Mistake[] }>(() => {
    const placed: Placed[] = [];
    const others: Mistake[] = [];
    const heads = headers(text.value);
    for (const mistake of [...edit_mistakes.value, ...mistakes.value]) {
        const named = /^\[*([a-z_]+)\]*(?:\[\d+\])?\.([a-z_0-9]+)\b/.exec(mistake.text);
        const setting =
            named && table.value.settings.find((one) => one.section === named[1] && one.key === named[2]);
        if (!setting) {
            others.push(mistake);
            continue;
        }
        const { line } = mistake;
        const head =
            line === null
                ? undefined
                : heads.filter((one) => one.section === setting.section && one.line <= line).at(-1);
        placed.push({ mistake, section: setting.section, key: setting.key, index: head?.index ?? 0 });
    }
    return { placed, others };
});

export const placed_mistakes = computed(() => all.value.placed);
/** Mistakes that no field of the form can show. */
export const other_mistakes = computed(() => all.value.others);

export function mistakes_at(section: string, index: number, key: string): Mistake[] {
    return placed_mistakes.value
        .filter((one) => one.section === section && one.key === key && one.index === index)
        .map((one) => one.mistake);
}
