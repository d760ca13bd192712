// The faults that a check has found, as a list of places to go to.
import { computed, signal } from "@preact/signals";
import type { Check, Job, Place, Triple } from "../server/types";
import { clamp_layer } from "../state/heights";
import { job, layer, report_of_check } from "../state/store";

export interface Fault {
    name: string;
    check: string;
    verdict: string;
    size: string;
    place: Place;
}

const units: Record<string, string> = { mm: "mm", mm2: "mm²", mm3: "mm³" };

/** The size of a place with its unit, from the field that the unit names. */
function size_of(place: Place): string {
    for (const [unit, shown] of Object.entries(units)) {
        const size = place[`size_${unit}`];
        if (typeof size === "number") return `${Number(size.toPrecision(3))} ${shown}`;
    }
    return "";
}

/** Failed checks first, then warnings, then what is fine. */
export function by_severity(checks: Check[]): Check[] {
    const rank = (one: Check) => (one.passed ? 2 : one.verdict === "fail" ? 0 : 1);
    return [...checks].filter((one) => one.verdict !== "off").sort((a, b) => rank(a) - rank(b));
}

export function faults_of(check: Check): Fault[] {
    return check.worst.map((place, i) => ({
        name: `${check.check} ${i + 1}`,
        check: check.check,
        verdict: check.verdict,
        size: size_of(place),
        place,
    }));
}

/** Whether the report is of the job that is shown. */
export const report_fits = computed(() => report_of_check.value?.job === job.value?.job);

export const faults = computed(() => {
    const checked = report_of_check.value;
    if (!checked || !report_fits.value) return [];
    return by_severity(checked.report.checks)
        .filter((one) => !one.passed)
        .flatMap(faults_of);
});

/** Of the part's largest side: a box that is larger, such as that of a void, is not painted as a whole. */
const most_painted = 0.25;

/** The box that is painted for a fault, mm: what encloses most of the part would hide all others. */
export function painted_box(made: Job, { place }: Fault): { lo: Triple; hi: Triple } {
    const { lo, hi } = made.bounds;
    const largest = Math.max(...hi.map((one, k) => one - lo[k]!));
    const box = place.box_mm;
    if (box && box.hi.every((one, k) => one - box.lo[k]! <= most_painted * largest)) return box;
    const around = (by: number) => place.at_mm.map((one) => one + by * largest) as Triple;
    return { lo: around(-0.02), hi: around(0.02) };
}

export const shown_fault = signal<Fault | null>(null);
/** A place for the layer pane to show; a new object at every request. */
export const wanted_place = signal<{ x: number; y: number; across: number } | null>(null);

/** Shows a fault: its layer, and its place in the layer. */
export function go_to_fault(fault: Fault): void {
    const made = job.value;
    if (!made) return;
    shown_fault.value = fault;
    layer.value = clamp_layer(made, fault.place.layer);
    const box = fault.place.box_mm;
    const across = box ? Math.max(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]) * 4 : 8;
    wanted_place.value = { x: fault.place.at_mm[0], y: fault.place.at_mm[1], across: Math.max(4, across) };
}
