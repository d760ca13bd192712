// The part of the print tab that sends to printers on the network, and shows what they do.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { HostFacts, HostStatus, Sending } from "../server/types";
import { job } from "../state/store";
import {
    choose_host,
    chosen,
    facts,
    follow_host,
    hosts,
    order,
    refresh_hosts,
    send,
    sending,
    stop_sending,
    trouble,
} from "./network";
import { time_text } from "./state_card";

const megabyte = 1e6;

/** "3.1 of 9.3 MB" or, where the size is not known before, "3.1 MB, layer 80 of 190". */
export function sent_text({ bytes, of_bytes, layers, of_layers }: Sending): string {
    const megabytes = (bytes / megabyte).toFixed(1);
    if (of_bytes !== null) return `${megabytes} of ${(of_bytes / megabyte).toFixed(1)} MB`;
    return bytes > 0 ? `${megabytes} MB, layer ${layers} of ${of_layers}` : `layer ${layers} of ${of_layers}`;
}

const share_of = ({ bytes, of_bytes, layers, of_layers }: Sending): number =>
    of_bytes ? bytes / of_bytes : layers / of_layers;

function SendingCard({ shown }: { shown: Sending }) {
    const runs = shown.state === "running";
    const head = {
        running: `Sending to ${shown.host}`,
        done: shown.prints ? `${shown.host} prints ${shown.file}` : `${shown.file} is at ${shown.host}`,
        failed: `Not sent to ${shown.host}`,
        cancelled: `Sending to ${shown.host} was stopped`,
    }[shown.state];
    return (
        <div class={`print-card ${shown.state === "cancelled" ? "stopped" : shown.state}`} aria-live="polite">
            <p class="print-head">{head}</p>
            {runs && (
                <>
                    <progress max={1} value={share_of(shown)} aria-label="Sent" />
                    <p>{sent_text(shown)}</p>
                </>
            )}
            {shown.message && <p class={shown.state === "failed" ? "wrong" : "soft"}>{shown.message}</p>}
            {runs && (
                <div class="print-buttons">
                    <button type="button" onClick={() => void stop_sending()}>
                        Stop sending
                    </button>
                </div>
            )}
        </div>
    );
}

function StatusCard({ status }: { status: HostStatus }) {
    const active = status.state === "printing" || status.state === "paused";
    const parts = [
        status.progress === undefined || !active ? "" : `${Math.round(status.progress * 100)} %`,
        status.layer === undefined || !active ? "" : `layer ${status.layer} of ${status.layers ?? "?"}`,
        status.left_s === undefined || !active ? "" : `${time_text(status.left_s)} left`,
        ...(status.heaters ?? []).map(
            ({ name, now, target }) =>
                `${name} ${now.toFixed(0)}${target > 0 ? ` of ${target.toFixed(0)}` : ""} °C`,
        ),
    ].filter(Boolean);
    return (
        <div class={`print-card ${status.state}`}>
            <p class="print-head">
                <span>{status.state}</span> {status.file}
            </p>
            {active && status.progress !== undefined && (
                <progress max={1} value={status.progress} aria-label="Printed" />
            )}
            {parts.length > 0 && <p>{parts.join(" · ")}</p>}
            {status.message && <p class="soft">{status.message}</p>}
            {active && (
                <div class="print-buttons">
                    {status.state === "printing" ? (
                        <button type="button" onClick={() => void order("pause")}>
                            Pause
                        </button>
                    ) : (
                        <button type="button" class="primary" onClick={() => void order("resume")}>
                            Resume
                        </button>
                    )}
                    <button type="button" class="danger" onClick={() => void order("cancel")}>
                        Cancel the print
                    </button>
                </div>
            )}
        </div>
    );
}

function about_text({ software, machine, free_bytes, encrypted }: HostFacts): string {
    const free = free_bytes === undefined ? "" : `${Math.round(free_bytes / megabyte).toLocaleString("en")} MB free`;
    return [software, machine, free, encrypted ? "" : "not encrypted"].filter(Boolean).join(" · ");
}

export function NetworkPart() {
    const starts = useSignal(true);
    useEffect(() => {
        void refresh_hosts();
    }, []);
    const name = chosen.value;
    useEffect(() => follow_host(name), [name]);
    const known = hosts.value;
    if (!known) return null;
    const busy = sending.value?.state === "running";
    return (
        <>
            <h2>On the network</h2>
            {known.hosts.length === 0 ? (
                <p class="soft print-hint">
                    No printer on the network is known. Name some in {known.file}; <code>lamella hosts --help</code>{" "}
                    shows how.
                </p>
            ) : (
                <form
                    onSubmit={(event) => {
                        event.preventDefault();
                        void send(starts.value);
                    }}
                >
                    <div class="print-row">
                        <label for="print-host">Printer</label>
                        <select
                            id="print-host"
                            value={name}
                            onChange={(event) => choose_host(event.currentTarget.value)}
                        >
                            {known.hosts.map((one) => (
                                <option key={one.name} value={one.name} title={one.url}>
                                    {one.name} · {one.kind}
                                </option>
                            ))}
                        </select>
                    </div>
                    {facts.value && <p class="soft print-hint">{about_text(facts.value)}</p>}
                    {trouble.value && <p class="outcome fail print-refused">{trouble.value}</p>}
                    <label class="check">
                        <input
                            type="checkbox"
                            checked={starts.value}
                            onChange={(event) => (starts.value = event.currentTarget.checked)}
                        />
                        print it once it is there
                    </label>
                    <div class="print-buttons">
                        <button class="primary" disabled={busy || !job.value || !facts.value}>
                            {starts.value ? "Send and print" : "Send"}
                        </button>
                    </div>
                </form>
            )}
            {sending.value && <SendingCard shown={sending.value} />}
            {facts.value && <StatusCard status={facts.value.status} />}
        </>
    );
}
