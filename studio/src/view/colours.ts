// Colours of the view, from the style sheet, so that they follow the theme.
import type { Triple } from "../server/types";
import type { Colours } from "./renderer";

function read(style: CSSStyleDeclaration, name: string): Triple {
    const hex = style.getPropertyValue(name).trim();
    const number = Number.parseInt(hex.slice(1), 16);
    return [((number >> 16) & 255) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255];
}

export function read_colours(): Colours {
    const style = getComputedStyle(document.documentElement);
    return {
        part: read(style, "--view-part"),
        support: read(style, "--view-support"),
        cut: read(style, "--view-cut"),
        support_cut: read(style, "--view-support-cut"),
        layer: read(style, "--view-layer"),
        fault: read(style, "--view-fault"),
        grid: read(style, "--view-grid"),
        structure: {
            skin: read(style, "--view-skin"),
            frame: read(style, "--view-frame"),
            solid: read(style, "--view-solid"),
            foam: read(style, "--view-foam"),
            body: read(style, "--view-part"),
        },
    };
}
