// What of the form is shown: the words that are searched, and whether all keys are.
import { computed, signal } from "@preact/signals";
import type { Setting } from "../server/types";

export const search_text = signal("");
export const search = computed(() => search_text.value.trim());
export const all_keys = signal(false);

export function matches(setting: Setting): boolean {
    const all = `${setting.section}.${setting.key} ${setting.help}`.toLowerCase();
    return search.value
        .toLowerCase()
        .split(/\s+/)
        .every((word) => all.includes(word));
}
