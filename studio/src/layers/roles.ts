// Colours of the roles of toolpaths, and of contours.

const known: [RegExp, string][] = [
    [/outer|external/i, "#e8833a"],
    [/inner|perimeter|wall/i, "#f2c14e"],
    [/support.*interface|interface/i, "#8ecae6"],
    [/support/i, "#598fcc"],
    [/solid|top|bottom|skin/i, "#c05299"],
    [/infill|fill|foam/i, "#4fae7c"],
    [/bridge/i, "#7d6fd0"],
    [/skirt|brim|prime|purge|shield/i, "#9a9a9a"],
    [/cut/i, "#e05252"],
];

export function role_colour(role: string): string {
    return known.find(([pattern]) => pattern.test(role))?.[1] ?? "#b9c4cf";
}

export const part_contour = "#dfe8f2";
export const support_contour = "#598fcc";
