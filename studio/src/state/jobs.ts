// Posts the recipe as a job after every change, and takes over what the server answers.
import { batch } from "@preact/signals";
import { post_job, read_values } from "../server/api";
import { Failure } from "../server/http";
import type { Job } from "../server/types";
import { layer_at, slab_of } from "./heights";
import { notice, report } from "./notices";
import { edits_wait, forget_pending } from "./recipe";
import { build_progress, building, job, layer, mistakes, needs_search, opened, text, values } from "./store";
import { shown_design } from "../view/design";

/** Changes within this time of a job's begin make the next one, ms: the first change waits for nothing. */
const gather = 60;
/** A job that has been building for less is not given up for a newer one: a moving slider shows results. */
const patience = 300;
/** The recipe's values are asked for after its job, or when that takes longer than this, ms. */
const values_rest = 150;

const rest = (ms: number) => new Promise((done) => setTimeout(done, ms));

let sequence = 0;
let controller: AbortController | null = null;
let begun = 0;
let timer = 0;

/** Asks for the values and the job of the recipe as it is now. */
export function refresh(): void {
    if (timer) return;
    const rest = controller ? patience : gather;
    const left = begun + rest - Date.now();
    if (left > 0) timer = window.setTimeout(start, left);
    else start();
}

function start(): void {
    clearTimeout(timer);
    timer = 0;
    controller?.abort();
    const mine = new AbortController();
    const recipe = text.value;
    begun = Date.now();
    ++sequence;
    if (!recipe.trim()) {
        controller = null;
        batch(() => {
            job.value = null;
            mistakes.value = [];
            needs_search.value = false;
            values.value = { values: {}, lists: {}, given: [] };
            building.value = false;
        });
        return;
    }
    controller = mine;
    building.value = true;
    const made = take_job(recipe, mine);
    // The form shows what was typed, so that its values may come after the layer.
    void Promise.race([made, rest(values_rest)]).then(() => take_values(recipe, mine.signal));
}

async function take_values(recipe: string, signal: AbortSignal): Promise<void> {
    if (signal.aborted) return;
    try {
        const read = await read_values(recipe, signal);
        if (signal.aborted) return;
        batch(() => {
            values.value = read;
            if (recipe === text.value && !edits_wait()) forget_pending();
        });
    } catch (error) {
        if (!(error instanceof Failure && error.status === 422)) report(error); // the job names the mistakes
    }
}

async function take_job(recipe: string, mine: AbortController): Promise<void> {
    try {
        const made = await post_job(recipe, sequence, mine.signal);
        if (mine.signal.aborted) return;
        batch(() => {
            keep_height(made);
            mistakes.value = [];
            needs_search.value = false;
            shown_design.value = null;
            if (notice.value?.kind === "error") notice.value = null;
        });
    } catch (error) {
        if (mine.signal.aborted) return;
        if (error instanceof Failure && error.status === 422) {
            mistakes.value = error.mistakes.length ? error.mistakes : [{ line: null, text: error.message }];
        } else if (error instanceof Failure && error.status === 428) {
            batch(() => {
                job.value = null; // that of another recipe must not be made
                mistakes.value = [];
                needs_search.value = true;
                if (shown_design.value?.of !== recipe) shown_design.value = null;
            });
        } else {
            report(error);
        }
    }
    if (controller !== mine) return;
    controller = null;
    batch(() => {
        building.value = false;
        build_progress.value = null;
    });
    if (timer) start(); // a change waited for this job
}

/** Takes the job over; the layer that is looked at stays at its height. */
function keep_height(made: Job): void {
    const old = opened.value ? null : job.value;
    const slab = old && slab_of(old, layer.value);
    opened.value = false;
    const wanted = slab ? slab.begin + slab.height / 2 : made.layers.height_mm / 2;
    layer.value = layer_at(made, wanted);
    job.value = made;
}
