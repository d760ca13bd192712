// A line of points as a path of the canvas.

/** A coordinate of the layer on the canvas, px. */
export type Place = (mm: number) => number;

/** Length of the shortest step of a line on the screen, px. */
const least_step = 0.7;

export function trace(
    context: CanvasRenderingContext2D,
    points: number[],
    closed: boolean,
    across: Place,
    down: Place,
): void {
    let lx = Infinity,
        ly = Infinity;
    for (let i = 0; i + 1 < points.length; i += 2) {
        const px = across(points[i]!),
            py = down(points[i + 1]!);
        // Points that the screen cannot tell apart cost as much as others.
        const is_last = i + 3 >= points.length;
        if (!is_last && Math.abs(px - lx) + Math.abs(py - ly) < least_step) continue;
        if (i) context.lineTo(px, py);
        else context.moveTo(px, py);
        lx = px;
        ly = py;
    }
    if (closed) context.closePath();
}
