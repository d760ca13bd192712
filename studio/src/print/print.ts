// The print that the server runs: its state, messages and temperatures, and requests to it.
import { batch, computed, signal } from "@preact/signals";
import { choose_button, get_print, get_print_messages, order_print, start_print } from "../server/api";
import { Failure } from "../server/http";
import type { Print, PrintMessage, PrintRequest } from "../server/types";
import { notice, report } from "../state/notices";
import { job, layer } from "../state/store";
import { forget_temperatures, note_temperatures } from "./temperatures";

export const print = signal<Print | null>(null);
export const messages = signal<PrintMessage[]>([]);
/** Whether the layer that is looked at is the one that is printed. */
export const follows = signal(false);

export const is_running = (one: Print | null): boolean =>
    one !== null && !["done", "stopped", "failed"].includes(one.state);
export const running = computed(() => is_running(print.value));

const most_messages = 200;

/** Takes over what the server says about a print. */
export function take_print(told: Print): void {
    batch(() => {
        if (print.value?.print !== told.print) forget_temperatures();
        const moved = print.value?.layer !== told.layer;
        print.value = told;
        note_temperatures(told);
        if (follows.value && moved) show_printed();
    });
}

/** Shows the layer that is printed, if it is of the part that is shown. */
export function show_printed(): void {
    const now = print.value;
    if (now?.layer != null && now.job === job.value?.job) layer.value = now.layer;
}

export function take_message(told: PrintMessage): void {
    const known = messages.value[0]?.print === told.print ? messages.value : [];
    if (known.some((one) => one.number === told.number)) return;
    messages.value = [...known, told].slice(-most_messages);
}

/** Asks how far the print is: the page is new, or the line to the server was broken. */
export async function ask_for_print(): Promise<void> {
    try {
        const [told, said] = await Promise.all([get_print(), get_print_messages()]);
        batch(() => {
            messages.value = said;
            if (told.state === "none") print.value = null;
            else take_print(told);
        });
    } catch (error) {
        report(error);
    }
}

/** Shows a failure; a request that comes too late (409) is one here. */
function tell(error: unknown): void {
    if (error instanceof Failure && error.status === 409) notice.value = { text: error.message, kind: "error" };
    else report(error);
}

async function ask(request: Promise<Print>): Promise<void> {
    try {
        take_print(await request);
    } catch (error) {
        tell(error);
    }
}

export async function start(request: PrintRequest): Promise<void> {
    if (job.value) await ask(start_print(job.value, request));
}

export const order = (what: "pause" | "resume" | "stop" | "halt"): Promise<void> => ask(order_print(what));
export const choose = (button: number): Promise<void> => ask(choose_button(button));
