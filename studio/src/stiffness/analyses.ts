// The analyses of this page: the latest homogenisation and the latest search.
import { signal } from "@preact/signals";
import {
    type Analysis,
    get_analysis,
    type News,
    start_homogenize,
    start_optimize,
    stop_analysis,
} from "../server/analysis";
import { Failure } from "../server/http";
import { shown_design } from "../view/design";
import { refresh } from "../state/jobs";
import { report } from "../state/notices";
import { job, text } from "../state/store";

/** An analysis and what it is of: a job, or a recipe's text. */
export interface Run {
    of: string;
    analysis: Analysis;
}

export const homogenizing = signal<Run | null>(null);
export const searching = signal<Run | null>(null);
/** What the server answered when it would not begin. */
export const refused = signal<{ kind: News["kind"]; of: string; text: string } | null>(null);

export const runs = (run: Run | null): boolean =>
    run?.analysis.state === "waiting" || run?.analysis.state === "running";

const slots = { homogenize: homogenizing, optimize: searching };

function put(next: Analysis): void {
    const slot = slots[next.kind];
    if (slot.value?.analysis.analysis !== next.analysis) return;
    slot.value = { ...slot.value, analysis: next };
    if (next.kind === "optimize" && next.designs > 0) show_design(next, slot.value.of);
    if (next.kind === "optimize" && next.state === "done") refresh(); // the part is now the design
}

function show_design(search: Analysis, of: string): void {
    const { analysis: id, designs, count } = search;
    const shown = shown_design.value;
    if (shown?.id === id && shown.number === designs) return;
    shown_design.value = { id, number: designs, step: count, of };
}

async function fetch_whole(id: number): Promise<void> {
    try {
        put(await get_analysis(id));
    } catch (error) {
        report(error);
    }
}

/** Takes over what the server says. Events may be lost: then all is asked for. */
export function take_analysis(news: News): void {
    const known = slots[news.kind].value?.analysis;
    if (known?.analysis !== news.analysis || known.count > news.count) return;
    if (known.state !== "waiting" && known.state !== "running") return;
    const ended = news.state !== "waiting" && news.state !== "running";
    const missing = news.count - known.steps.length;
    if (ended || missing > 1) {
        void fetch_whole(news.analysis);
        return;
    }
    const steps = missing === 1 && news.step ? [...known.steps, news.step] : known.steps;
    put({ ...known, ...news, steps });
}

async function begin(kind: News["kind"], of: string, ask: () => Promise<Analysis>): Promise<void> {
    refused.value = null;
    try {
        const analysis = await ask();
        slots[kind].value = { of, analysis };
        await fetch_whole(analysis.analysis); // it may have gone on before the page knew its number
    } catch (error) {
        if (error instanceof Failure && error.status >= 400 && error.status < 500) {
            const mistakes = error.mistakes.map((one) => one.text).join("; ");
            refused.value = { kind, of, text: mistakes || error.message };
        } else report(error);
    }
}

export async function homogenize(rve: number, samples: number): Promise<void> {
    const made = job.value;
    if (made) await begin("homogenize", made.job, () => start_homogenize(made, rve, samples));
}

export async function optimize(resume = false): Promise<void> {
    const recipe = text.value;
    await begin("optimize", recipe, () => start_optimize(recipe, resume));
}

export async function stop(run: Run): Promise<void> {
    try {
        await stop_analysis(run.analysis.analysis);
    } catch (error) {
        report(error);
    }
}

/** Asks anew for what runs: the line to the server was broken. */
export async function ask_analyses_again(): Promise<void> {
    for (const slot of [homogenizing, searching]) {
        const run = slot.value;
        if (!run || !runs(run)) continue;
        try {
            put(await get_analysis(run.analysis.analysis));
        } catch (error) {
            if (!(error instanceof Failure && error.status === 404)) continue;
            const message = "The server no longer knows this analysis.";
            slot.value = { ...run, analysis: { ...run.analysis, state: "failed", message } };
        }
    }
}
