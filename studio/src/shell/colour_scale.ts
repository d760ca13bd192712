// The scale of colours for figures on a dark ground: viridis (S. van der Walt, N. Smith) without its darkest third.
// Its lightness rises evenly, so that it is read without telling red from green.

const stops = [
    [45, 112, 142],
    [31, 150, 139],
    [63, 188, 115],
    [142, 214, 69],
    [253, 231, 37],
] as const;

/** The colour of a share of the scale, 0 to 1. */
export function colour_on_scale(share: number): string {
    const place = Math.max(0, Math.min(1, share)) * (stops.length - 1);
    const i = Math.min(Math.floor(place), stops.length - 2);
    const mixed = stops[i]!.map((one, k) => Math.round(one + (stops[i + 1]![k]! - one) * (place - i)));
    return `rgb(${mixed.join(", ")})`;
}

/** The whole scale from left to right, for a legend. */
export const scale_gradient = `linear-gradient(90deg, ${stops.map((stop) => `rgb(${stop.join(", ")})`).join(", ")})`;
