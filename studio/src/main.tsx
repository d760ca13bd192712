// Starts the page: shows it at once, then asks the server what there is.
import { batch } from "@preact/signals";
import { render } from "preact";
import "./styles/studio.css";
import "uplot/dist/uPlot.min.css";
import { App } from "./app";
import { check_progress } from "./check/check_panel";
import { ask_again, take_output } from "./make/outputs";
import { ask_for_sending, take_sending } from "./print/network";
import { ask_for_print, take_message, take_print } from "./print/print";
import { end_session, get_examples, get_machines, get_recipe, get_table, get_version } from "./server/api";
import { away, listen } from "./server/events";
import { Failure } from "./server/http";
import type { Progress } from "./server/types";
import { listen_to_keys } from "./shell/keys";
import { type Probe, probe } from "./shell/probe";
import { start_theme } from "./shell/theme";
import { listen_to_drops } from "./start/drop";
import { ask_analyses_again, take_analysis } from "./stiffness/analyses";
import { refresh } from "./state/jobs";
import { report } from "./state/notices";
import {
    build_progress,
    examples,
    machines,
    path,
    ready,
    saved_text,
    starting,
    table,
    text,
    unsaved,
    version,
} from "./state/store";

declare global {
    interface Window {
        __studio: Probe;
    }
}

/** Returns false when the server refuses this page: then there is nothing to listen to. */
async function load(): Promise<boolean> {
    try {
        const [settings, recipe, known, shown, about] = await Promise.all([
            get_table(),
            get_recipe(),
            get_machines(),
            get_examples(),
            get_version(),
        ]);
        batch(() => {
            table.value = settings;
            machines.value = known;
            examples.value = shown;
            version.value = about;
            text.value = recipe.text;
            path.value = recipe.path;
            saved_text.value = recipe.saved ? recipe.text : "";
            starting.value = !recipe.text.trim();
            ready.value = true;
        });
        refresh();
        void ask_for_print();
        void ask_for_sending();
    } catch (error) {
        if (error instanceof Failure && error.status === 0) away.value = true;
        report(error);
        return !(error instanceof Failure && error.status === 401);
    }
    return true;
}

window.__studio = probe;
start_theme();
const room = document.getElementById("page")!;
room.replaceChildren();
render(<App />, room);
listen_to_keys();
listen_to_drops();
addEventListener("beforeunload", (event) => {
    if (unsaved.value && text.value.trim()) event.preventDefault();
});
addEventListener("pagehide", () => end_session());
const listener = {
    back: () => {
        if (!ready.value) {
            void load();
            return;
        }
        refresh(); // a server that was started anew has lost its jobs
        void ask_again();
        void ask_for_print();
        void ask_for_sending();
        void ask_analyses_again();
    },
    progress: ({ what, done, of, text: doing }: Progress) => {
        if (what === "build") build_progress.value = { done, of, text: doing };
        else if (what === "check" && check_progress.value) check_progress.value = { done, of };
    },
    output: take_output,
    print: take_print,
    print_message: take_message,
    sending: take_sending,
    analysis: take_analysis,
};
void load().then((welcome) => {
    if (welcome) listen(listener);
});
