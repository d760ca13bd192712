// The layer first: what takes longer is asked for once the layer of a new job is shown, or after a while.
import { effect } from "@preact/signals";
import type { Job } from "../server/types";
import { layer } from "../state/store";
import { lines, picture } from "./shown_layer";

/** A layer that takes longer is not waited for, ms. */
const patience = 400;

const is_shown = (made: Job) => {
    const shown = picture.value ?? lines.value;
    return shown?.job === made.job && shown.layer === layer.value;
};

/** Calls `act` once the layer of the job is shown. Returns what calls it off. */
export function after_layer(made: Job, act: () => void): () => void {
    let done = false;
    const once = () => {
        if (done) return;
        done = true;
        clearTimeout(timer);
        act();
    };
    const timer = window.setTimeout(once, patience);
    const stop = effect(() => {
        if (is_shown(made)) once();
    });
    return () => {
        done = true;
        clearTimeout(timer);
        stop();
    };
}
