// The curve of the temperatures; the numbers beside it say the same to those who do not see it.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { plain_axis, plot_colour } from "../shell/plot_style";
import { dark } from "../shell/theme";
import { type Sample, samples } from "./temperatures";

/** Between two marks, s. */
const time_steps = [10, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 14400, 28800, 86400];

function time_text(seconds: number): string {
    const minutes = seconds / 60;
    return minutes < 120 ? `${+minutes.toFixed(1)} min` : `${+(minutes / 60).toFixed(1)} h`;
}

function data_of(all: Sample[]): uPlot.AlignedData {
    const target = (value: number) => (value > 0 ? value : null);
    return [
        all.map((one) => one.at),
        all.map((one) => one.nozzle),
        all.map((one) => target(one.nozzle_target)),
        all.map((one) => one.bed),
        all.map((one) => target(one.bed_target)),
    ];
}

function options_of(width: number, height: number): uPlot.Options {
    const axis = plain_axis();
    const line = (label: string, name: string): uPlot.Series => ({
        label,
        stroke: plot_colour(name),
        width: 1.5,
        points: { show: false },
    });
    const target = (label: string, name: string): uPlot.Series => ({
        ...line(label, name),
        width: 1,
        dash: [4, 3],
    });
    return {
        width,
        height,
        padding: [8, 8, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        series: [
            {},
            line("nozzle", "--nozzle"),
            target("nozzle, asked for", "--nozzle"),
            line("bed", "--bed"),
            target("bed, asked for", "--bed"),
        ],
        scales: {
            x: { time: false, range: (_, lo, hi) => [lo ?? 0, Math.max(hi ?? 0, (lo ?? 0) + 30)] },
            y: { range: (_, __, hi) => [0, Math.max(50, (hi ?? 0) * 1.1)] },
        },
        axes: [
            { ...axis, size: 24, space: 60, incrs: time_steps, values: (_, ticks) => ticks.map(time_text) },
            { ...axis, size: 44, space: 28, values: (_, ticks) => ticks.map((tick) => `${tick} °C`) },
        ],
    };
}

export function TemperaturePlot() {
    const room = useRef<HTMLDivElement>(null);
    useEffect(() => {
        const shown_in = room.current!;
        let plot: uPlot | null = null;
        const make = () => {
            plot?.destroy();
            plot = null;
            const { width, height } = shown_in.getBoundingClientRect();
            if (width < 60 || height < 40) return;
            plot = new uPlot(options_of(Math.floor(width), Math.floor(height)), data_of(samples.peek()), shown_in);
        };
        const watcher = new ResizeObserver(make);
        watcher.observe(shown_in);
        const stop_theme = effect(() => {
            void dark.value;
            make();
        });
        const stop_data = effect(() => {
            const data = data_of(samples.value);
            plot?.setData(data);
        });
        return () => {
            watcher.disconnect();
            stop_theme();
            stop_data();
            plot?.destroy();
        };
    }, []);
    return <div class="temperature-plot" ref={room} aria-hidden="true" />;
}
