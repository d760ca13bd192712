// The look of charts, from the style sheet, so that they follow the theme.
import type uPlot from "uplot";

export function plot_colour(name: string): string {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** What all axes share. */
export function plain_axis(): uPlot.Axis {
    return {
        stroke: plot_colour("--ink-soft"),
        font: "11px system-ui, sans-serif",
        ticks: { show: false },
        grid: { stroke: plot_colour("--line-soft"), width: 1 },
    };
}
