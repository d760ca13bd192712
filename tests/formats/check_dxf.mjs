// DXF as a parser of its own reads it: the same closed lines as the SVG of the same sheets.
import {readFileSync, readdirSync} from "node:fs";
import DxfParser from "dxf-parser";
import {lamella, require, requireNear, shoelace, sources} from "./common.mjs";

const recipe = `${sources}/examples/plywood_koala.toml`;
lamella("slice", recipe, "-q", "-o", "svg");
lamella("slice", recipe, "--printer-kind", "dxf", "-q", "-o", "dxf");

const files = readdirSync("dxf").filter(f => f.endsWith(".dxf"));
require(files.length === readdirSync("svg").filter(f => f.endsWith(".svg")).length, "one DXF for each SVG");
for (const file of files) {
    const drawing = new DxfParser().parseSync(readFileSync(`dxf/${file}`, "utf8"));
    require(drawing.header.$INSUNITS === 4, `${file}: units are ${drawing.header.$INSUNITS}, not millimetres`);
    require(drawing.header.$ACADVER === "AC1009", `${file}: release ${drawing.header.$ACADVER}`);
    const layers = Object.keys(drawing.tables.layer.layers);
    for (const layer of ["ENGRAVE", "SCORE", "CUT_INNER", "CUT_OUTER"])
        require(layers.includes(layer), `${file}: no layer ${layer}`);
    const text = readFileSync(`svg/${file.replace(".dxf", ".svg")}`, "utf8");
    const lines = [];
    for (const [, purpose, data] of text.matchAll(/<path id="layer\d+-([a-z-]+)"[^>]* d="([^"]*)"/g)) {
        for (const [line] of data.matchAll(/M[^M]*/g)) {
            const points = [...line.matchAll(/[ML](-?[\d.]+) (-?[\d.]+)/g)].map(m => [Number(m[1]), Number(m[2])]);
            lines.push({layer: purpose.toUpperCase().replace("-", "_"), closed: line.includes("Z"), points});
        }
    }
    require(drawing.entities.length === lines.length,
            `${file}: ${drawing.entities.length} entities for ${lines.length} lines`);
    let area = 0, expected = 0;
    drawing.entities.forEach((entity, i) => {
        require(entity.type === "POLYLINE", `${file}: a ${entity.type}`);
        require(entity.layer === lines[i].layer, `${file}: line ${i} on ${entity.layer}, not ${lines[i].layer}`);
        require(Boolean(entity.shape) === lines[i].closed, `${file}: line ${i} is ${entity.shape ? "" : "not "}closed`);
        require(entity.vertices.length === lines[i].points.length, `${file}: points of line ${i}`);
        if (!lines[i].closed || !entity.layer.startsWith("CUT")) return;
        area += shoelace(entity.vertices.map(v => [v.x, v.y]));
        expected -= shoelace(lines[i].points);
    });
    require(expected > 1000, `${file}: next to nothing is cut`);
    requireNear(area, expected, 1e-4, `${file}: area`);
}
console.log(`dxf: ${files.length} sheets read`);
