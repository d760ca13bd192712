// lib3mf reads our slice stacks: as many slices as layers, at their heights, with the areas that SVG and CLI files of
// the same job have; and it refuses a package that was damaged.
import {readFileSync} from "node:fs";
import {DOMParser} from "@xmldom/xmldom";
import lib3mf from "@3mfconsortium/lib3mf";
import JSZip from "jszip";
import {lamella, require, requireNear} from "./common.mjs";

const wasm = await lib3mf();
const wrapper = new wasm.CWrapper();

/** The model in a package; throws what lib3mf throws. */
function read(bytes) {
    wasm.FS.writeFile("/package.3mf", bytes);
    const model = wrapper.CreateModel();
    const reader = model.QueryReader("3mf");
    reader.SetStrictModeActive(true);
    reader.ReadFromFile("/package.3mf");
    require(Number(reader.GetWarningCount()) === 0, "lib3mf warns of the package");
    reader.delete();
    return model;
}

/** Looks at lib3mf's objects: slices by object's name, each as {top, vertices, counts of indices}. */
function objects(model) {
    const found = {};
    const all = model.GetObjects();
    while (all.MoveNext()) {
        const object = all.GetCurrentObject();
        require(object.HasSlices(true), "an object has no slices");
        require(object.IsValid(), "an object is not valid");
        require(object.GetSlicesMeshResolution() === wasm.eSlicesMeshResolution.Lowres, "the box is not declared lowres");
        const stack = object.GetSliceStack();
        stack.CollapseSliceReferences();
        found[object.GetName()] = Array.from({length: Number(stack.GetSliceCount())}, (_, i) => {
            const slice = stack.GetSlice(BigInt(i));
            const polygons = Array.from({length: Number(slice.GetPolygonCount())}, (_, p) => BigInt(p));
            const facts = {top: slice.GetZTop(), vertices: Number(slice.GetVertexCount()),
                           counts: polygons.map((p) => Number(slice.GetPolygonIndexCount(p)))};
            slice.delete();
            return facts;
        });
        stack.delete();
        object.delete();
    }
    all.delete();
    return found;
}

/** Slices as lib3mf writes them again, by object's name: {vertices, polygons as lists of indices}. Its wasm has no way to
 *  hand out their points. */
async function rewritten(model) {
    const writer = model.QueryWriter("3mf");
    writer.WriteToFile("/again.3mf");
    writer.delete();
    const zip = await JSZip.loadAsync(wasm.FS.readFile("/again.3mf"));
    const xml = new DOMParser().parseFromString(await zip.file("3D/3dmodel.model").async("string"), "text/xml");
    const all = (node, name) => [...node.getElementsByTagName(`s:${name}`)];
    const stacks = new Map(all(xml, "slicestack").map((stack) => [stack.getAttribute("id"), stack]));
    return Object.fromEntries([...xml.getElementsByTagName("object")].map((object) => {
        const slices = all(stacks.get(object.getAttribute("s:slicestackid")), "slice");
        return [object.getAttribute("name"), slices.map((slice) => ({
            vertices: all(slice, "vertex").map((v) => [Number(v.getAttribute("x")), Number(v.getAttribute("y"))]),
            polygons: all(slice, "polygon").map(
                (polygon) => [Number(polygon.getAttribute("startv")),
                              ...all(polygon, "segment").map((segment) => Number(segment.getAttribute("v2")))])
        }))];
    }));
}

/** Area within closed rings of points, positive counter-clockwise. */
function ringArea(points) {
    return points.reduce((sum, [x, y], i) => {
        const [nextX, nextY] = points[(i + 1) % points.length];
        return sum + (x * nextY - nextX * y) / 2;
    }, 0);
}

/** Areas of one object's slices. */
function areas(slices, written) {
    require(slices.length === written.length, `${slices.length} slices are read, ${written.length} are written again`);
    return written.map(({vertices, polygons}, i) => {
        require(vertices.length === slices[i].vertices, "lib3mf has lost vertices");
        return polygons.reduce((sum, polygon, p) => {
            require(polygon[0] === polygon.at(-1), "a polygon is open");
            require(polygon.length === slices[i].counts[p], "lib3mf has another number of indices");
            return sum + ringArea(polygon.slice(1).map((v) => vertices[v]));
        }, 0);
    });
}

/** Areas of part and supports, a pair for each layer, from an ASCII CLI file. */
function cliAreas(text) {
    const layers = [];
    for (const line of text.split("\n")) {
        if (line.startsWith("$$LAYER/")) layers.push([0, 0]);
        const polyline = /^\$\$POLYLINE\/(\d+),([01]),(\d+),(.*)$/.exec(line);
        if (!polyline) continue;
        const numbers = polyline[4].split(",").map(Number);
        require(numbers.length === 2 * Number(polyline[3]), "a polyline has another number of points than it says");
        const points = [];
        for (let i = 0; i < numbers.length; i += 2) points.push([numbers[i], numbers[i + 1]]);
        require(String(points[0]) === String(points.at(-1)), "a polyline is open");
        const area = ringArea(points.slice(1));
        require((area > 0) === (polyline[2] === "1"), "a polyline runs the wrong way");
        layers.at(-1)[Number(polyline[1]) - 1] += area;
    }
    return layers.slice(1);  // the first one is empty, for the first layer's thickness
}

/** The same from an SVG. */
function svgAreas(text) {
    const xml = new DOMParser().parseFromString(text, "image/svg+xml");
    return [...xml.getElementsByTagName("g")].map((group) => {
        const layer = [0, 0];
        for (const path of [...group.getElementsByTagName("path")]) {
            for (const ring of path.getAttribute("d").split("Z")) {
                const points = ring.split(/[ML]/).filter((p) => p.trim()).map((p) => p.trim().split(" ").map(Number));
                layer[path.getAttribute("class") === "support" ? 1 : 0] -= ringArea(points);  // y runs down
            }
        }
        return layer;
    });
}

/** The package with a change to the text of its first slices. */
async function damaged(bytes, change) {
    const zip = await JSZip.loadAsync(bytes);
    const name = "2D/slices00000.model";
    const text = await zip.file(name).async("string");
    const changed = change(text);
    require(changed !== text, "nothing was damaged");
    zip.file(name, changed);
    return zip.generateAsync({type: "nodebuffer"});
}

function refuses(bytes) {
    try {
        read(bytes);
        return false;
    } catch {
        return true;
    }
}

const jobs = {
    foam: ["--shape", "sphere", "--shape-radius", "6", "--cell", "3", "--beam", "0.4", "--skin", "0.6", "--layer-height", "0.3"],
    supported: ["--shape", "torus", "--shape-radius", "8", "--shape-tube", "2", "--layer-height", "0.25", "--support",
                "pillars"],
};
for (const [name, job] of Object.entries(jobs)) {
    const slice = (...rest) => lamella("slice", ...job, "--name", name, "--quiet", ...rest);
    slice("--printer", "3mf", "--printer-package-layers", "7", "-o", `${name}.3mf`);
    slice("--printer", "svg", "-o", `${name}.svg`);
    slice("--printer", "cli", "--printer-kind", "cli", "--printer-cli-format", "ascii", "-o", `${name}.cli`);
    const bytes = readFileSync(`${name}.3mf`);
    const model = read(bytes);
    const found = objects(model);
    const written = await rewritten(model);
    const svg = svgAreas(readFileSync(`${name}.svg`, "utf8"));
    const cli = cliAreas(readFileSync(`${name}.cli`, "utf8"));
    const names = name === "supported" ? [name, `${name} supports`] : [name];
    require(String(Object.keys(found)) === String(names), `the objects are ${Object.keys(found)}`);
    require(svg.length === cli.length, "SVG and CLI have different numbers of layers");
    for (const [k, object] of names.entries()) {
        const slices = found[object];
        require(slices.length === svg.length, `${slices.length} slices of ${svg.length} layers`);
        const found3mf = areas(slices, written[object]);
        let total = 0;
        slices.forEach((s, i) => {
            requireNear(s.top, (i + 1) * Number(job[job.indexOf("--layer-height") + 1]), 1e-6, "height of a slice");
            requireNear(found3mf[i], svg[i][k], 1e-3, `${object}: area of slice ${i} against SVG`);
            requireNear(found3mf[i], cli[i][k], 1e-3, `${object}: area of slice ${i} against CLI`);
            total += found3mf[i];
        });
        require(total > 1, `${object} has no area`);
        console.log(`${object}: ${slices.length} slices, ${total.toFixed(2)} mm2 in all`);
    }
    require(refuses(await damaged(bytes, (text) => text.replace(/<s:segment v2="0"\/>\n<\/s:polygon>/, "</s:polygon>"))),
            "lib3mf takes an open polygon");
    require(refuses(await damaged(bytes, (text) => text.replace(/ztop="[0-9.]+"/g, 'ztop="1"'))),
            "lib3mf takes slices that do not rise");
}
