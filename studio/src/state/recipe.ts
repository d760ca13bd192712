// Changes of the recipe: by the form, by its text, by undo. Every change ends in a new text and a new job.
import { signal } from "@preact/signals";
import { edit_recipe, save_recipe } from "../server/api";
import { Failure } from "../server/http";
import type { Change } from "../server/types";
import { focus_soon } from "../shell/focus";
import { remember, step_back, step_forward } from "./history";
import { refresh } from "./jobs";
import { confirm_done, report } from "./notices";
import { building, edit_mistakes, job, layer, opened, path, saved_text, starting, tab, text } from "./store";

/** Values that the form shows before the server has answered, by place_of. */
export const pending = signal<Record<string, string | null>>({});

export function place_of(section: string, index: number, key: string): string {
    return `${section}.${index}.${key}`;
}

/** Replaces the text. `what` names the step for undo. */
export function set_text(next: string, what: string): void {
    if (next === text.value) return;
    remember(text.value, what);
    text.value = next;
    refresh();
}

/** Opens another recipe: it has no steps in common with the one before, but undo leads back to it. */
export function open_text(next: string): void {
    starting.value = false;
    opened.value = true;
    path.value = null;  // the file of the recipe before is not written over
    saved_text.value = "";
    edit_mistakes.value = [];
    pending.value = {};
    set_text(next, `open ${Date.now()}`);
}

let waiting: { changes: Change[]; what: string } | null = null;
let running = false;

/** Changes keys of the recipe. Changes that come while the server edits are sent together afterwards. */
export function edit(changes: Change[], what?: string): void {
    const shown = { ...pending.value };
    for (const { section, index, key, value } of changes) {
        if (key !== null) shown[place_of(section, index ?? 0, key)] = value;
    }
    pending.value = shown;
    const same = (a: Change, b: Change) =>
        a.section === b.section && (a.index ?? 0) === (b.index ?? 0) && a.key === b.key;
    const kept = (waiting?.changes ?? []).filter((old) => !changes.some((fresh) => same(old, fresh)));
    const name = what ?? changes.map((one) => `${one.section}.${one.index ?? 0}.${one.key}`).join();
    waiting = { changes: [...kept, ...changes], what: name };
    void send_edits();
}

async function send_edits(): Promise<void> {
    if (running) return;
    running = true;
    while (waiting) {
        const { changes, what } = waiting;
        waiting = null;
        const before = text.value;
        try {
            // While a job is made, the one of this text may never be asked for.
            const ahead = job.value && !building.value ? layer.value : undefined;
            const edited = await edit_recipe(before, changes, ahead);
            if (text.value !== before) {
                // the text changed meanwhile: the edit belongs to the new one
                edit(changes, what);
                continue;
            }
            edit_mistakes.value = [];
            if (edited.text === before) forget_pending();
            set_text(edited.text, what);
        } catch (error) {
            if (error instanceof Failure && error.status === 422) edit_mistakes.value = error.mistakes;
            else forget_pending();
            report_unless_shown(error);
        }
    }
    running = false;
}

function report_unless_shown(error: unknown): void {
    if (!(error instanceof Failure && error.mistakes.length)) report(error);
}

/** The server has said what the recipe's values are: the form no longer guesses. */
export function forget_pending(): void {
    if (!waiting && !edit_mistakes.value.length) pending.value = {};
}

export const edits_wait = () => running || waiting !== null;

function go_to(next: string | null): void {
    if (next === null) return;
    edit_mistakes.value = [];
    pending.value = {};
    text.value = next;
    starting.value = !next.trim();
    refresh();
}

export const undo = () => go_to(step_back(text.value));
export const redo = () => go_to(step_forward(text.value));

/** Saves the recipe to its file; without one, asks for a name in Make. */
export async function save(name: string | null = path.value): Promise<void> {
    if (!name) {
        tab.value = "make";
        focus_soon("recipe-path");
        return;
    }
    const kept = text.value;
    try {
        const answer = await save_recipe(kept, name);
        path.value = answer.path;
        saved_text.value = kept;
        confirm_done(`Saved as ${answer.path}`);
    } catch (error) {
        report(
            error instanceof Failure && error.status === 0 ? new Error("Not saved: " + error.message) : error,
        );
    }
}
