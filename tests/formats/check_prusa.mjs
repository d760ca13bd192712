// SL1 archives against those that PrusaSlicer makes of the same meshes: areas of layers, and which way round.
import fs from "node:fs";
import path from "node:path";
import {lamella, requireNear, require, run, sources} from "./common.mjs";
import {covered, extent, readSl1} from "./masks.mjs";

const layerHeight = 0.5;
const display = {width: 1200, height: 800, pixel: 0.1};

/** An L of 24 x 15 mm with arms of 5 and 3 mm, 4 mm high: no turn or mirror image of it looks like it. */
function letterL() {
    const outline = [[0, 0], [24, 0], [24, 3], [5, 3], [5, 15], [0, 15]];
    const tops = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    const facets = [];
    const at = (k, z) => [...outline[k], z];
    for (const [a, b, c] of tops) facets.push([at(a, 4), at(b, 4), at(c, 4)], [at(a, 0), at(c, 0), at(b, 0)]);
    outline.forEach((_, k) => {
        const next = (k + 1) % outline.length;
        facets.push([at(k, 0), at(next, 0), at(next, 4)], [at(k, 0), at(next, 4), at(k, 4)]);
    });
    const corner = v => `vertex ${v.join(" ")}\n`;
    const facet = f => `facet normal 0 0 0\nouter loop\n${f.map(corner).join("")}endloop\nendfacet\n`;
    fs.writeFileSync("letter.stl", `solid letter\n${facets.map(facet).join("")}endsolid letter\n`);
}

function byPrusaSlicer(mesh, orientation, mirrorX, mirrorY) {
    const [w, h] = [display.width * display.pixel, display.height * display.pixel];
    const flag = on => (on ? 1 : 0);
    const settings = {
        printer_technology: "SLA", display_orientation: orientation, display_width: w, display_height: h,
        display_pixels_x: display.width, display_pixels_y: display.height, display_mirror_x: flag(mirrorX),
        display_mirror_y: flag(mirrorY), bed_shape: `0x0,${w}x0,${w}x${h},0x${h}`, max_print_height: 200,
        layer_height: layerHeight, initial_layer_height: layerHeight, supports_enable: 0, pad_enable: 0,
        gamma_correction: 1, elefant_foot_compensation: 0, faded_layers: 3, support_object_elevation: 0,
        slice_closing_radius: 0,
    };
    fs.writeFileSync("prusa.ini", Object.entries(settings).map(([k, v]) => `${k} = ${v}\n`).join(""));
    run("prusa-slicer", "--load", "prusa.ini", "--export-sla", "--output", "prusa.sl1", mesh);
    return readSl1("prusa.sl1");
}

function byLamella(mesh, orientation, mirrorX, mirrorY) {
    // In portrait the axes change places, which is a mirror image by itself: there PrusaSlicer's flag takes it back.
    const portrait = orientation === "portrait";
    const flag = (key, on) => (on ? `--${key}` : `--no-${key}`);
    lamella("slice", mesh, "-q", "--force", "--layer-height", String(layerHeight), "--printer-kind", "sl1",
            "--printer-width", String(display.width), "--printer-height", String(display.height), "--printer-pixel",
            String(display.pixel), "--printer-sub-rows", "16", "--no-printer-preview",
            flag("printer-portrait", portrait), flag("printer-mirror-x", portrait ? !mirrorX : mirrorX),
            flag("printer-mirror-y", mirrorY), "-o", "lamella.sl1");
    return readSl1("lamella.sl1");
}

/** Areas of all layers agree to a share of the part's mean, and the layers lie in the same corner. */
async function compare(mesh, what, orientation, mirrorX, mirrorY, share) {
    const theirs = await byPrusaSlicer(mesh, orientation, mirrorX, mirrorY);
    const ours = await byLamella(mesh, orientation, mirrorX, mirrorY);
    require(Math.abs(theirs.count - ours.count) <= 1, `${what}: ${ours.count} layers, theirs ${theirs.count}`);
    for (const key of ["display_orientation", "display_mirror_x", "display_mirror_y", "display_pixels_x"])
        require(ours.profile.get(key) === theirs.profile.get(key), `${what}: ${key} differs`);
    let largest = 0;
    for (let k = 0; k < Math.min(theirs.count, ours.count); ++k) {
        const a = await ours.layer(k), b = await theirs.layer(k);
        require(a.width === b.width && a.height === b.height, `${what}: images of other sizes`);
        const found = covered(a), expected = covered(b);
        if (expected > 100) {
            requireNear(found, expected, share, `${what}, layer ${k}, pixels`);
            largest = Math.max(largest, Math.abs(found / expected - 1));
            const e = extent(a), f = extent(b);
            require(e.every((v, i) => Math.abs(v - f[i]) <= 1), `${what}, layer ${k}: lies at ${e}, theirs at ${f}`);
        }
    }
    return largest;
}

letterL();
let largest = 0;
for (const orientation of ["landscape", "portrait"])
    for (const mirrorX of [false, true])
        for (const mirrorY of [false, true]) {
            const what = `the L, ${orientation}${mirrorX ? ", mirrored in x" : ""}${mirrorY ? ", mirrored in y" : ""}`;
            largest = Math.max(largest, await compare("letter.stl", what, orientation, mirrorX, mirrorY, 0.002));
        }
console.log(`prusa: the L is the same in all eight ways, areas to ${(100 * largest).toFixed(3)} %`);
for (const [model, share] of [["examples/models/koala_mm.obj", 0.002], ["tests/models/good/fish_mm.obj", 0.002]]) {
    const mesh = path.join(sources, model);
    const off = await compare(mesh, model, "portrait", true, false, share);
    console.log(`prusa: ${path.basename(model)}, areas of all layers to ${(100 * off).toFixed(3)} %`);
}
