// A figure of the layers over the height, with a marker at the layer that is shown. A click goes to a layer.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import type { Job } from "../server/types";
import { plain_axis, plot_colour } from "../shell/plot_style";
import { Segments } from "../shell/segments";
import { dark } from "../shell/theme";
import { layer_at, slab_of } from "../state/heights";
import { job, layer } from "../state/store";
import { counted, curve, curve_choice, type CurveChoice, has_times, load_curves } from "./curves";

/** The figures of a curve, of so many layers each. */
interface Figures {
    of: CurveChoice;
    job: Job;
    each: number;
    values: number[][];
}

function figures_now(): Figures | null {
    const areas = curve.value,
        other = counted.value;
    const of = curve_choice.value;
    if (of === "area") {
        if (!areas) return null;
        const { layers_a_value, area_mm2, support_area_mm2 } = areas.curve;
        const values = areas.job.supports ? [area_mm2, support_area_mm2] : [area_mm2];
        return { of, job: areas.job, each: layers_a_value, values };
    }
    const got = of === "islands" ? other?.islands : other?.times;
    if (!other || !got) return null;
    const values = "islands" in got ? got.islands : got.seconds;
    return { of, job: other.job, each: got.layers_a_value, values: [values] };
}

/** The heights of the layers in the middle of those that share a value. */
function heights_of({ job: made, each, values }: Figures): number[] {
    return values[0]!.map((_, i) => {
        const { begin, height } = slab_of(
            made,
            Math.min(made.layers.count - 1, i * each + Math.floor(each / 2)),
        );
        return begin + height / 2;
    });
}

function draw_marker(plot: uPlot): void {
    const made = job.value;
    if (!made) return;
    const { begin, height } = slab_of(made, layer.peek());
    const x = plot.valToPos(begin + height / 2, "x", true);
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.setLineDash([]);
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--view-layer");
    ctx.lineWidth = 2 * devicePixelRatio;
    ctx.stroke();
    ctx.restore();
}

const units: Record<CurveChoice, string> = { area: " mm²", islands: "", time: " s" };

function series_of({ of, values }: Figures): uPlot.Series[] {
    const main: uPlot.Series = {
        label: of,
        stroke: plot_colour("--accent"),
        width: 1.5,
        fill: plot_colour("--accent-fill"),
        points: { show: false },
    };
    if (of === "islands") {
        main.paths = uPlot.paths.bars!({ size: [0.9, 8, 2] });
        main.fill = main.stroke;
    }
    const supports = { label: "supports", stroke: "#598fcc", width: 1.2, dash: [4, 3], points: { show: false } };
    return values.length > 1 ? [{}, main, supports] : [{}, main];
}

function options_of(figures: Figures, width: number, height: number): uPlot.Options {
    const axis = plain_axis();
    const whole = figures.of === "islands";
    return {
        width,
        height,
        series: series_of(figures),
        padding: [8, 26, 0, 0],
        legend: { show: false },
        cursor: { y: false, drag: { x: false, y: false }, points: { size: 6 } },
        scales: {
            x: { time: false, range: [0, figures.job.layers.height_mm] },
            y: { range: (_, __, hi) => [0, (hi || 1) * 1.08] },
        },
        axes: [
            { ...axis, size: 24, space: 60, values: (_, ticks) => ticks.map((tick) => `${tick} mm`) },
            {
                ...axis,
                size: 52,
                space: 26,
                ...(whole ? { incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000] } : {}),
                values: (_, ticks) => ticks.map((tick) => `${tick}${units[figures.of]}`),
            },
        ],
        hooks: { draw: [draw_marker] },
    };
}

const choices: { word: CurveChoice; label: string; title: string }[] = [
    { word: "area", label: "area", title: "Area of each layer" },
    { word: "islands", label: "islands", title: "Pieces of a layer that begin with nothing below them" },
    { word: "time", label: "time", title: "Time that each layer takes" },
];

const duration = (seconds: number) => {
    const minutes = Math.round(seconds / 60);
    return minutes < 60 ? `${minutes} min` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
};

/** What the figures come to; or why there are none. */
function summary(): string {
    const made = job.value;
    const of = curve_choice.value;
    if (!made) return "";
    if (of === "time" && !has_times(made))
        return `${made.machine}: no time of its layers is known, as of machines for filament and resin`;
    const got = figures_now();
    if (!got || got.job.job !== made.job) return of === "area" ? "over the height" : "computing…";
    const sum = got.values[0]!.reduce((all, value) => all + value, 0);
    if (of === "islands") return `${sum || "no"} ${sum === 1 ? "piece begins" : "pieces begin"} with nothing below`;
    if (of === "area") return "over the height";
    const all = got.values[0]!.reduce(
        (total, value, i) => total + value * (Math.min(made.layers.count, (i + 1) * got.each) - i * got.each),
        0,
    );
    const about = got.each > 1 ? "about " : "";
    return `of layers: ${about}${duration(all)} in all${made.process === "filament" ? ", without ways between layers" : ""}`;
}

export function CurvePane() {
    const room = useRef<HTMLDivElement>(null);
    useEffect(() => load_curves(), []);
    useEffect(() => {
        const shown_in = room.current!;
        let plot: uPlot | null = null;
        const go = (event: MouseEvent) => {
            const made = job.value;
            if (!plot || !made) return;
            const left = event.clientX - plot.over.getBoundingClientRect().left;
            layer.value = layer_at(made, plot.posToVal(left, "x"));
        };
        const make = () => {
            plot?.destroy();
            plot = null;
            const got = figures_now();
            const box = shown_in.getBoundingClientRect();
            if (!got || box.width < 60 || box.height < 40) return;
            plot = new uPlot(
                options_of(got, Math.floor(box.width), Math.floor(box.height)),
                [heights_of(got), ...got.values],
                shown_in,
            );
            plot.over.addEventListener("click", go);
        };
        const watcher = new ResizeObserver(make);
        watcher.observe(shown_in);
        const stop_data = effect(() => {
            void dark.value;
            void curve.value;
            void counted.value;
            void curve_choice.value;
            make();
        });
        const stop_layer = effect(() => {
            void layer.value;
            plot?.redraw(false);
        });
        return () => {
            watcher.disconnect();
            stop_data();
            stop_layer();
            plot?.destroy();
        };
    }, []);
    return (
        <section class="curve" aria-label="Figures of the layers over the height">
            <div class="curve-name">
                <Segments
                    label="Curve over the layers"
                    choices={choices}
                    value={curve_choice.value}
                    choose={(word) => {
                        curve_choice.value = word;
                    }}
                />
                <span role="status">{summary()}</span>
            </div>
            <div class="curve-room" ref={room} aria-hidden="true" />
        </section>
    );
}
