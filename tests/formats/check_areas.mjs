// One part has the same area on every layer, and the same volume, whatever it is written as: masks, archives,
// contours, powder-bed files, and the plastic that G-code extrudes.
import fs from "node:fs";
import path from "node:path";
import {lamella, require, requireNear, shoelace, sources} from "./common.mjs";
import {covered, greys, readSl1} from "./masks.mjs";

const height = 0.2, pixel = 0.05, share = 0.005;
const display = ["--printer-width", "1600", "--printer-height", "1600", "--printer-pixel", String(pixel)];

/** Contours of the SVG's layers, each a list of points. */
function svgContours(text) {
    return text.split("<g id=").slice(1).map(group => {
        const d = /\sd="([^"]*)"/.exec(group)?.[1] ?? "";
        const contours = d.split("Z").map(c => c.trim()).filter(c => c.length > 0);
        return contours.map(c => c.slice(1).split("L").map(pair => pair.trim().split(/[ ,]+/).map(Number)));
    });
}

/** Area of a layer: its contours turn one way outside and the other way in holes. */
function areaOf(contours) {
    return Math.abs(contours.reduce((sum, points) => sum + shoelace(points), 0));
}

/** Areas of the layers of an ASCII CLI file. */
function cliAreas(text) {
    const units = Number(/\$\$UNITS\/([\d.]+)/.exec(text)[1]), areas = [];
    for (const line of text.split("\n")) {
        if (line.startsWith("$$LAYER/")) areas.push(0);
        if (!line.startsWith("$$POLYLINE/")) continue;
        const [, direction, count, ...flat] = line.slice(11).split(",").map(Number);
        require(flat.length === 2 * count, "a polyline is as long as it says");
        const points = Array.from({length: count}, (_, i) => [flat[2 * i] * units, flat[2 * i + 1] * units]);
        const area = shoelace(points);
        require(area > 0 === (direction === 1), "outer contours are counter-clockwise");
        areas[areas.length - 1] += area;
    }
    return areas;
}

/** Plastic that G-code with relative extrusion lays down from the first layer on, mm3. */
function extruded(text, diameter) {
    let length = 0;
    for (const line of text.slice(text.indexOf(";LAYER_CHANGE")).split("\n")) {
        const words = line.split(";")[0];
        if (/^G1 /.test(words)) length += Number(/ E(-?[\d.]+)/.exec(words)?.[1] ?? 0);
    }
    return length * Math.PI * diameter * diameter / 4;
}

async function check(model) {
    const name = path.basename(model);
    const slice = (output, ...more) => lamella("slice", path.join(sources, model), "-q", "--force", "--layer-height",
                                               String(height), "--no-printer-preview", ...more, "-o", output);
    slice("areas.svg", "--printer-tolerance", "0.005");
    const contours = svgContours(fs.readFileSync("areas.svg", "utf8")), svg = contours.map(areaOf);
    slice("areas.cli", "--printer-cli-format", "ascii", "--printer-tolerance", "0.005");
    const cli = cliAreas(fs.readFileSync("areas.cli", "utf8")).slice(1);
    slice("stack", "--printer-kind", "png", ...display);
    const told = JSON.parse(fs.readFileSync("stack/job.json")).areas;
    slice("areas.sl1", ...display);
    const sl1 = await readSl1("areas.sl1");
    slice("areas.goo", ...display);
    const goo = JSON.parse(lamella("info", "--json", "areas.goo")).mask_volume_mm3;
    const layers = svg.length;
    require(cli.length === layers && told.length === layers && sl1.count === layers, `${name}: as many layers in all`);
    let volume = 0, sl1Volume = 0;
    for (let k = 0; k < layers; ++k) {
        const png = covered(greys(fs.readFileSync(`stack/${String(k).padStart(5, "0")}.png`))) * pixel * pixel;
        const archive = covered(await sl1.layer(k)) * pixel * pixel;
        volume += png * height;
        sl1Volume += archive * height;
        // On specks of a few pixels the grey levels themselves are coarser than the comparison.
        if (png < 2) continue;
        const what = `${name}, layer ${k}`;
        requireNear(archive, png, 1e-9, `${what}: SL1 against PNG`);
        requireNear(told[k], png, share, `${what}: job.json against PNG`);
        requireNear(svg[k], png, share, `${what}: SVG against PNG`);
        requireNear(cli[k], png, share, `${what}: CLI against PNG`);
    }
    requireNear(sl1Volume, volume, 1e-9, `${name}: volume of SL1`);
    requireNear(goo, volume, 1e-6, `${name}: volume of GOO`);
    slice("areas.gcode", "--printer", "marlin");
    const plastic = extruded(fs.readFileSync("areas.gcode", "utf8"), 1.75);
    requireNear(plastic, volume, 0.001, `${name}: plastic of the G-code`);
    console.log(`areas: ${name}, ${layers} layers agree; ${volume.toFixed(1)} mm3 in masks, ${plastic.toFixed(1)} of plastic`);
}

for (const model of ["examples/models/koala_mm.obj", "tests/models/good/fish_mm.obj"]) await check(model);
