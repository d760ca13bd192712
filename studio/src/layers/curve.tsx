// The area of the layers over the height, with a marker at the layer that is shown. A click goes to a layer.
import { effect, signal, untracked } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { get_curve } from "../server/api";
import { Latest } from "../server/latest";
import type { Curve, Job } from "../server/types";
import { layer_at, slab_of } from "../state/heights";
import { job, layer } from "../state/store";
import { plain_axis, plot_colour } from "../shell/plot_style";
import { dark } from "../shell/theme";
import { after_layer } from "./layer_first";

export const curve = signal<{ job: Job; curve: Curve } | null>(null);

/** Volume of part and supports by the curve, mm3. */
export function volume_of({ job: made, curve: got }: { job: Job; curve: Curve }): {
    part: number;
    supports: number;
} {
    const sum = (areas: number[]) =>
        areas.reduce((all, area, i) => {
            const first = i * got.layers_a_value;
            const next = Math.min(made.layers.count, first + got.layers_a_value);
            const thick =
                slab_of(made, next - 1).begin + slab_of(made, next - 1).height - slab_of(made, first).begin;
            return all + area * thick;
        }, 0);
    return { part: sum(got.area_mm2), supports: sum(got.support_area_mm2) };
}

function data_of({ job: made, curve: got }: { job: Job; curve: Curve }): uPlot.AlignedData {
    const each = got.layers_a_value; // the one in the middle of them is measured
    const heights = got.area_mm2.map((_, i) => {
        const { begin, height } = slab_of(
            made,
            Math.min(made.layers.count - 1, i * each + Math.floor(each / 2)),
        );
        return begin + height / 2;
    });
    return made.supports ? [heights, got.area_mm2, got.support_area_mm2] : [heights, got.area_mm2];
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

function options_of(made: Job, width: number, height: number): uPlot.Options {
    const axis = plain_axis();
    const series: uPlot.Series[] = [
        {},
        {
            label: "part",
            stroke: plot_colour("--accent"),
            width: 1.5,
            fill: plot_colour("--accent-fill"),
            points: { show: false },
        },
    ];
    if (made.supports)
        series.push({
            label: "supports",
            stroke: "#598fcc",
            width: 1.2,
            dash: [4, 3],
            points: { show: false },
        });
    return {
        width,
        height,
        series,
        padding: [8, 26, 0, 0],
        legend: { show: false },
        cursor: { y: false, drag: { x: false, y: false }, points: { size: 6 } },
        scales: {
            x: { time: false, range: [0, made.layers.height_mm] },
            y: { range: (_, __, hi) => [0, (hi || 1) * 1.08] },
        },
        axes: [
            { ...axis, size: 24, space: 60, values: (_, ticks) => ticks.map((tick) => `${tick} mm`) },
            { ...axis, size: 52, space: 26, values: (_, ticks) => ticks.map((tick) => `${tick} mm²`) },
        ],
        hooks: { draw: [draw_marker] },
    };
}

function load_curves(): () => void {
    const latest = new Latest();
    let call_off = () => {};
    const stop = effect(() => {
        const made = job.value;
        call_off();
        if (!made) {
            curve.value = null;
            return;
        }
        call_off = untracked(() =>
            after_layer(made, () =>
                latest.run(async (signal) => {
                    curve.value = { job: made, curve: await get_curve(made, signal) };
                }),
            ),
        );
    });
    return () => {
        stop();
        call_off();
        latest.cancel();
    };
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
            const got = curve.value;
            const box = shown_in.getBoundingClientRect();
            if (!got || box.width < 60 || box.height < 40) return;
            plot = new uPlot(
                options_of(got.job, Math.floor(box.width), Math.floor(box.height)),
                data_of(got),
                shown_in,
            );
            plot.over.addEventListener("click", go);
        };
        const watcher = new ResizeObserver(make);
        watcher.observe(shown_in);
        const stop_data = effect(() => {
            void dark.value;
            void curve.value;
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
        <section class="curve" aria-label="Area of the layers over the height">
            <div class="curve-name">
                Area of the layers <span>over the height</span>
            </div>
            <div class="curve-room" ref={room} aria-hidden="true" />
        </section>
    );
}
