// Where and how to print, as the user chose it last; and what the server says of the job.
import { effect, signal } from "@preact/signals";
import { get_outlook, get_ports } from "../server/api";
import { Latest } from "../server/latest";
import type { Outlook, Port, PrintRequest } from "../server/types";
import { report } from "../state/notices";
import { job } from "../state/store";
import { running } from "./print";

export const bauds = [250000, 115200, 57600, 230400, 500000, 921600, 1000000];

export interface Setup {
    port: string;
    baud: number;
    /** X and Y in mm; empty: the usual place. */
    park: string;
    reset: boolean;
    ping_pong: boolean;
}

const kept_as = "lamella-print";
const usual: Setup = { port: "", baud: 250000, park: "", reset: false, ping_pong: false };

function kept_setup(): Setup {
    try {
        return { ...usual, ...(JSON.parse(localStorage.getItem(kept_as) ?? "{}") as Partial<Setup>) };
    } catch {
        return usual;
    }
}

export const setup = signal<Setup>(kept_setup());

export function change_setup(change: Partial<Setup>): void {
    setup.value = { ...setup.value, ...change };
    localStorage.setItem(kept_as, JSON.stringify(setup.value));
}

/** Null: not asked for yet. */
export const ports = signal<Port[] | null>(null);

export async function refresh_ports(): Promise<void> {
    try {
        const found = await get_ports();
        ports.value = found;
        if (!setup.value.port && found[0]) change_setup({ port: found[0].by_id || found[0].path });
    } catch (error) {
        report(error);
    }
}

/** Returns the place in a text such as "0, 200"; null where it is none. */
export function place_of(text: string): [number, number] | null {
    const numbers = text
        .split(/[\s,;]+/)
        .filter(Boolean)
        .map(Number);
    return numbers.length === 2 && numbers.every(Number.isFinite) ? [numbers[0]!, numbers[1]!] : null;
}

export function request_of(how: { resume?: boolean; discard_journal?: boolean }): PrintRequest {
    const { port, baud, park, reset, ping_pong } = setup.value;
    const place = place_of(park);
    return {
        to: { serial: port.trim(), baud, ...(reset && { reset }), ...(ping_pong && { ping_pong }) },
        ...(place && { park: place }),
        ...how,
    };
}

export const outlook = signal<{ job: string; outlook: Outlook } | null>(null);

/** Asks what can be done with the job: when another one is shown, and when a print begins or ends. */
export function follow_outlook(): () => void {
    const latest = new Latest();
    const stop = effect(() => {
        const made = job.value;
        void running.value;
        if (!made) {
            outlook.value = null;
            return;
        }
        latest.run(async (signal) => {
            outlook.value = { job: made.job, outlook: await get_outlook(made, signal) };
        });
    });
    return () => {
        stop();
        latest.cancel();
    };
}
