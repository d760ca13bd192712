// The steps of a search: what it minimises, and the material that it takes.
import uPlot from "uplot";
import type { Step } from "../server/analysis";
import { axis, Chart, colour } from "./chart";
import { figure } from "./numbers";

export function HistoryChart({ steps, most }: { steps: Step[]; most: number }) {
    const pictured = steps.some((step) => step.appearance > 0);
    const aim = pictured ? "difference from the picture" : "compliance, N mm";
    const data: uPlot.AlignedData = [
        steps.map((_, i) => i + 1),
        steps.map((step) => (pictured ? step.appearance : step.compliance)),
        steps.map((step) => 100 * step.volume),
    ];
    const options = (): Omit<uPlot.Options, "width" | "height"> => ({
        padding: [8, 6, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: {
            x: { time: false, range: (_, __, hi) => [1, Math.max(hi ?? 2, 2)] },
            y: { range: (_, lo, hi) => (lo === hi ? [0.9 * lo, 1.1 * hi + 1e-9] : [lo, hi]), distr: 3 },
            share: { range: [0, 100] },
        },
        axes: [
            { ...axis(), size: 26, label: "step", space: 40 },
            {
                ...axis(),
                size: 46,
                label: aim,
                stroke: colour("--accent"),
                values: (_, values) => values.map((one) => (one === null ? "" : figure(one, 2))),
            },
            {
                ...axis(),
                scale: "share",
                side: 1,
                size: 34,
                label: "volume, %",
                stroke: colour("--axis-y"),
                grid: { show: false },
            },
        ],
        series: [
            {},
            { stroke: colour("--accent"), width: 1.8, points: { show: steps.length < 2 } },
            { scale: "share", stroke: colour("--axis-y"), width: 1.4, dash: [5, 3], points: { show: false } },
        ],
    });
    const last = steps.at(-1);
    const now = last
        ? `, now ${figure(pictured ? last.appearance : last.compliance)} at a volume of ${figure(100 * last.volume)} %`
        : "";
    return (
        <figure class="chart-figure">
            <Chart
                label={`Steps of the search: ${aim}${now}`}
                height={190}
                data={data}
                options={options}
                word={`${aim} ${steps.length < 2}`}
            />
            <figcaption class="soft">
                step {steps.length}
                {most > 0 && ` of at most ${most}`}
            </figcaption>
        </figure>
    );
}
