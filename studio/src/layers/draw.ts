// Draws what the layer pane shows: mask, contours or paths, the grid of pixels and the place of a fault.
import type { Contours, Job, Paths } from "../server/types";
import { draw_paths } from "./draw_paths";
import { pixel_corner, pixel_of, type Picture } from "./mask";
import type { PathLook } from "./path_look";
import { part_contour, support_contour } from "./roles";
import { type Place, trace } from "./trace";
import type { Frame } from "./window";

export interface Lines {
    job: string;
    layer: number;
    contours?: { part: Contours; supports: Contours | null };
    paths?: Paths;
}

export interface Drawing {
    job: Job;
    frame: Frame;
    picture: Picture | null;
    lines: Lines | null;
    look: PathLook;
    /** A place with a ring round it, mm. */
    mark: [number, number] | null;
}

/** From this size of a pixel on the screen on, lines part the pixels. */
const grid_from = 9;

export function draw(canvas: HTMLCanvasElement, drawing: Drawing): void {
    const dense = Math.min(2, devicePixelRatio);
    const width = canvas.clientWidth,
        height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * dense)) canvas.width = Math.round(width * dense);
    if (canvas.height !== Math.round(height * dense)) canvas.height = Math.round(height * dense);
    const context = canvas.getContext("2d")!;
    context.setTransform(dense, 0, 0, dense, 0, 0);
    context.fillStyle = "#101418";
    context.fillRect(0, 0, width, height);
    const { x, y, scale } = drawing.frame;
    const across = (mm: number) => width / 2 + (mm - x) * scale;
    const down = (mm: number) => height / 2 - (mm - y) * scale;
    if (drawing.picture) {
        const { window: w, bitmap, exact } = drawing.picture;
        context.imageSmoothingEnabled = !exact;
        context.drawImage(bitmap, across(w.x0), down(w.y1), (w.x1 - w.x0) * scale, (w.y1 - w.y0) * scale);
        if (exact) draw_grid(context, drawing, width, height);
    }
    draw_bounds(context, drawing.job, across, down);
    context.lineJoin = "round";
    context.lineCap = "round";
    if (drawing.lines?.contours) draw_contours(context, drawing.lines.contours, across, down);
    if (drawing.lines?.paths) draw_paths(context, drawing.lines.paths, drawing.look, { scale, across, down });
    if (drawing.mark) draw_mark(context, across(drawing.mark[0]), down(drawing.mark[1]));
}

function draw_grid(
    context: CanvasRenderingContext2D,
    { job, frame }: Drawing,
    width: number,
    height: number,
): void {
    const pixel = pixel_of(job) * frame.scale;
    if (pixel < grid_from) return;
    const [cx, cy] = pixel_corner(job);
    const first = (middle: number, corner: number) => {
        const at = middle + corner * frame.scale;
        return ((at % pixel) + pixel) % pixel;
    };
    context.beginPath();
    for (let at = first(width / 2 - frame.x * frame.scale, cx); at < width; at += pixel) {
        context.moveTo(at, 0);
        context.lineTo(at, height);
    }
    for (let at = first(height / 2 + frame.y * frame.scale, -cy); at < height; at += pixel) {
        context.moveTo(0, at);
        context.lineTo(width, at);
    }
    context.strokeStyle = "rgba(127, 150, 175, 0.28)";
    context.lineWidth = 1;
    context.stroke();
}

function draw_bounds(context: CanvasRenderingContext2D, { bounds }: Job, across: Place, down: Place): void {
    const { lo, hi } = bounds;
    context.strokeStyle = "rgba(143, 168, 194, 0.35)";
    context.lineWidth = 1;
    context.strokeRect(across(lo[0]), down(hi[1]), across(hi[0]) - across(lo[0]), down(lo[1]) - down(hi[1]));
}

function draw_contours(
    context: CanvasRenderingContext2D,
    { part, supports }: NonNullable<Lines["contours"]>,
    across: Place,
    down: Place,
): void {
    for (const [set, colour] of [
        [supports, support_contour],
        [part, part_contour],
    ] as const) {
        if (!set) continue;
        context.beginPath();
        for (const { points } of set.contours) trace(context, points, true, across, down);
        context.globalAlpha = 0.16;
        context.fillStyle = colour;
        context.fill("evenodd");
        context.globalAlpha = 1;
        context.strokeStyle = colour;
        context.lineWidth = 1.2;
        context.stroke();
    }
}

function draw_mark(context: CanvasRenderingContext2D, px: number, py: number): void {
    context.beginPath();
    context.arc(px, py, 15, 0, 2 * Math.PI);
    context.strokeStyle = "#ff5a52";
    context.lineWidth = 2;
    context.stroke();
}
