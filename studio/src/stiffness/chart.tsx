// A chart as wide as its place, in the colours of the theme.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { dark } from "../shell/theme";

export const colour = (name: string): string =>
    getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** What all axes have in common. */
export const axis = (): uPlot.Axis => ({
    stroke: colour("--ink-soft"),
    font: "11px system-ui, sans-serif",
    labelFont: "11px system-ui, sans-serif",
    labelSize: 16,
    ticks: { show: false },
    grid: { stroke: colour("--line-soft"), width: 1 },
});

interface Props {
    label: string;
    height: number;
    data: uPlot.AlignedData;
    /** Called anew when the theme changes. */
    options: () => Omit<uPlot.Options, "width" | "height">;
    /** Another word, another chart: while it stays, only the data changes. */
    word: string;
}

export function Chart({ label, height, data, options, word }: Props) {
    const room = useRef<HTMLDivElement>(null);
    const plot = useRef<uPlot | null>(null);
    const latest = useRef(data);
    latest.current = data;
    useEffect(() => {
        const on = room.current!;
        const make = () => {
            plot.current?.destroy();
            plot.current = null;
            const width = Math.floor(on.getBoundingClientRect().width);
            if (width < 60) return;
            plot.current = new uPlot({ ...options(), width, height }, latest.current, on);
        };
        const watcher = new ResizeObserver(make);
        watcher.observe(on);
        const stop = effect(() => {
            void dark.value;
            make();
        });
        return () => {
            watcher.disconnect();
            stop();
            plot.current?.destroy();
            plot.current = null;
        };
    }, [word]);
    useEffect(() => {
        plot.current?.setData(data);
    }, [data]);
    return <div class="chart" role="img" aria-label={label} ref={room} />;
}
