// G-code of real models, in every dialect, read by cncjs' gcode-toolpath, Printrun's gcoder and gcode-preview.
import {execFileSync} from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import ClipperLib from "clipper-lib";
import {WebGLPreview} from "gcode-preview";
import Toolpath from "gcode-toolpath";
import {lamella, require, requireNear, shoelace, sources} from "./common.mjs";

const filament = 1.75, section = Math.PI / 4 * filament ** 2;

/** Commands that each firmware's own documentation lists, of those that a print may need. */
const common = ["G0", "G1", "G2", "G3", "G21", "G28", "G90", "M83", "M84", "M104", "M106", "M107", "M109", "M140",
                "M190", "M204"];
const commands = {
    marlin: [...common, "M73"],
    reprapfirmware: [...common, "M73"],
    klipper: [...common, "SET_PRINT_STATS_INFO"],
    grbl: ["G0", "G1", "G2", "G3", "G17", "G21", "G90", "G94", "M0", "M2", "M3", "M4", "M5"],
};
/** Words that may follow. */
const words = {marlin: /^[EFIJPRSTXYZ]/, reprapfirmware: /^[EFIJPRSTXYZ]/,
               klipper: /^([EFIJSXYZ]|(CURRENT|TOTAL)_LAYER=)/, grbl: /^[FIJSXY]/};

/** What Printrun makes of a file: for each of its lines whether it extrudes, and where it ends. */
const gcoder = `
import json, logging, sys
logging.disable(logging.CRITICAL)
sys.path.insert(0, "/usr/lib/python3/dist-packages")
from printrun import gcoder
code = gcoder.GCode(open(sys.argv[1], encoding="ascii").read().split("\\n"))
lines = [[l.raw, bool(l.is_move), bool(l.extruding), l.current_x, l.current_y, l.current_z, l.e] for l in code.lines]
json.dump({"lines": lines, "filament": code.filament_length}, sys.stdout)
`;
function readByGcoder(file) {
    const text = execFileSync("/usr/bin/python3", ["-c", gcoder, file], {encoding: "utf8", maxBuffer: 1 << 30});
    return JSON.parse(text);
}

/** Layers and their commands as gcode-preview's parser sees them: without its constructor, which wants WebGL. */
function readByPreview(text) {
    const preview = Object.create(WebGLPreview.prototype);
    preview.clear();
    preview.parser.parseGCode(text);
    return preview.parser;
}

/** Boxes of what extrudes in the plane, layer by layer, as gcode-preview reads it: ends of moves alone. */
function boxesByPreview(text) {
    const {preamble, layers} = readByPreview(text);
    const at = {x: 0, y: 0}, boxes = [];
    for (const layer of [preamble, ...layers]) {
        const box = emptyBox();
        for (const {gcode, params} of layer.commands) {
            if (!/^g[0123]$/.test(gcode)) continue;
            const from = {...at};
            for (const axis of ["x", "y"]) at[axis] = params[axis] ?? at[axis];
            if (!(params.e > 0) || (params.x === undefined && params.y === undefined)) continue;
            grow(box, from.x, from.y), grow(box, at.x, at.y);
        }
        if (layer !== preamble) boxes.push(box);
    }
    return boxes;
}

const emptyBox = () => ({low: [Infinity, Infinity], high: [-Infinity, -Infinity]});
function grow(box, x, y, by = 0) {
    [x, y].forEach((c, i) => {
        box.low[i] = Math.min(box.low[i], c - by);
        box.high[i] = Math.max(box.high[i], c + by);
    });
}
/** How far two boxes are apart, side by side, at most. */
function boxDistance(a, b) {
    return Math.max(...[0, 1].flatMap(i => [Math.abs(a.low[i] - b.low[i]), Math.abs(a.high[i] - b.high[i])]));
}

/** Points of a move as gcode-toolpath sees it that a box has to hold: its ends, and where an arc is farthest out. */
function* extremes({motion, v1, v2, v0}) {
    yield v1;
    yield v2;
    if (motion !== "G2" && motion !== "G3") return;
    const radius = Math.hypot(v1.x - v0.x, v1.y - v0.y);
    const [from, to] = motion === "G3" ? [v1, v2] : [v2, v1];
    const turn = v => Math.atan2(v.y - v0.y, v.x - v0.x);
    const round = angle => (angle + 4 * Math.PI) % (2 * Math.PI);
    const sweep = round(turn(to) - turn(from));
    for (let quarter = 0; quarter < 4; ++quarter) {
        const angle = quarter * Math.PI / 2;
        if (round(angle - turn(from)) < sweep)
            yield {x: v0.x + radius * Math.cos(angle), y: v0.y + radius * Math.sin(angle)};
    }
}

/** Rings of the layers' sections in bed coordinates, mm, as the SVG of the same job draws them. */
function sectionRings(model, options, bed) {
    const file = "sections.svg";
    lamella("slice", path.join(sources, model), "-q", "--force", "--printer", "svg", ...options, "-o", file);
    const svg = fs.readFileSync(file, "latin1");
    const [, width, height] = /viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(svg).map(Number);
    const left = (bed[0] - width) / 2, bottom = (bed[1] - height) / 2;
    return svg.split("<g id=").slice(1).map(group => {
        const data = [...group.matchAll(/ d="([^"]*)"/g)].map(match => match[1]).join("");
        return data.split("Z").map(ring => {
            const numbers = (ring.match(/-?[\d.]+/g) ?? []).map(Number), points = [];
            for (let k = 0; k < numbers.length; k += 2)
                points.push([numbers[k] + left, height - numbers[k + 1] + bottom]);
            return points;
        }).filter(points => points.length > 2);
    });
}

/** Box of what a round bead of this width can cover without leaving the rings: of their opening by its disc. */
function reachableBox(rings, width) {
    const unit = 1e4, offset = new ClipperLib.ClipperOffset(), inset = new ClipperLib.Paths();
    offset.AddPaths(rings.map(ring => ring.map(([x, y]) => ({X: Math.round(x * unit), Y: Math.round(y * unit)}))),
                    ClipperLib.JoinType.jtRound, ClipperLib.EndType.etClosedPolygon);
    offset.Execute(inset, -width / 2 * unit);
    const box = emptyBox();
    for (const ring of inset) for (const {X, Y} of ring) grow(box, X / unit, Y / unit, width / 2);
    return box;
}

/** How far the first box stands out of the second at most; negative when it lies within. */
function outside(a, b) {
    return Math.max(...[0, 1].flatMap(i => [b.low[i] - a.low[i], a.high[i] - b.high[i]]));
}

/** Straight moves and arcs as gcode-toolpath sees them. */
function readByToolpath(text) {
    const moves = [];
    const add = (modal, v1, v2, v0) => moves.push({motion: modal.motion, v1, v2, v0, spindle: modal.spindle});
    new Toolpath({addLine: add, addArcCurve: add}).loadFromStringSync(text);
    return moves;
}

/** Length of a move of gcode-toolpath; `what` for messages. */
function lengthOf(move, what) {
    const {v1, v2, v0} = move;
    if (move.motion === "G0" || move.motion === "G1") return Math.hypot(v2.x - v1.x, v2.y - v1.y);
    const a = [v1.x - v0.x, v1.y - v0.y], b = [v2.x - v0.x, v2.y - v0.y];
    const radius = Math.hypot(...a);
    require(Math.abs(radius - Math.hypot(...b)) <= 0.004, `${what}: an arc's ends lie at other distances`);
    let sweep = Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    if (move.motion === "G2") sweep = -sweep;
    if (sweep < 0) sweep += 2 * Math.PI;
    require(sweep < 3.2, `${what}: an arc of more than half a circle`);
    return sweep * radius;
}

/** Every line is short, ASCII, and of a command and words that the firmware knows. */
function checkLines(text, flavour, what) {
    const longest = flavour === "grbl" ? 79 : 95;
    for (const line of text.split("\n")) {
        require(line.length <= longest, `${what}: ${line.length} bytes in "${line}"`);
        require(/^[ -~]*$/.test(line), `${what}: not ASCII: "${line}"`);
        const [command, ...rest] = line.replace(/;.*/, "").trim().split(/ +/);
        if (command === "") continue;
        require(commands[flavour].includes(command), `${what}: ${flavour} does not know "${line}"`);
        for (const word of rest) {
            require(words[flavour].test(word), `${what}: ${flavour} does not know the word ${word} of "${line}"`);
            require(/^([A-Z]|[A-Z_]+=)-?\d+(\.\d+)?$/.test(word) && !/-0$/.test(word),
                    `${what}: no plain number in "${line}"`);
        }
    }
}

/** A move of the plane or of z, with what the comments before it announced and what gcoder found. */
function followPrint(text, what) {
    const theirs = readByGcoder(text.file);
    const toolpath = readByToolpath(text.code);
    const moves = [];
    let next = 0, hot = false, layer = -1, role = "", width = 0, height = 0, prime = 0, extruded = 0, all = 0, wipes = 0;
    for (const [raw, isMove, extruding, x, y, z, e] of theirs.lines) {
        if (raw.startsWith("M109")) hot = true;
        if (raw === ";LAYER_CHANGE") ++layer;
        if (raw.startsWith(";TYPE:")) role = raw.slice(6);
        if (raw.startsWith(";WIDTH:")) width = Number(raw.slice(7));
        if (raw.startsWith(";HEIGHT:")) height = Number(raw.slice(8));
        if (!isMove) continue;
        const inSpace = / [XYZ]/.test(raw), wiping = /^G1 X\S+ Y\S+ E-/.test(raw);
        all += e ?? 0;
        require(extruding === (e !== null && e > 0), `${what}: gcoder and E disagree in "${raw}"`);
        if (extruding) require(hot, `${what}: filament is pushed before the nozzle is hot: "${raw}"`);
        if (raw.startsWith("G0")) require(e === null, `${what}: a travel move with E: "${raw}"`);
        const move = toolpath[next++];  // moves of the extruder alone are moves that end where they begin
        require(move && Math.hypot(move.v2.x - x, move.v2.y - y, move.v2.z - z) < 1e-4,  // gcoder has floats
                `${what}: the two readers are at other places after "${raw}"`);
        if (!inSpace) continue;
        if (wiping) ++wipes;
        else if (/^G[123]/.test(raw)) require(extruding, `${what}: G1 in space without filament: "${raw}"`);
        if (!extruding) {
            moves.push({...move, layer, raw});
            continue;
        }
        extruded += e;
        if (layer < 0) prime += e;
        moves.push({...move, layer, raw, role, width, height, e, length: lengthOf(move, what)});
    }
    require(next === toolpath.length, `${what}: gcode-toolpath found ${toolpath.length} moves, gcoder ${next}`);
    const drawn = Number(/; filament used \[mm\] = (.*)/.exec(text.code)[1]);
    requireNear(extruded, drawn, 1e-3, `${what}: filament in the file's last lines`);
    // What is drawn back is pushed forward again, but for the end.
    const retraction = 0.8;
    require(Math.abs(all - (extruded - retraction)) < 1e-3, `${what}: retractions add up to ${all - extruded} mm`);
    return {moves, prime, extruded, wipes};
}

/** Cross-section of a rectangle with round sides; of an ellipse where it is higher than wide. */
function beadArea(width, height) {
    if (width < height) return Math.PI / 4 * width * height;
    return height * (width - height) + Math.PI * height ** 2 / 4;
}

function slice(model, options) {
    const file = "out.gcode";
    const facts = JSON.parse(lamella("slice", path.join(sources, model), "-q", "--json", "--force", "--no-printer-preview",
                                     "--printer", "marlin", ...options, "-o", file));
    const info = JSON.parse(lamella("info", path.join(sources, model), "--json", ...options));
    return {file, code: fs.readFileSync(file, "latin1"), volume: facts.volume_mm3, layers: facts.layers, info};
}

/** Whether a word of the command line is an option of the printer. */
const isPrinters = word => word !== undefined && word.startsWith("--printer-");

/** `plastic`: share by which the plastic may differ from the solid's volume. */
function checkPrint(model, flavour, options, {plastic, merged = false, wiped = false}) {
    const what = `${path.basename(model)}, ${flavour}`;
    const modelOptions = options.filter((word, i) => !isPrinters(word) &&
                                                     !(isPrinters(options[i - 1]) && !word.startsWith("--")));
    const text = slice(model, [...options, "--printer-flavour", flavour]);
    checkLines(text.code, flavour, what);
    const print = followPrint(text, what);
    const bed = [220, 220, 250];
    const beadBoxes = [], endBoxes = new Map(), walled = new Set();
    let beads = 0, laid = 0, layers = new Set(), top = 0;
    for (const move of print.moves) {
        for (const v of [move.v1, move.v2])
            [v.x, v.y, v.z].forEach((c, i) => require(c >= 0 && c <= bed[i], `${what}: off the bed: "${move.raw}"`));
        if (move.e === undefined) continue;
        const z = move.v2.z.toFixed(3), ends = endBoxes.get(z) ?? emptyBox();
        endBoxes.set(z, ends);
        for (const v of [move.v1, move.v2]) grow(ends, v.x, v.y);
        if (move.layer < 0) continue;
        const volume = move.e * section, wanted = move.length * beadArea(move.width, move.height);
        beads += wanted;
        laid += volume;
        layers.add(move.layer);
        top = Math.max(top, move.v2.z);
        // Widths are told to a micrometre, E to 10 nm: tiny moves have no more digits.
        if (!merged && move.length > 0.5)
            requireNear(volume, wanted, 0.01, `${what}: the bead's plastic in "${move.raw}"`);
        const bead = beadBoxes[move.layer] ??= emptyBox();
        for (const v of extremes(move)) grow(bead, v.x, v.y, move.width / 2);
        if (move.role === "External perimeter") walled.add(move.layer);
    }
    requireNear(laid, beads, 0.01, `${what}: plastic of all beads`);
    requireNear(laid, text.volume, plastic, `${what}: plastic against the solid's volume`);
    const previewed = boxesByPreview(text.code), printed = [...endBoxes.values()];
    require(previewed.length === printed.length,
            `${what}: gcode-preview finds ${previewed.length} layers, the others ${printed.length}`);
    printed.forEach((box, i) => require(boxDistance(box, previewed[i]) < 1e-4,
                                        `${what}: gcode-preview has another box of printed layer ${i}`));
    // Beads fill the section as far as a round one of the usual width reaches: not the tips of sharp corners and
    // thin fins, where narrower ones may go on, and no more than half a line beyond.
    const line = 0.45, rings = sectionRings(model, modelOptions, bed);
    let over = 0, short = 0;
    for (const layer of walled) {
        const box = emptyBox();
        for (const ring of rings[layer]) for (const [x, y] of ring) grow(box, x, y);
        over = Math.max(over, outside(beadBoxes[layer], box));
        short = Math.max(short, outside(reachableBox(rings[layer], line), beadBoxes[layer]));
    }
    require(walled.size >= text.layers / 2, `${what}: only ${walled.size} layers have walls`);
    require(over <= line / 2, `${what}: beads stand ${over} mm out of their section`);
    require(short <= 0.03, `${what}: beads end ${short} mm before what they could reach of their section`);
    require(layers.size >= text.layers - 1, `${what}: ${layers.size} layers of ${text.layers}`);
    const height = text.info.layer_height_mm;
    require(Math.abs(top - text.layers * height) <= height + 1e-6, `${what}: ends at ${top} mm`);
    require(wiped === print.wipes > 0, `${what}: ${print.wipes} moves wipe the nozzle`);
    const arcs = print.moves.filter(m => m.motion === "G2" || m.motion === "G3").length;
    console.log(`gcode: ${what}: ${print.moves.length} moves${arcs ? `, ${arcs} of them arcs` : ""}; plastic ` +
                `${(100 * (laid / text.volume - 1)).toFixed(2)} % off the solid's, ` +
                `${(100 * (laid / beads - 1)).toFixed(3)} % off the beads'; ${walled.size} walled layers at most ` +
                `${over.toFixed(3)} mm out of their sections and ${short.toFixed(3)} mm short of them`);
}

/** Rings under the beam enclose the layers' areas; the beam is off elsewhere. */
function checkLaser(model, options) {
    const what = `${path.basename(model)}, grbl`;
    const text = slice(model, [...options, "--printer-flavour", "grbl", "--printer-bed-x", "400", "--printer-bed-y", "400"]);
    checkLines(text.code, "grbl", what);
    let area = 0, ring = [], rings = 0;
    const close = () => {
        if (ring.length > 2) area += shoelace(ring), ++rings;
        ring = [];
    };
    for (const move of readByToolpath(text.code)) {
        for (const v of [move.v1, move.v2])
            require(v.x >= 0 && v.x <= 400 && v.y >= 0 && v.y <= 400 && v.z === 0, `${what}: off the bed`);
        if (move.motion === "G0") {
            close();
        } else {
            require(move.spindle === "M4", `${what}: a cut with the beam off`);
            lengthOf(move, what);
            if (ring.length === 0) ring.push([move.v1.x, move.v1.y]);
            ring.push([move.v2.x, move.v2.y]);
        }
    }
    close();
    for (const line of text.code.split("\n"))
        if (line.startsWith("G0") && !/^G0 X0 Y0$/.test(line)) require(/ S0$/.test(line), `${what}: "${line}" without S0`);
    for (const before of text.code.split("\nG0 X0 Y0\n").slice(0, -1))
        require(before.endsWith("M5"), `${what}: goes home with the beam on`);
    requireNear(area * text.info.layer_height_mm, text.volume, 0.001, `${what}: what the cuts enclose`);
    console.log(`gcode: ${what}: ${rings} rings enclose the solid's volume to ` +
                `${(100 * Math.abs(area * text.info.layer_height_mm / text.volume - 1)).toFixed(4)} %`);
}

const koala = "examples/models/koala_mm.obj", fish = "tests/models/good/fish_mm.obj",
      gears = "tests/models/good/cube_gears.3mf";
const foam = ["--cell", "5", "--beam", "0.6", "--skin", "1.2", "--layer-height", "0.3"];
checkPrint(gears, "marlin", ["--layer-height", "0.4"], {plastic: 0.01});
checkPrint(koala, "marlin", foam, {plastic: 0.01});
checkPrint(koala, "marlin", [...foam, "--printer-wipe", "2", "--printer-z-hop", "0.4", "--printer-z-hop-from", "5"],
           {plastic: 0.01, wiped: true});
checkPrint(fish, "klipper", [...foam, "--printer-wall-acceleration", "800", "--printer-fan", "0.5",
                             "--printer-first-layer-bed-temperature", "70", "--printer-least-layer-time", "8"],
           {plastic: 0.01});
checkPrint(koala, "reprapfirmware", [...foam, "--printer-arcs", "--printer-lines-per-second", "60",
                                     "--printer-travel-acceleration", "2000", "--printer-fan", "0.7"],
           {plastic: 0.01, merged: true});
checkLaser(gears, ["--layer-height", "3", "--printer-tolerance", "0.01"]);
checkLaser(koala, ["--cell", "8", "--beam", "1", "--skin", "2", "--layer-height", "2", "--printer-tolerance", "0.01"]);
