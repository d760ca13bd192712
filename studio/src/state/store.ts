// What the page knows: the recipe, the job made of it and the layer that is looked at.
import { computed, signal } from "@preact/signals";
import type { Example, Job, Machine, Mistake, Report, Table, Values, Version } from "../server/types";

export const version = signal<Version | null>(null);
export const table = signal<Table>({ sections: [], settings: [], kinds: [] });
export const machines = signal<Machine[]>([]);
export const examples = signal<Example[]>([]);

export const text = signal("");
export const path = signal<string | null>(null);
export const saved_text = signal("");
export const unsaved = computed(() => text.value !== saved_text.value);

export const values = signal<Values>({ values: {}, lists: {}, given: [] });
/** Mistakes of the recipe as a whole, and of the last edit that the server refused. */
export const mistakes = signal<Mistake[]>([]);
export const edit_mistakes = signal<Mistake[]>([]);

export const job = signal<Job | null>(null);
export const building = signal(false);
export const build_progress = signal<{ done: number; of: number; text: string } | null>(null);
export const layer = signal(0);
/** Whether the next job is of another recipe: its middle is shown, not the height of before. */
export const opened = signal(true);

export const report_of_check = signal<{ job: string; report: Report } | null>(null);

/** Whether the recipe has a search whose result is not known yet. */
export const needs_search = signal(false);

export type Tab = "design" | "check" | "stiffness" | "make" | "print";
export const tab = signal<Tab>("design");
/** Whether the start page is shown instead of the recipe. */
export const starting = signal(false);
export const ready = signal(false);
/** A line of the recipe's text to go to; the number changes at every request. */
export const wanted_line = signal<{ line: number } | null>(null);
export const left_mode = signal<"form" | "text">("form");
