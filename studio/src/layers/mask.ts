// The mask of a layer: asks for the window that is shown, at the screen's or at the machine's resolution.
import { get_mask, type Window } from "../server/api";
import type { Job } from "../server/types";
import { type Frame, pane, window_of } from "./window";

export interface Picture {
    job: string;
    layer: number;
    window: Window;
    bitmap: ImageBitmap;
    /** Whether a pixel of the picture is one of the machine's. */
    exact: boolean;
}

/** From here on a pixel of the machine is large enough on the screen to be asked for as such. */
const exact_from = 2;
const most_width = 4096;

interface Wish {
    window: Window;
    width: number;
    exact: boolean;
}

/** The edge of the machine's pixels, mm; 0 when it has none, or when they are not square. */
export function pixel_of(made: Job): number {
    const { display } = made;
    return display && Math.abs(display.pixel_x / display.pixel_y - 1) < 1e-3 ? display.pixel_x : 0;
}

/** A point where four pixels of the machine meet, mm: the middle of the job is that of the display. */
export function pixel_corner({ bounds, display }: Job): [number, number] {
    const corner = (axis: 0 | 1, count: number, pixel: number) =>
        (bounds.lo[axis] + bounds.hi[axis]) / 2 - (count / 2) * pixel;
    if (!display) return [bounds.lo[0], bounds.lo[1]];
    return [corner(0, display.width, display.pixel_x), corner(1, display.height, display.pixel_y)];
}

function wish_of(made: Job, shown: Frame, dense: number): Wish {
    const window = window_of(shown);
    const pixel = pixel_of(made);
    if (pixel && pixel * shown.scale >= exact_from) {
        const [cx, cy] = pixel_corner(made);
        const down = (value: number, corner: number) => corner + Math.floor((value - corner) / pixel) * pixel;
        const x0 = down(window.x0, cx),
            y0 = down(window.y0, cy);
        const columns = Math.ceil((window.x1 - x0) / pixel),
            rows = Math.ceil((window.y1 - y0) / pixel);
        return {
            window: { x0, y0, x1: x0 + columns * pixel, y1: y0 + rows * pixel },
            width: columns,
            exact: true,
        };
    }
    return {
        window,
        width: Math.min(most_width, Math.max(16, Math.round(pane.value.width * dense))),
        exact: false,
    };
}

export async function load_mask(
    made: Job,
    layer: number,
    shown: Frame,
    signal: AbortSignal,
): Promise<Picture> {
    const { window, width, exact } = wish_of(made, shown, Math.min(2, devicePixelRatio));
    const bitmap = await createImageBitmap(await get_mask(made, layer, width, window, signal));
    return { job: made.job, layer, window, bitmap, exact };
}
