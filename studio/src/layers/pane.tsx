// The layer pane: the scrubber, the numbers of the layer and its picture.
import { signal } from "@preact/signals";
import type { Job } from "../server/types";
import { clamp_layer, slab_of } from "../state/heights";
import { job, layer } from "../state/store";
import { Segments } from "../shell/segments";
import { curve } from "./curves";
import { PathChoice, PathLegend } from "./path_legend";
import { LayerPicture, type LayerMode, mode_of, wanted_mode } from "./picture";
import { Scrubber } from "./scrubber";
import { lines } from "./shown_layer";

const pointer = signal<[number, number] | null>(null);

const modes: Record<LayerMode, { label: string; title: string }> = {
    mask: { label: "mask", title: "Coverage of the pixels" },
    contours: { label: "contours", title: "Outlines of part and supports" },
    paths: { label: "paths", title: "What the nozzle does" },
};

function Numbers({ made }: { made: Job }) {
    const { begin, height } = slab_of(made, layer.value);
    const drawn = lines.value?.layer === layer.value ? lines.value : null;
    const got = curve.value?.job.job === made.job ? curve.value.curve : null;
    const by_curve = got?.area_mm2[Math.floor(layer.value / got.layers_a_value)];
    const exact = drawn?.contours !== undefined || got?.layers_a_value === 1;
    const area = drawn?.contours?.part.area ?? by_curve;
    return (
        <dl class="numbers">
            <div>
                <dt>z</dt>
                <dd>{(begin + height).toFixed(2)} mm</dd>
            </div>
            <div>
                <dt>height</dt>
                <dd>{+height.toFixed(4)} mm</dd>
            </div>
            <div>
                <dt>area</dt>
                <dd>{area === undefined ? "–" : `${exact ? "" : "≈ "}${area.toFixed(1)} mm²`}</dd>
            </div>
            {drawn?.paths && (
                <div>
                    <dt>time</dt>
                    <dd>{drawn.paths.seconds.toFixed(1)} s</dd>
                </div>
            )}
            {pointer.value && (
                <div>
                    <dt>at</dt>
                    <dd>{pointer.value.map((one) => one.toFixed(2)).join(", ")}</dd>
                </div>
            )}
        </dl>
    );
}

export function LayerPane() {
    const made = job.value;
    if (!made)
        return (
            <section class="layers" aria-label="Layer">
                <p class="empty">No layers yet.</p>
            </section>
        );
    const choices = (
        made.process === "filament" ? ["paths", "contours", "mask"] : ["mask", "contours"]
    ) as LayerMode[];
    return (
        <section class="layers" aria-label="Layer">
            <header class="layers-head">
                <label class="layer-number">
                    Layer
                    <input
                        type="number"
                        min="1"
                        max={made.layers.count}
                        value={layer.value + 1}
                        onChange={(event) => {
                            layer.value = clamp_layer(made, event.currentTarget.valueAsNumber - 1 || 0);
                        }}
                    />
                    <span>of {made.layers.count}</span>
                </label>
                <Segments
                    label="What the layer shows"
                    value={mode_of(made)}
                    choices={choices.map((word) => ({ word, ...modes[word] }))}
                    choose={(word) => {
                        wanted_mode.value = word;
                    }}
                />
            </header>
            <Scrubber made={made} />
            {mode_of(made) === "paths" && <PathChoice />}
            <LayerPicture made={made} pointer={pointer} />
            <PathLegend />
            <Numbers made={made} />
        </section>
    );
}
