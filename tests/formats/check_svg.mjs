// SVG as other programs see it: two renderers draw the layers as lamella's own masks show them, a linter and an
// XML parser have nothing to say, and cutting sheets hold the same areas in the order of work.
import {readFileSync, readdirSync, writeFileSync} from "node:fs";
import {Resvg} from "@resvg/resvg-js";
import {PNG} from "pngjs";
import SVGLint from "svglint";
import {lamella, require, requireNear, run, sources} from "./common.mjs";

const pixel = 0.5; // mm
const columns = 440, rows = 640;
const models = [
    ["plate", ["--mesh", `${sources}/tests/models/good/plate_holes.stl`, "--layer-height", "2"]],
    ["koala", ["--mesh", `${sources}/examples/models/koala_mm.obj`, "--scale", "2", "--layer-height", "10"]],
];

/** Path data of the elements with these purposes, as one. */
function pathData(text, purposes) {
    let data = "";
    for (const [, id, d] of text.matchAll(/<path id="layer\d+-([a-z-]+)"[^>]* d="([^"]*)"/g)) {
        if (purposes.includes(id)) data += d;
    }
    return data;
}

/** The filled section as an SVG whose pixels are those of the mask. */
function filled(data, page, mask) {
    const left = mask.column_0_edge - page.left, top = page.top - mask.row_0_edge;
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${columns}" height="${rows}" viewBox="${left} ${top} ` +
        `${columns * pixel} ${rows * pixel}"><rect x="${left}" y="${top}" width="100%" height="100%" fill="#000"/>` +
        `<path d="${data}" fill="#fff" fill-rule="evenodd"/></svg>`;
}

/** Pixels that differ though the mask is of one colour all around them. */
function farDifferences(mask, drawn) {
    const solid = (image, x, y) => image.data[4 * (y * image.width + x)] >= 128;
    let differences = 0;
    for (let y = 1; y + 1 < rows; ++y) {
        for (let x = 1; x + 1 < columns; ++x) {
            const here = solid(mask, x, y);
            if (here === solid(drawn, x, y)) continue;
            let edge = false;
            for (let j = -1; j <= 1; ++j) {
                for (let i = -1; i <= 1; ++i) edge ||= solid(mask, x + i, y + j) !== here;
            }
            if (!edge) ++differences;
        }
    }
    return differences;
}

/** Sum of the rings' signed areas, mm^2; y runs downwards. */
function area(data) {
    let sum = 0;
    for (const ring of data.split("Z")) {
        const points = [...ring.matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)].map(m => [Number(m[1]), Number(m[2])]);
        points.forEach(([x, y], i) => {
            const [u, v] = points[(i + 1) % points.length];
            sum -= (x * v - u * y) / 2;
        });
    }
    return sum;
}

async function lint(text, name) {
    const linting = await SVGLint.lintSource(text, {
        rules: {
            valid: true,
            elm: {text: false, image: false, metadata: false, "svg": 1},
            attr: [{"rule::selector": "svg", "width": /^[\d.]+mm$/, "height": /^[\d.]+mm$/,
                    "viewBox": /^0 0 [\d.]+ [\d.]+$/},
                   {"rule::selector": "path", "fill": true, "stroke": true, "d": true, "transform": false}],
        },
    });
    await new Promise(resolve => {
        linting.on("done", resolve);
        linting.lint();
    });
    const complaints = Object.values(linting.results).flat().flatMap(rule => rule.messages.map(m => m.reason));
    require(linting.state === "success", `${name}: svglint says ${complaints.join("; ")}`);
}

for (const [name, part] of models) {
    lamella("slice", ...part, "--printer", "png", "--printer-width", String(columns), "--printer-height", String(rows),
            "--printer-pixel", String(pixel), "--printer-antialiasing", "off", "-q", "-o", `${name}_masks`);
    lamella("slice", ...part, "--printer", "svg", "--no-printer-one-file", "--printer-laser", "generic", "-q", "-o",
            `${name}_sheets`);
    const mask = JSON.parse(readFileSync(`${name}_masks/job.json`)).placement;
    const page = JSON.parse(readFileSync(`${name}_sheets/job.json`)).placement;
    let solid = 0;
    for (const file of readdirSync(`${name}_sheets`).filter(f => f.endsWith(".svg"))) {
        const text = readFileSync(`${name}_sheets/${file}`, "utf8");
        await lint(text, file);
        run("xmllint", "--noout", `${name}_sheets/${file}`);
        const picture = filled(pathData(text, ["cut-inner", "cut-outer"]), page, mask);
        const expected = PNG.sync.read(readFileSync(`${name}_masks/${file.replace(".svg", ".png")}`));
        const resvg = new Resvg(picture).render();
        const byResvg = {width: columns, data: resvg.pixels};
        require(resvg.width === columns && resvg.height === rows, `${file}: resvg made ${resvg.width} px`);
        writeFileSync("picture.svg", picture);
        run("rsvg-convert", "picture.svg", "-o", "picture.png");
        const byLibrsvg = PNG.sync.read(readFileSync("picture.png"));
        for (const [renderer, drawn] of [["resvg", byResvg], ["librsvg", byLibrsvg]]) {
            const wrong = farDifferences(expected, drawn);
            require(wrong === 0, `${name} ${file}: ${renderer} draws ${wrong} pixels that the mask has not`);
        }
        for (let i = 0; i < expected.data.length; i += 4) solid += expected.data[i] >= 128;
    }
    require(solid > 10000, `${name}: the masks are all but empty`);
}

// A kerf moves borders by half of it: the area grows by the borders' length times that, to first order.
const [plate] = models;
const kerf = 0.2;
lamella("slice", ...plate[1], "--printer", "svg", "--no-printer-one-file", "--printer-kerf", String(kerf), "-q", "-o",
        "kerf");
const plain = pathData(readFileSync("plate_sheets/00003.svg", "utf8"), ["cut-inner", "cut-outer"]);
const wide = pathData(readFileSync("kerf/00003.svg", "utf8"), ["cut-inner", "cut-outer"]);
let length = 0;
for (const ring of plain.split("Z")) {
    const points = [...ring.matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)].map(m => [Number(m[1]), Number(m[2])]);
    points.forEach(([x, y], i) => {
        const [u, v] = points[(i + 1) % points.length];
        length += Math.hypot(u - x, v - y);
    });
}
requireNear(area(wide) - area(plain), length * kerf / 2, 0.01, "area that the kerf adds");

// The example: sheets with all marks.
lamella("slice", `${sources}/examples/plywood_koala.toml`, "-q", "-o", "plywood");
const sheets = JSON.parse(readFileSync("plywood/job.json")).sheets;
require(sheets.length > 1, "the example fills more than one sheet");
for (const {file} of sheets) {
    const text = readFileSync(`plywood/${file}`, "utf8");
    await lint(text, file);
    run("xmllint", "--noout", `plywood/${file}`);
    const order = [...text.matchAll(/<path id="layer\d+-([a-z-]+)"/g)].map(m => m[1]);
    const rank = order.map(purpose => ["engrave", "score", "cut-inner", "cut-outer"].indexOf(purpose));
    require(rank.every((r, i) => r >= 0 && (i === 0 || rank[i - 1] <= r)), `${file}: ${order.join(" ")}`);
}
console.log("svg: renderers, linter and XML parser agree");
