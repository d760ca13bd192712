// How far the print is, and the buttons that steer it.
import { useSignal } from "@preact/signals";
import type { Print, Temperatures } from "../server/types";
import { job } from "../state/store";
import { choose, follows, is_running, order, show_printed } from "./print";
import { samples } from "./temperatures";
import { TemperaturePlot } from "./temperature_plot";

const words: Record<Print["state"], string> = {
    connecting: "Connecting",
    printing: "Printing",
    paused: "Paused",
    stopping: "Stopping",
    done: "Done",
    stopped: "Stopped",
    failed: "Failed",
};

export function time_text(seconds: number): string {
    const minutes = Math.round(seconds / 60);
    if (minutes < 1) return "less than a minute";
    if (minutes < 60) return `${minutes} min`;
    return `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min`;
}

/** "printing 12 of 80, computed 31", as layers are counted from 1. */
export function progress_text({ layer, layers, layers_computed }: Print): string {
    const computed = `computed ${layers_computed} of ${layers}`;
    return layer === null ? `Layers: ${computed}` : `Layer ${layer + 1} of ${layers}, ${computed}`;
}

function Heat({ name, is, wanted, kind }: { name: string; is: number; wanted: number; kind: string }) {
    return (
        <div class={`heat ${kind}`}>
            <dt>{name}</dt>
            <dd>
                <b>{is.toFixed(0)}</b> {wanted > 0 ? `of ${wanted.toFixed(0)}` : ""} °C
                {wanted === 0 && <span class="soft"> off</span>}
            </dd>
        </div>
    );
}

function Heats({ nozzle, nozzle_target, bed, bed_target }: Temperatures) {
    return (
        <dl class="heats">
            <Heat kind="nozzle" name="Nozzle" is={nozzle} wanted={nozzle_target} />
            <Heat kind="bed" name="Bed" is={bed} wanted={bed_target} />
        </dl>
    );
}

function Question({ question }: { question: NonNullable<Print["question"]> }) {
    return (
        <div class="print-question" role="alert">
            <p>
                The printer waits for you: <b>{question.text}</b>
            </p>
            <div class="print-buttons">
                {question.buttons.map((label, i) => (
                    <button key={i} onClick={() => void choose(i)}>
                        {label}
                    </button>
                ))}
                {question.buttons.length === 0 && <button onClick={() => void order("resume")}>Done</button>}
            </div>
        </div>
    );
}

/** Stop asks once more; halt never does. */
function Orders({ shown }: { shown: Print }) {
    const asks = useSignal(false);
    const { state } = shown;
    if (asks.value && state !== "stopping")
        return (
            <div class="print-buttons" role="group" aria-label="Stop the print?">
                <button
                    class="primary"
                    onClick={() => {
                        asks.value = false;
                        void order("stop");
                    }}
                >
                    Stop the print
                </button>
                <button
                    onClick={() => {
                        asks.value = false;
                    }}
                >
                    Go on
                </button>
            </div>
        );
    return (
        <div class="print-buttons">
            {state === "paused" ? (
                <button class="primary" onClick={() => void order("resume")}>
                    Resume
                </button>
            ) : (
                <button disabled={state !== "printing"} onClick={() => void order("pause")}>
                    Pause
                </button>
            )}
            <button
                disabled={state === "stopping"}
                title="Ends the print: nozzle parked, heaters off. It can be resumed later."
                onClick={() => {
                    asks.value = true;
                }}
            >
                Stop…
            </button>
            <button
                class="danger"
                title={
                    shown.halts_at_once
                        ? "Halts the machine at once (M112); it has to be reset before it prints again"
                        : "This machine has no emergency parser: its board is reset, where the port can do so"
                }
                onClick={() => void order("halt")}
            >
                Halt
            </button>
        </div>
    );
}

function Follow({ shown }: { shown: Print }) {
    if (shown.job !== job.value?.job) return <p class="soft">The page shows another recipe meanwhile.</p>;
    return (
        <label class="check">
            <input
                type="checkbox"
                checked={follows.value}
                onChange={(event) => {
                    follows.value = event.currentTarget.checked;
                    if (follows.value) show_printed();
                }}
            />
            show the layer that is printed
        </label>
    );
}

export function StateCard({ shown }: { shown: Print }) {
    const runs = is_running(shown);
    const { state, doing, seconds_left, share, layers, layer } = shown;
    const done = share ?? (layer === null ? 0 : layer / layers);
    return (
        <section class={`print-card ${state}`} aria-label="Print">
            <div class="print-head">
                <b role="status">{doing && state === "printing" ? `Printing, ${doing}` : words[state]}</b>
                <span class="soft">
                    {shown.name} · {shown.to.serial.replace("/dev/", "")}
                </span>
            </div>
            {(runs || state === "done") && (
                <progress max={1} value={state === "done" ? 1 : done} aria-label="Printed share" />
            )}
            <p class="print-numbers">
                {progress_text(shown)}
                {seconds_left !== null && runs && ` · ${time_text(seconds_left)} left`}
            </p>
            {runs && state !== "connecting" && (
                <p class="soft print-numbers">
                    {shown.lines} lines, {shown.lines_a_second.toFixed(0)} lines/s,{" "}
                    {(shown.bytes_a_second / 1000).toFixed(1)} kB/s
                </p>
            )}
            {!runs && shown.message && <p class={state === "failed" ? "wrong" : "soft"}>{shown.message}</p>}
            {shown.question && <Question question={shown.question} />}
            {runs && <Orders shown={shown} />}
            {shown.temperatures && state !== "connecting" && (
                <>
                    {!runs && <p class="soft">Temperatures when it ended:</p>}
                    <Heats {...shown.temperatures} />
                    {samples.value.length > 1 && <TemperaturePlot />}
                </>
            )}
            {runs && <Follow shown={shown} />}
        </section>
    );
}
