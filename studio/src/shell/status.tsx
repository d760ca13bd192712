// The status line: what the recipe makes, in numbers, and what is wrong with it.
import { curve, volume_of } from "../layers/curves";
import { PrintWord } from "../print/status_word";
import {
    build_progress,
    building,
    edit_mistakes,
    job,
    left_mode,
    mistakes,
    needs_search,
    starting,
    tab,
    wanted_line,
} from "../state/store";

function Numbers() {
    const made = job.value;
    if (starting.value) return null;
    if (!made) return <span>No part yet.</span>;
    const { lo, hi } = made.bounds;
    const size = lo.map((one, k) => (hi[k]! - one).toFixed(1)).join(" × ");
    const heights = made.layers.heights.map(([, height]) => height);
    const least = Math.min(...heights),
        most = Math.max(...heights);
    const height = least === most ? String(+least.toFixed(4)) : `${+least.toFixed(4)} to ${+most.toFixed(4)}`;
    const got = curve.value;
    const volume = got && got.job.job === made.job ? volume_of(got) : null;
    const ml = (mm3: number) => `${Number((mm3 / 1000).toPrecision(3))} ml`;
    return (
        <>
            <b>{made.name}</b>
            <span>{made.machine}</span>
            <span>{size} mm</span>
            <span>
                {made.layers.count} layers of {height} mm
            </span>
            {volume && (
                <span>
                    {ml(volume.part)}
                    {made.supports && volume.supports > 0 && ` and ${ml(volume.supports)} of supports`}
                </span>
            )}
            {made.notes[0] && (
                <span class="note" title={made.notes.join("\n")}>
                    {made.notes[0]}
                </span>
            )}
        </>
    );
}

export function StatusLine() {
    const wrong = mistakes.value.length + edit_mistakes.value.length;
    const show_first = () => {
        tab.value = "design";
        starting.value = false;
        const line = mistakes.value.find((one) => one.line !== null)?.line;
        if (!line) return;
        left_mode.value = "text";
        wanted_line.value = { line };
    };
    const progress = build_progress.value;
    const share = progress && progress.of > 0 ? ` ${Math.round((100 * progress.done) / progress.of)} %` : "";
    return (
        <footer class="status">
            <Numbers />
            <span class="grow" />
            <PrintWord />
            <span class="state" role="status">
                {building.value ? (
                    `${progress?.text || "computing"}${share}…`
                ) : wrong ? (
                    <button class="link wrong" onClick={show_first}>
                        {wrong === 1 ? "1 mistake" : `${wrong} mistakes`}
                    </button>
                ) : needs_search.value ? (
                    "not optimised yet"
                ) : job.value ? (
                    "up to date"
                ) : (
                    ""
                )}
            </span>
        </footer>
    );
}
