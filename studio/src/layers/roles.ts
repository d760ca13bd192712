// Colours of the roles of toolpaths, and of contours.

const known: [RegExp, string][] = [
    [/interface/i, "#8ecae6"],
    [/support/i, "#598fcc"],
    [/overhang/i, "#d6604d"],
    [/outer|external/i, "#e8833a"],
    [/perimeter|wall/i, "#f2c14e"],
    [/bridge/i, "#9184e0"],
    [/gap/i, "#a9c95f"],
    [/solid|top|bottom|skin/i, "#c9659f"],
    [/infill|fill|foam/i, "#4fae7c"],
    [/skirt|brim|prime|purge|shield/i, "#9a9a9a"],
    [/cut/i, "#e05252"],
];

export function role_colour(role: string): string {
    return known.find(([pattern]) => pattern.test(role))?.[1] ?? "#b9c4cf";
}

export const part_contour = "#dfe8f2";
export const support_contour = "#598fcc";
