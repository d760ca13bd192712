// lib3mf and lamella read each other's volumetric 3MF files: lib3mf finds our image stacks and level sets as we wrote
// them, and what it writes, of those and of functions that it made itself, is the same solid when we read it.
import {readFileSync, writeFileSync} from "node:fs";
import lib3mf from "@3mfconsortium/lib3mf";
import {lamella, require, requireNear} from "./common.mjs";

const wasm = await lib3mf();
const wrapper = new wasm.CWrapper();

/** The model in a package. lib3mf warns of two elements in every file with a level set, its own ones included. */
function read(bytes) {
    wasm.FS.writeFile("/package.3mf", bytes);
    const model = wrapper.CreateModel();
    const reader = model.QueryReader("3mf");
    reader.ReadFromFile("/package.3mf");
    reader.delete();
    return model;
}

function write(model, name) {
    const writer = model.QueryWriter("3mf");
    writer.WriteToFile("/again.3mf");
    writer.delete();
    writeFileSync(name, wasm.FS.readFile("/again.3mf"));
}

/** The volume of a field of a 3MF file, mm3, as masks of it have it. */
function volume(file, keys = "") {
    writeFileSync("field.toml", `[[field]]\nname = "solid"\nkind = "3mf"\nfile = "${file}"\n${keys}\n[part]\nfield = "solid"\n` +
        `[layers]\nheight = 0.1\n[printer]\nkind = "png"\nwidth = 400\nheight = 400\npixel_x = 0.05\npixel_y = 0.05\n`);
    const report = lamella("slice", "field.toml", "-o", "masks", "--force", "--json", "--quiet");
    return JSON.parse(report).volume_mm3;
}

const sphere = 4 / 3 * Math.PI * 125;

// Ours, read by lib3mf and written again.
lamella("slice", "--shape", "sphere", "--shape-radius", "5", "--layer-height", "0.1", "--printer", "image3d",
        "--printer-pixel", "0.1", "-o", "ball.3mf", "--quiet");
const ours = read(readFileSync("ball.3mf"));
const sets = ours.GetLevelSets();
let count = 0;
while (sets.MoveNext()) {
    const set = sets.GetCurrentLevelSet();
    require(set.GetChannelName() === "red" && set.GetMeshBBoxOnly() && set.GetFallBackValue() === 1, "the level set differs");
    ++count;
}
require(count === 1, `lib3mf finds ${count} level sets`);
const images = ours.GetImage3Ds();
require(images.MoveNext() && images.GetCurrentImage3D().IsImageStack(), "lib3mf finds no image stack");
write(ours, "again.3mf");
requireNear(volume("ball.3mf"), sphere, 1e-3, "volume of our image stack");
requireNear(volume("again.3mf"), sphere, 1e-3, "volume of our image stack as lib3mf writes it");

// lib3mf's: length(pos) - 5 within a box, and |sin x cos y + sin y cos z + sin z cos x| - 0.3.
const model = wrapper.CreateModel();
const Type = wasm.eImplicitPortType, Kind = wasm.eImplicitNodeConfiguration;
const begin = (name) => {
    const f = model.AddImplicitFunction();
    f.SetDisplayName(name);
    f.AddInput("pos", "pos", Type.Vector);
    f.AddOutput("shape", "shape", Type.Scalar);
    return f;
};
const constant = (f, name, value) => f.AddConstantNode(name, name, "").SetConstant(value);
const ball = begin("ball");
ball.AddLengthNode("far", "far", "");
constant(ball, "radius", 5);
ball.AddSubtractionNode("shape", Kind.ScalarToScalar, "shape", "");
ball.AddLinkByNames("inputs.pos", "far.A");
ball.AddLinkByNames("far.result", "shape.A");
ball.AddLinkByNames("radius.value", "shape.B");
ball.AddLinkByNames("shape.result", "outputs.shape");

const gyroid = begin("gyroid");
gyroid.AddSinNode("sine", Kind.VectorToVector, "sine", "");
gyroid.AddCosNode("cosine", Kind.VectorToVector, "cosine", "");
gyroid.AddLinkByNames("inputs.pos", "sine.A");
gyroid.AddLinkByNames("inputs.pos", "cosine.A");
gyroid.AddDecomposeVectorNode("sines", "sines", "");
gyroid.AddDecomposeVectorNode("cosines", "cosines", "");
gyroid.AddLinkByNames("sine.result", "sines.A");
gyroid.AddLinkByNames("cosine.result", "cosines.A");
gyroid.AddComposeVectorNode("turned", "turned", "");
for (const [to, from] of [["x", "y"], ["y", "z"], ["z", "x"]]) gyroid.AddLinkByNames(`cosines.${from}`, `turned.${to}`);
gyroid.AddComposeVectorNode("plain", "plain", "");
for (const axis of ["x", "y", "z"]) gyroid.AddLinkByNames(`sines.${axis}`, `plain.${axis}`);
gyroid.AddDotNode("sum", "sum", "");
gyroid.AddLinkByNames("plain.result", "sum.A");
gyroid.AddLinkByNames("turned.result", "sum.B");
gyroid.AddAbsNode("size", Kind.ScalarToScalar, "size", "");
gyroid.AddLinkByNames("sum.result", "size.A");
constant(gyroid, "wall", 0.3);
gyroid.AddSubtractionNode("shape", Kind.ScalarToScalar, "shape", "");
gyroid.AddLinkByNames("size.result", "shape.A");
gyroid.AddLinkByNames("wall.value", "shape.B");
gyroid.AddLinkByNames("shape.result", "outputs.shape");
write(model, "functions.3mf");
const bounds = (half) => `bounds = [[-${half}, -${half}, -${half}], [${half}, ${half}, ${half}]]`;
requireNear(volume("functions.3mf", `function = "ball"\n${bounds(6)}`), sphere, 1e-3, "volume of lib3mf's ball");
const found = volume("functions.3mf", `function = "gyroid"\n${bounds(6)}`);
writeFileSync("formula.toml", `[[field]]\nname = "solid"\nformula = "abs(sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)) - 0.3"\n` +
    `${bounds(6)}\n[part]\nfield = "solid"\n[layers]\nheight = 0.1\n[printer]\nkind = "png"\nwidth = 400\nheight = 400\n` +
    `pixel_x = 0.05\npixel_y = 0.05\n`);
const formula = JSON.parse(lamella("slice", "formula.toml", "-o", "masks", "--force", "--json", "--quiet")).volume_mm3;
requireNear(found, formula, 1e-9, "volume of lib3mf's gyroid against the formula");
console.log(`ball ${sphere.toFixed(2)} mm3, gyroid ${found.toFixed(2)} mm3`);
