// Check: what the machine cannot make of the part. A click on a fault goes there.
import { signal } from "@preact/signals";
import { get_check } from "../server/api";
import { Failure } from "../server/http";
import type { Check } from "../server/types";
import { report as report_failure } from "../state/notices";
import { job, report_of_check } from "../state/store";
import { by_severity, type Fault, faults, faults_of, go_to_fault, report_fits, shown_fault } from "./faults";

export const check_progress = signal<{ done: number; of: number } | null>(null);
let running: AbortController | null = null;

async function run_check(): Promise<void> {
    const made = job.value;
    if (!made || running) return;
    running = new AbortController();
    check_progress.value = { done: 0, of: 0 };
    try {
        report_of_check.value = { job: made.job, report: await get_check(made, running.signal) };
        shown_fault.value = null;
    } catch (error) {
        const message =
            error instanceof Failure && error.status === 0
                ? new Error(`Not checked: ${error.message}`)
                : error;
        report_failure(message);
    }
    running = null;
    check_progress.value = null;
}

function Progress() {
    const { done, of } = check_progress.value!;
    return (
        <div class="progress-row">
            <progress max={of || 1} value={of ? done : undefined} aria-label="Progress of the check" />
            <button class="quiet" onClick={() => running?.abort()}>
                cancel
            </button>
        </div>
    );
}

function FaultRow({ fault }: { fault: Fault }) {
    const { at_mm } = fault.place;
    const chosen = shown_fault.value?.name === fault.name;
    return (
        <li>
            <button
                class={`fault${chosen ? " chosen" : ""}`}
                aria-pressed={chosen}
                onClick={() => go_to_fault(fault)}
            >
                <span class="fault-size">{fault.size || "place"}</span>
                <span>layer {fault.place.layer + 1}</span>
                <span class="soft">{at_mm.map((one) => one.toFixed(1)).join(", ")}</span>
            </button>
        </li>
    );
}

const verdicts: Record<string, string> = { fail: "fails", warn: "warning" };

function CheckCard({ check }: { check: Check }) {
    const shown = faults.value.filter((one) => one.check === check.check);
    const list = shown.length ? shown : faults_of(check);
    return (
        <section class={`check-card ${check.passed ? "passed" : check.verdict}`} aria-label={check.check}>
            <header>
                <h3>{check.check}</h3>
                <span class="verdict">
                    {check.passed ? "passed" : (verdicts[check.verdict] ?? check.verdict)}
                </span>
            </header>
            <p class="soft">{check.limit}</p>
            {!check.passed && (
                <ul>
                    {list.map((fault) => (
                        <FaultRow key={fault.name} fault={fault} />
                    ))}
                </ul>
            )}
            {!check.passed && check.count > list.length && (
                <p class="soft">and {check.count - list.length} more</p>
            )}
        </section>
    );
}

export function CheckPanel() {
    const checked = report_of_check.value;
    const made = job.value;
    return (
        <div class="panel">
            <div class="panel-scroll" tabIndex={-1}>
                <h2>Check</h2>
                <p class="soft">
                    Looks for what the machine{made ? ` ${made.machine}` : ""} cannot make: thin walls, loose
                    pieces, overhangs, closed voids.
                </p>
                {check_progress.value ? (
                    <Progress />
                ) : (
                    <button class="primary" disabled={!made} onClick={() => void run_check()}>
                        {checked && report_fits.value ? "Check again" : "Check"}
                    </button>
                )}
                {checked && !report_fits.value && (
                    <p class="hint">The recipe has changed since the last check.</p>
                )}
                {checked && report_fits.value && (
                    <>
                        <p class={`outcome ${checked.report.passed ? "passed" : "fail"}`} role="status">
                            {checked.report.passed
                                ? "The part can be made."
                                : `${faults.value.length} places need a look.`}
                        </p>
                        {by_severity(checked.report.checks).map((one) => (
                            <CheckCard key={one.check} check={one} />
                        ))}
                    </>
                )}
            </div>
        </div>
    );
}
