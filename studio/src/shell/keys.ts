// Keys of the whole page.
import { clamp_layer } from "../state/heights";
import { redo, save, undo } from "../state/recipe";
import { focus_soon } from "./focus";
import { job, layer, left_mode, type Tab, tab } from "../state/store";

const tab_keys: Record<string, Tab> = {
    Digit1: "design",
    Digit2: "check",
    Digit3: "stiffness",
    Digit4: "make",
    Digit5: "print",
};

/** Whether a key belongs to what is being typed. */
function is_typing(event: KeyboardEvent): boolean {
    const target = event.composedPath()[0] as HTMLElement;
    if (
        target.isContentEditable ||
        target instanceof HTMLTextAreaElement ||
        target instanceof HTMLSelectElement
    )
        return true;
    return target instanceof HTMLInputElement && !["checkbox", "range", "file"].includes(target.type);
}

function with_control(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    if (key === "s") {
        event.preventDefault();
        (document.activeElement as HTMLElement | null)?.blur(); // takes over what is being typed
        void save();
    } else if ((key === "z" || key === "y") && !is_typing(event)) {
        event.preventDefault();
        if (key === "y" || event.shiftKey) redo();
        else undo();
    }
}

function nudge(by: number): void {
    if (job.value) layer.value = clamp_layer(job.value, layer.value + by);
}

export function listen_to_keys(): void {
    addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey) {
            with_control(event);
            return;
        }
        const wanted = tab_keys[event.code];
        if (event.altKey) {
            if (!wanted) return;
            event.preventDefault();
            tab.value = wanted;
            return;
        }
        if (is_typing(event)) return;
        if (event.key === ",") nudge(-1);
        else if (event.key === ".") nudge(1);
        else if (event.key === "/") {
            event.preventDefault();
            tab.value = "design";
            left_mode.value = "form";
            focus_soon("search-keys");
        }
    });
}
