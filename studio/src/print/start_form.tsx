// The form that starts a print: port, speed, and what to do with a print that was stopped.
import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import type { Outlook, Port } from "../server/types";
import { start } from "./print";
import { bauds, change_setup, place_of, ports, refresh_ports, request_of, setup } from "./setup";

const typed = "typed";
/** As the server describes such a port, which has no speed. */
const klipper_socket = "API socket of Klipper";

const name_of = (port: Port): string => port.by_id || port.path;

function PortRow() {
    const types = useSignal(false);
    useEffect(() => {
        void refresh_ports();
    }, []);
    const found = ports.value ?? [];
    const { port } = setup.value;
    const is_listed = found.some((one) => name_of(one) === port);
    const shows_text = types.value || found.length === 0 || (port !== "" && !is_listed);
    return (
        <>
            <div class="print-row">
                <label for="print-port">Port</label>
                <select
                    id="print-port"
                    value={shows_text ? typed : port}
                    onChange={(event) => {
                        const chosen = event.currentTarget.value;
                        types.value = chosen === typed;
                        if (chosen !== typed) change_setup({ port: chosen });
                    }}
                >
                    {found.map((one) => (
                        <option key={one.path} value={name_of(one)} title={name_of(one)}>
                            {one.path.replace("/dev/", "")}
                            {one.description && ` · ${one.description}`}
                        </option>
                    ))}
                    <option value={typed}>another path</option>
                </select>
                <button type="button" onClick={() => void refresh_ports()}>
                    Refresh
                </button>
            </div>
            {shows_text && (
                <div class="print-row">
                    <label for="print-path">Path</label>
                    <input
                        id="print-path"
                        class="mono"
                        placeholder="/dev/ttyUSB0"
                        spellcheck={false}
                        value={port}
                        onInput={(event) => change_setup({ port: event.currentTarget.value })}
                    />
                </div>
            )}
            {ports.value?.length === 0 && (
                <p class="soft print-hint">
                    No serial port found. Is the printer plugged in and switched on?
                </p>
            )}
        </>
    );
}

function MoreRows() {
    const { park, reset, ping_pong } = setup.value;
    const wrong = park.trim() !== "" && !place_of(park);
    return (
        <details class="print-more">
            <summary>More</summary>
            <div class="print-row">
                <label for="print-park">Park at</label>
                <input
                    id="print-park"
                    placeholder="X, Y in mm; usual: the rear left corner"
                    aria-invalid={wrong}
                    value={park}
                    onInput={(event) => change_setup({ park: event.currentTarget.value })}
                />
            </div>
            <label class="check">
                <input
                    type="checkbox"
                    checked={reset}
                    onChange={(event) => change_setup({ reset: event.currentTarget.checked })}
                />
                reset the board first
            </label>
            <label class="check">
                <input
                    type="checkbox"
                    checked={ping_pong}
                    onChange={(event) => change_setup({ ping_pong: event.currentTarget.checked })}
                />
                send one line at a time
            </label>
        </details>
    );
}

/** What was left of a stopped print of this part's name, in words. */
function left_text(left: NonNullable<Outlook["left"]>): string {
    if (!left.is_of_job) return `${left.journal} is left from a print of another recipe that was stopped.`;
    const next = left.next_layer === null ? "" : ` before layer ${left.next_layer + 1}`;
    return `A print of this part was stopped${next}. It can go on there if the part still stands on the bed.`;
}

export function StartForm({ outlook, layers }: { outlook: Outlook; layers: number }) {
    const { left } = outlook;
    const { port, baud, park } = setup.value;
    const may_start = port.trim() !== "" && (park.trim() === "" || place_of(park) !== null);
    const can_resume = left?.is_of_job === true;
    const is_socket = ports.value?.find((one) => name_of(one) === port)?.description === klipper_socket;
    return (
        <form
            onSubmit={(event) => {
                event.preventDefault();
                if (can_resume) void start(request_of({ resume: true }));
                else void start(request_of(left ? { discard_journal: true } : {}));
            }}
        >
            <PortRow />
            {!is_socket && (
                <div class="print-row">
                    <label for="print-baud">Baud</label>
                    <select
                        id="print-baud"
                        value={baud}
                        onChange={(event) => change_setup({ baud: Number(event.currentTarget.value) })}
                    >
                        {bauds.map((one) => (
                            <option key={one} value={one}>
                                {one}
                            </option>
                        ))}
                    </select>
                </div>
            )}
            <MoreRows />
            {left && <p class="print-left">{left_text(left)}</p>}
            <div class="print-buttons">
                {can_resume && (
                    <button class="primary" disabled={!may_start}>
                        Resume the print
                    </button>
                )}
                <button
                    class={can_resume ? "" : "primary"}
                    type={can_resume ? "button" : "submit"}
                    disabled={!may_start}
                    onClick={() => {
                        if (can_resume) void start(request_of({ discard_journal: true }));
                    }}
                >
                    {left ? "Print from the start" : `Print ${layers} layers`}
                </button>
            </div>
        </form>
    );
}
