// Draws toolpaths in their widths and colours, and travel as dashes.
import type { Path, Paths, Travel } from "../server/types";
import { type PathLook, segment_colour } from "./path_look";
import { type Place, trace } from "./trace";

interface Places {
    scale: number;
    across: Place;
    down: Place;
}

/** Lines that are wider on the screen have round ends, px. */
const round_from = 2;
/** Numbers of points of one stroke: the time that a stroke takes grows faster than its length. */
const most_points = 2000;
/** Beads whose widths differ by less are drawn together, mm: each width is a stroke of its own. */
const width_step = 0.02;

interface Stroke {
    points: number[];
    closed: boolean;
}

interface Pen {
    colour: string;
    width: number;
    strokes: Stroke[];
}

const rounded = (width: number) => Math.max(1, Math.round(width / width_step)) * width_step;

/** Strokes by their pens. */
class Pens {
    readonly pens = new Map<string, Pen>();

    add(colour: string, width: number, stroke: Stroke): void {
        const name = `${colour} ${width}`;
        const pen = this.pens.get(name);
        if (pen) pen.strokes.push(stroke);
        else this.pens.set(name, { colour, width, strokes: [stroke] });
    }
}

/** Adds a path, in pieces where its width or its colour changes. */
function add_path(pens: Pens, path: Path, look: PathLook): void {
    const width_at = (i: number) => rounded(path.widths?.[i] ?? path.width);
    const coloured_by = look.colour === "speed" ? path.speeds : look.colour === "width" ? path.widths : undefined;
    const { points } = path;
    if (!path.widths && !coloured_by) {
        pens.add(segment_colour(path, 0, look), width_at(0), { points, closed: path.closed });
        return;
    }
    const count = points.length / 2;
    const segments = path.closed ? count : count - 1;
    const point = (i: number) => points.slice(2 * (i % count), 2 * (i % count) + 2);
    for (let i = 0; i < segments; ) {
        const colour = segment_colour(path, i, look),
            width = width_at(i);
        const piece = point(i);
        do piece.push(...point(++i));
        while (i < segments && width_at(i) === width && segment_colour(path, i, look) === colour);
        pens.add(colour, width, { points: piece, closed: false });
    }
}

function draw_strokes(context: CanvasRenderingContext2D, strokes: Stroke[], { across, down }: Places): void {
    let points = 0;
    context.beginPath();
    for (const one of strokes) {
        trace(context, one.points, one.closed, across, down);
        points += one.points.length;
        if (points < most_points) continue;
        context.stroke();
        context.beginPath();
        points = 0;
    }
    context.stroke();
}

export const travel_colours = { stays: "#b9c6d3", retracts: "#f2a7d8" };

function draw_travel(context: CanvasRenderingContext2D, travels: Travel[], places: Places): void {
    context.lineWidth = 1;
    context.lineJoin = "bevel";
    context.lineCap = "butt";
    for (const retracts of [false, true]) {
        context.strokeStyle = retracts ? travel_colours.retracts : travel_colours.stays;
        context.setLineDash(retracts ? [5, 3] : [1.5, 2.5]);
        const chosen = travels.filter((one) => one.retracts === retracts);
        draw_strokes(context, chosen.map(({ points }) => ({ points, closed: false })), places);
    }
    context.setLineDash([]);
}

export function draw_paths(
    context: CanvasRenderingContext2D,
    { paths, travels }: Paths,
    look: PathLook,
    places: Places,
): void {
    const pens = new Pens();
    for (const path of paths) add_path(pens, path, look);
    for (const { colour, width, strokes } of [...pens.pens.values()].reverse()) {
        context.strokeStyle = colour;
        context.lineWidth = Math.max(0.8, width * places.scale * 0.88);
        context.lineJoin = context.lineWidth >= round_from ? "round" : "bevel";
        context.lineCap = context.lineWidth >= round_from ? "round" : "butt";
        draw_strokes(context, strokes, places);
    }
    if (look.travel) draw_travel(context, travels, places);
}
