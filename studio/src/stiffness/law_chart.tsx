// The modulus of the foam over its density: the law's curve, the bound, and the foam of the recipe.
import uPlot from "uplot";
import type { Stiffness } from "../server/analysis";
import { axis, Chart, colour } from "./chart";
import { figure } from "./numbers";

/** Densities of all series, with a value or null for each. */
function data_of(found: Stiffness): uPlot.AlignedData {
    const law = (found.law ?? []).map((point) => ({ at: point.density, law: point.young * found.material.E }));
    const least = Math.min(found.density, ...law.map((one) => one.at)) * 0.9;
    const most = Math.max(found.density, ...law.map((one) => one.at)) * 1.1;
    const rows = [
        { at: least, bound: least },
        ...law.map((one) => ({ ...one, bound: one.at })),
        { at: found.density, foam: found.E, bound: found.density },
        { at: most, bound: most },
    ].sort((a, b) => a.at - b.at) as { at: number; law?: number; foam?: number; bound: number }[];
    return [
        rows.map((row) => 100 * row.at),
        rows.map((row) => row.bound * found.material.E),
        rows.map((row) => row.law ?? null),
        rows.map((row) => row.foam ?? null),
    ];
}

const ticks = (_: uPlot, values: (number | null)[]) =>
    values.map((one) => (one === null || !/^[125]/.test(one.toExponential()) ? "" : figure(one, 2)));

export function LawChart({ found, unit }: { found: Stiffness; unit: string }) {
    const options = (): Omit<uPlot.Options, "width" | "height"> => ({
        padding: [8, 10, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false, distr: 3 }, y: { distr: 3 } },
        axes: [
            { ...axis(), size: 26, label: "density, %", values: ticks },
            { ...axis(), size: 44, label: `E, ${unit}`, values: ticks },
        ],
        series: [
            {},
            { stroke: colour("--ink-soft"), width: 1, dash: [3, 4], points: { show: false } },
            {
                stroke: colour("--accent"),
                width: 1.6,
                spanGaps: true,
                points: { show: true, size: 4, fill: colour("--accent") },
            },
            {
                stroke: colour("--view-layer"),
                width: 0,
                points: { show: true, size: 10, width: 2, fill: colour("--panel") },
            },
        ],
    });
    const law = found.law ? "the law of this kind of foam, " : "";
    return (
        <figure class="chart-figure">
            <Chart
                label={`Modulus over density: ${law}the bound of Voigt, and this foam at ${figure(100 * found.density)} % and ${figure(found.E)} ${unit}`}
                height={190}
                data={data_of(found)}
                options={options}
                word={`${found.E} ${unit}`}
            />
            <figcaption class="chart-key">
                <span class="key-foam">this foam</span>
                {found.law && <span class="key-law">law</span>}
                <span class="key-bound">upper bound</span>
            </figcaption>
        </figure>
    );
}
