// Printers on the network: which there are, what the chosen one does, and the job on its way to one.
import { signal } from "@preact/signals";
import {
    cancel_sending,
    get_host,
    get_host_status,
    get_hosts,
    get_sending,
    order_host,
    send_job,
} from "../server/api";
import { Failure } from "../server/http";
import type { Host, HostFacts, Sending } from "../server/types";
import { report } from "../state/notices";
import { job } from "../state/store";

const kept_as = "lamella-host";
const every_ms = 2000;

/** Null: not asked for yet. `file` is where hosts are named. */
export const hosts = signal<{ file: string; hosts: Host[] } | null>(null);
export const chosen = signal(localStorage.getItem(kept_as) ?? "");
/** What the chosen host says of itself; null before it has answered. */
export const facts = signal<HostFacts | null>(null);
/** Why the chosen host says nothing. */
export const trouble = signal("");
export const sending = signal<Sending | null>(null);

export function choose_host(name: string): void {
    chosen.value = name;
    localStorage.setItem(kept_as, name);
}

export async function refresh_hosts(): Promise<void> {
    try {
        const told = await get_hosts();
        hosts.value = told;
        if (!told.hosts.some((one) => one.name === chosen.value)) choose_host(told.hosts[0]?.name ?? "");
    } catch (error) {
        report(error);
    }
}

/** A host's own failures are told beside it: they are none of the page. */
function take_trouble(error: unknown): void {
    if (error instanceof Failure && error.status === 502) trouble.value = error.message;
    else report(error);
}

/** Asks the chosen host what it does, again and again; returns what ends it. */
export function follow_host(name: string): () => void {
    let timer = 0;
    const ended = new AbortController();
    const ask = async (): Promise<void> => {
        try {
            if (!facts.value) facts.value = await get_host(name, ended.signal);
            else facts.value = { ...facts.value, status: await get_host_status(name) };
            trouble.value = "";
        } catch (error) {
            if (ended.signal.aborted) return;
            facts.value = null;
            take_trouble(error);
        }
        if (!ended.signal.aborted) timer = window.setTimeout(() => void ask(), every_ms);
    };
    facts.value = null;
    trouble.value = "";
    if (name) void ask();
    return () => {
        ended.abort();
        clearTimeout(timer);
    };
}

export async function order(what: "pause" | "resume" | "cancel"): Promise<void> {
    try {
        const status = await order_host(chosen.value, what);
        if (facts.value) facts.value = { ...facts.value, status };
    } catch (error) {
        take_trouble(error);
    }
}

export function take_sending(told: Sending): void {
    sending.value = told;
}

export async function ask_for_sending(): Promise<void> {
    try {
        const told = await get_sending();
        sending.value = told.state === "none" ? null : told;
    } catch (error) {
        report(error);
    }
}

export async function send(start: boolean): Promise<void> {
    if (!job.value) return;
    try {
        take_sending(await send_job(job.value, chosen.value, start));
    } catch (error) {
        report(error);
    }
}

export async function stop_sending(): Promise<void> {
    try {
        take_sending(await cancel_sending());
    } catch (error) {
        report(error);
    }
}
