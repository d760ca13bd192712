// Masks in resin printers' archives, and what their pixels say: areas, extents, corners.
import fs from "node:fs";
import JSZip from "jszip";
import {PNG} from "pngjs";

/** Greys of a PNG file, row by row from the top. */
export function greys(file) {
    const png = PNG.sync.read(file);
    const values = new Uint8Array(png.width * png.height);
    for (let i = 0; i < values.length; ++i) values[i] = png.data[4 * i];
    return {width: png.width, height: png.height, values};
}

/** Covered pixels of a mask. */
export function covered(mask) {
    let sum = 0;
    for (const v of mask.values) sum += v;
    return sum / 255;
}

/** Columns and rows that hold anything: [left, right, top, bottom], ends included; null of a black mask. */
export function extent(mask) {
    let left = Infinity, right = -1, top = Infinity, bottom = -1;
    for (let i = 0; i < mask.values.length; ++i) {
        if (mask.values[i] < 128) continue;
        const column = i % mask.width, row = (i - column) / mask.width;
        left = Math.min(left, column);
        right = Math.max(right, column);
        top = Math.min(top, row);
        bottom = Math.max(bottom, row);
    }
    return right < 0 ? null : [left, right, top, bottom];
}

/** `key = value` lines as a Map. */
export function readIni(text) {
    const values = new Map();
    for (const line of text.split("\n")) {
        const at = line.indexOf(" = ");
        if (at > 0) values.set(line.slice(0, at), line.slice(at + 3).trim());
    }
    return values;
}

/** An SL1 archive's layers, sorted as the machine sorts them, and its two descriptions. */
export async function readSl1(path) {
    const zip = await JSZip.loadAsync(fs.readFileSync(path), {checkCRC32: true});
    const text = async name => readIni(await zip.file(name).async("string"));
    const config = await text("config.ini"), profile = await text("prusaslicer.ini");
    const names = Object.keys(zip.files)
                      .filter(name => name.startsWith(config.get("jobDir")) && name.toLowerCase().endsWith(".png"))
                      .sort();
    const layer = async index => greys(await zip.file(names[index]).async("nodebuffer"));
    return {config, profile, count: names.length, layer};
}
