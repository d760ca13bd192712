// Light or dark: as the system says, until the user chooses.
import { computed, effect, signal } from "@preact/signals";

const kept_as = "lamella-theme";
const system = matchMedia("(prefers-color-scheme: dark)");
const system_dark = signal(system.matches);
const chosen = signal(localStorage.getItem(kept_as));

export const dark = computed(() => (chosen.value ? chosen.value === "dark" : system_dark.value));

export function start_theme(): void {
    system.addEventListener("change", () => {
        system_dark.value = system.matches;
    });
    effect(() => {
        document.documentElement.dataset.theme = dark.value ? "dark" : "light";
    });
}

export function toggle_theme(): void {
    chosen.value = dark.value ? "light" : "dark";
    localStorage.setItem(kept_as, chosen.value);
}
