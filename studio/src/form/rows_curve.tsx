// The rows of a table as a curve: drag a knot, double click to add or remove one, or draw a new curve with a stroke.
import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { type ControlProps, TextControl } from "./controls";
import { drawn, type Knot, knots_of, knots_text, moved, rounded_knot, type Span, span_of, value_at } from "./rows";

const width = 300;
const height = 150;
const edge = { left: 34, right: 8, top: 8, bottom: 20 };

const across = ({ lo, hi }: Span, x: number) =>
    edge.left + ((x - lo[0]) / (hi[0] - lo[0])) * (width - edge.left - edge.right);
const down = ({ lo, hi }: Span, y: number) =>
    height - edge.bottom - ((y - lo[1]) / (hi[1] - lo[1])) * (height - edge.top - edge.bottom);

function knot_at(span: Span, svg: SVGSVGElement, event: MouseEvent): Knot {
    const box = svg.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * width,
        y = ((event.clientY - box.top) / box.height) * height;
    const share = (x - edge.left) / (width - edge.left - edge.right);
    const up = (height - edge.bottom - y) / (height - edge.top - edge.bottom);
    return [
        span.lo[0] + Math.max(0, Math.min(1, share)) * (span.hi[0] - span.lo[0]),
        span.lo[1] + Math.max(0, Math.min(1, up)) * (span.hi[1] - span.lo[1]),
    ];
}

/** Numbers to write beside an axis: about four, at round values. */
function ticks(lo: number, hi: number): number[] {
    const rough = (hi - lo) / 4;
    const ten = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((k) => k * ten).find((one) => one >= rough) ?? rough;
    const first = Math.ceil(lo / step) * step;
    return Array.from({ length: Math.floor((hi - first) / step + 1e-9) + 1 }, (_, i) => +(first + i * step).toPrecision(6));
}

function Axes({ span }: { span: Span }) {
    return (
        <g class="rows-axes" aria-hidden="true">
            {ticks(span.lo[0], span.hi[0]).map((x) => (
                <g key={x}>
                    <line x1={across(span, x)} x2={across(span, x)} y1={edge.top} y2={height - edge.bottom} />
                    <text x={across(span, x)} y={height - 6} text-anchor="middle">
                        {x}
                    </text>
                </g>
            ))}
            {ticks(span.lo[1], span.hi[1]).map((y) => (
                <g key={y}>
                    <line x1={edge.left} x2={width - edge.right} y1={down(span, y)} y2={down(span, y)} />
                    <text x={edge.left - 5} y={down(span, y) + 3.5} text-anchor="end">
                        {y}
                    </text>
                </g>
            ))}
        </g>
    );
}

export function RowsCurve({ knots, send }: { knots: Knot[]; send: (knots: Knot[]) => void }) {
    const svg = useRef<SVGSVGElement>(null);
    /** What is shown stays as it is while something is dragged. */
    const span = useRef(span_of(knots));
    const held = useSignal<number | null>(null);
    const stroke = useSignal<Knot[] | null>(null);
    if (held.value === null && !stroke.value) span.current = span_of(knots);
    const shown = span.current;

    const press = (event: PointerEvent) => {
        if (event.button !== 0) return;
        svg.current!.setPointerCapture(event.pointerId);
        const index = Number((event.target as Element).getAttribute("data-knot") ?? -1);
        if (index >= 0) held.value = index;
        else stroke.value = [knot_at(shown, svg.current!, event)];
    };
    const drag = (event: PointerEvent) => {
        const at = knot_at(shown, svg.current!, event);
        if (held.value !== null) send(moved(knots, held.value, at, shown));
        else if (stroke.value) stroke.value = [...stroke.value, at];
    };
    const release = () => {
        const line = stroke.value;
        held.value = stroke.value = null;
        if (line && line.length > 3) send(drawn(knots, line, shown));
    };
    const add_or_remove = (event: MouseEvent) => {
        const index = Number((event.target as Element).getAttribute("data-knot") ?? -1);
        if (index >= 0) {
            if (knots.length > 2) send(knots.filter((_, i) => i !== index));
            return;
        }
        const at = rounded_knot(knot_at(shown, svg.current!, event), shown);
        if (knots.some((one) => one[0] === at[0])) return;
        send([...knots, at].sort((a, b) => a[0] - b[0]));
    };
    const on_key = (index: number, event: KeyboardEvent) => {
        const share = event.shiftKey ? 0.005 : 0.05;
        const by: Record<string, Knot> = {
            ArrowLeft: [-share, 0],
            ArrowRight: [share, 0],
            ArrowUp: [0, share],
            ArrowDown: [0, -share],
        };
        const step = by[event.key];
        const [x, y] = knots[index]!;
        if (step) {
            const to: Knot = [
                x + step[0] * (shown.hi[0] - shown.lo[0]),
                y + step[1] * (shown.hi[1] - shown.lo[1]),
            ];
            send(moved(knots, index, to, shown));
        } else if (event.key === "Delete" && knots.length > 2) {
            send(knots.filter((_, i) => i !== index));
        } else if (event.key === "Insert" && index + 1 < knots.length) {
            const between = (x + knots[index + 1]![0]) / 2;
            const added = rounded_knot([between, value_at(knots, between)], shown);
            send([...knots.slice(0, index + 1), added, ...knots.slice(index + 1)]);
        } else return;
        event.preventDefault();
    };
    const line = [[shown.lo[0], knots[0]![1]] as Knot, ...knots, [shown.hi[0], knots.at(-1)![1]] as Knot];
    const points = (list: Knot[]) => list.map(([x, y]) => `${across(shown, x)},${down(shown, y)}`).join(" ");
    return (
        <svg
            ref={svg}
            class="rows-curve"
            viewBox={`0 0 ${width} ${height}`}
            role="group"
            aria-label="Curve of the table's rows. Arrow keys move a knot, Insert adds one after it, Delete removes it."
            onPointerDown={press}
            onPointerMove={drag}
            onPointerUp={release}
            onPointerCancel={release}
            onDblClick={add_or_remove}
        >
            <title>Drag a knot, double click to add or remove one, or draw a curve</title>
            <Axes span={shown} />
            <polyline class="rows-line" points={points(line)} />
            {stroke.value && <polyline class="rows-stroke" points={points(stroke.value)} />}
            {knots.map(([x, y], i) => (
                <circle
                    key={i}
                    data-knot={i}
                    class={held.value === i ? "held" : ""}
                    cx={across(shown, x)}
                    cy={down(shown, y)}
                    r="5"
                    tabindex={0}
                    role="button"
                    aria-label={`Row ${i + 1}: ${y} at ${x}`}
                    onKeyDown={(event) => on_key(i, event)}
                />
            ))}
        </svg>
    );
}

/** The rows as a curve and as text. */
export function RowsControl(props: ControlProps) {
    const knots = props.setting.key === "rows" ? knots_of(props.value) : null;
    return (
        <div class="rows">
            {knots && <RowsCurve knots={knots} send={(next) => props.send(knots_text(next))} />}
            <TextControl {...props} mono />
        </div>
    );
}
