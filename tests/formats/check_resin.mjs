// Archives and files for resin printers: what other programs find in them, against closed forms and each other.
import {readFileSync} from "node:fs";
import JSZip from "jszip";
import {PNG} from "pngjs";
import {lamella, require, requireNear, run} from "./common.mjs";

const radius = 4, height = 0.1, pixel = 0.05;
const ball = ["--shape", "sphere", "--shape-radius", `${radius}`, "--layer-height", `${height}`, "-q"];
const box = ["--shape", "box", "--shape-size", "6.32,3.17,1", "--layer-height", `${height}`, "-q"];
const plate = ["--printer-width", "360", "--printer-height", "240", "--printer-pixel", `${pixel}`];
const layers = Math.round(2 * radius / height);
const boxLayers = 10, boxArea = 6.32 * 3.17;

/** Area of the ball's section through the middle of a layer, mm^2. */
function section(layer) {
    const z = (layer + 0.5) * height - radius;
    return Math.PI * (radius * radius - z * z);
}

/** Greys of a mask: the red samples of what pngjs decodes. */
function greys(bytes) {
    const image = PNG.sync.read(bytes);
    const values = new Uint8Array(image.width * image.height);
    for (let i = 0; i < values.length; ++i) values[i] = image.data[4 * i];
    return values;
}

/** Lit area of a mask, mm^2. */
function area(values) {
    let sum = 0;
    for (const grey of values) sum += grey;
    return sum / 255 * pixel * pixel;
}

/** Entries of a ZIP archive: name to bytes. */
async function unzip(path) {
    const zip = await JSZip.loadAsync(readFileSync(path), {checkCRC32: true});
    const entries = new Map();
    for (const name of Object.keys(zip.files)) entries.set(name, await zip.files[name].async("nodebuffer"));
    return entries;
}

/** The masks of a GOO file, by the layout of the vendor's specification V1.2. */
function decodeGoo(path) {
    const file = readFileSync(path);
    let at = 195310;
    const count = file.readUInt32BE(at), width = file.readUInt16BE(at + 4), rows = file.readUInt16BE(at + 6);
    at = file.readUInt32BE(195477 - 7);
    const masks = [];
    for (let layer = 0; layer < count; ++layer) {
        require(file.readUInt16BE(at + 64) === 0x0d0a, `GOO layer ${layer}: no end of its description`);
        const size = file.readUInt32BE(at + 66);
        const code = file.subarray(at + 70, at + 70 + size);
        at += 70 + size;
        require(file.readUInt16BE(at) === 0x0d0a, `GOO layer ${layer}: no end of its code`);
        at += 2;
        masks.push(decodeGooLayer(code, width * rows, layer));
    }
    require(file.subarray(at).equals(Buffer.from([0, 0, 0, 7, 0, 0, 0, 0x44, 0x4c, 0x50, 0])), "GOO: no end");
    return masks;
}

function decodeGooLayer(code, pixels, layer) {
    require(code[0] === 0x55, `GOO layer ${layer}: no start`);
    let sum = 0;
    for (const byte of code.subarray(1, -1)) sum = sum + byte & 255;
    require(code[code.length - 1] === (~sum & 255), `GOO layer ${layer}: wrong checksum`);
    const out = new Uint8Array(pixels);
    let filled = 0, value = 0;
    for (let i = 1; i < code.length - 1;) {
        const head = code[i++], type = head >> 6;
        let length = 1;
        if (type === 2) {
            value += head & 0x20 ? -(head & 15) : head & 15;
            if (head & 0x10) length = code[i++];
        } else {
            value = type === 0 ? 0 : type === 3 ? 255 : code[i++];
            let high = 0;
            for (let more = head >> 4 & 3; more > 0; --more) high = high * 256 + code[i++];
            length = high * 16 + (head & 15);
        }
        require(filled + length <= pixels, `GOO layer ${layer}: a run beyond the image`);
        out.fill(value, filled, filled + length);
        filled += length;
    }
    require(filled === pixels, `GOO layer ${layer}: ${filled} of ${pixels} pixels`);
    return out;
}

lamella("slice", ...ball, ...plate, "--printer-kind", "png", "-o", "stack");
const stack = [];
for (let k = 0; k < layers; ++k) stack.push(greys(readFileSync(`stack/${String(k).padStart(5, "0")}.png`)));

function requireStack(masks, what) {
    require(masks.length === layers, `${what}: ${masks.length} masks where ${layers} are expected`);
    masks.forEach((mask, k) => require(Buffer.from(mask).equals(Buffer.from(stack[k])), `${what}: mask ${k} differs`));
}

// SL1: areas of ball and box, by the greys alone.
lamella("slice", ...ball, ...plate, "--printer-kind", "sl1", "-o", "ball.sl1");
const sl1 = await unzip("ball.sl1");
const sl1Masks = [...sl1.keys()].filter(name => name.startsWith("sphere")).sort().map(name => greys(sl1.get(name)));
requireStack(sl1Masks, "SL1");
const volume = sl1Masks.reduce((sum, mask) => sum + area(mask) * height, 0);
requireNear(volume, sl1Masks.reduce((sum, _, k) => sum + section(k) * height, 0), 1e-3, "volume of the ball in SL1");
for (let k = 10; k < layers - 10; ++k) requireNear(area(sl1Masks[k]), section(k), 1e-3, `area of SL1 layer ${k}`);
lamella("slice", ...box, ...plate, "--printer-kind", "sl1", "--printer-sub-rows", "64", "-o", "box.sl1");
const boxMasks = [...(await unzip("box.sl1"))].filter(([name]) => /^[^/]*\.png$/.test(name));
require(boxMasks.length === boxLayers, "layers of the box");
for (const [name, bytes] of boxMasks) requireNear(area(greys(bytes)), boxArea, 1e-3, `area of the box in ${name}`);

// NanoDLP: the same masks in colours, and the figures that it tells of each.
for (const panel of ["rgb", "packed", "grey"]) {
    const path = `ball-${panel}.nanodlp`;
    lamella("slice", ...ball, ...plate, "--printer-kind", "nanodlp", "--printer-panel", panel, "-o", path);
    const entries = await unzip(path);
    const info = JSON.parse(entries.get("info.json"));
    require(info.length === layers, "layers that info.json tells of");
    require(JSON.parse(entries.get("plate.json")).LayersCount === layers, "layers that plate.json tells of");
    for (let k = 0; k < layers; ++k) {
        const image = PNG.sync.read(entries.get(`${k + 1}.png`));
        require(image.width === (panel === "packed" ? 120 : 360), `width of ${panel} images`);
        const mask = new Uint8Array(360 * 240);
        for (let i = 0; i < mask.length; ++i)
            mask[i] = panel === "packed" ? image.data[4 * Math.floor(i / 3) + i % 3] : image.data[4 * i];
        require(Buffer.from(mask).equals(Buffer.from(stack[k])), `NanoDLP ${panel}: mask ${k} differs`);
        requireNear(info[k].TotalSolidArea, area(mask), 1e-3, `TotalSolidArea of layer ${k}`);
        require(info[k].AreaCount === 1, `AreaCount of layer ${k}`);
    }
}

// GOO: grey for grey.
lamella("slice", ...ball, ...plate, "--printer-kind", "goo", "-o", "ball.goo");
requireStack(decodeGoo("ball.goo"), "GOO");

// Ember: tar and gzip of Python's library.
lamella("slice", ...ball, "--printer", "ember", "-o", "ball.tar.gz");
const listed = run("python3", "-c", `
import json, tarfile
archive = tarfile.open("ball.tar.gz")
names = archive.getnames()
settings = json.load(archive.extractfile("printsettings"))["Settings"]
archive.extractall("ember", members=[m for m in archive if m.name.endswith(".png")])
print(len([n for n in names if n.endswith(".png")]), settings["LayerThicknessMicrons"])`).trim();
require(listed === `${layers} 100`, `tarfile finds ${listed} layers and micrometres`);
for (let k = 10; k < layers - 10; ++k) {
    requireNear(area(greys(readFileSync(`ember/slice_${k + 1}.png`))), section(k), 1e-3, `area of Ember layer ${k}`);
}

// What lamella reads back is what it wrote.
for (const job of ["ball.sl1", "ball.goo", "ball-packed.nanodlp"]) {
    lamella("extract", "-q", job, "-o", `${job}.masks`);
    requireStack(stack.map((_, k) => greys(readFileSync(`${job}.masks/${String(k).padStart(5, "0")}.png`))), job);
    requireNear(JSON.parse(lamella("info", "--json", job)).mask_volume_mm3, volume, 1e-6, `volume of ${job}`);
}
