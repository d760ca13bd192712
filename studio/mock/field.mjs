// A stand-in for the engine: signed distances of simple shapes, of a wavy foam, of a skin and of pillars.

const { abs, cos, hypot, max, min, sin, sqrt, PI } = Math;

const numbers = (text, fallback) => (text === undefined ? fallback : text.split(",").map(Number));
const number = (text, fallback) => (text === undefined ? fallback : Number(text));

function body_of(values, extents) {
    const r = number(values["part.radius"], 10);
    const h = number(values["part.height"], 20);
    switch (values["part.shape"] ?? "none") {
        case "sphere":
            return { half: [r, r, r], at: (x, y, z) => hypot(x, y, z) - r };
        case "gyroid":
        case "box": {
            const [a, b, c] = numbers(values["part.size"], [20, 20, 20]).map((one) => one / 2);
            return { half: [a, b, c], at: (x, y, z) => max(abs(x) - a, abs(y) - b, abs(z) - c) };
        }
        case "cylinder":
            return { half: [r, r, h / 2], at: (x, y, z) => max(hypot(x, y) - r, abs(z) - h / 2) };
        case "capsule": {
            const straight = max(0, h / 2 - r);
            return {
                half: [r, r, straight + r],
                at: (x, y, z) => hypot(x, y, max(0, abs(z) - straight)) - r,
            };
        }
        case "torus": {
            const tube = number(values["part.tube"], 3);
            return { half: [r + tube, r + tube, tube], at: (x, y, z) => hypot(hypot(x, y) - r, z) - tube };
        }
        default: {
            // a mesh: a pebble that fills its box
            const half = (extents ?? [24, 30, 36]).map((one) => one / 2);
            const size = min(...half);
            return {
                half,
                at: (x, y, z) => {
                    const bumps =
                        0.08 * sin((5 * x) / half[0]) * sin((4 * y) / half[1] + 1) * sin((4 * z) / half[2]);
                    return (hypot(x / half[0], y / half[1], z / half[2]) - 0.92 + bumps) * size;
                },
            };
        }
    }
}

/** A number or a formula as a function of (x, y, z, d). Throws what is wrong with it. */
export function graded(text, fallback) {
    if (text === undefined) return () => fallback;
    if (Number.isFinite(Number(text))) {
        const value = Number(text);
        return () => value;
    }
    const known = ["x", "y", "z", "d", "sin", "cos", "sqrt", "abs", "min", "max", "exp"];
    for (const found of text.matchAll(/[A-Za-z_]+/g)) {
        if (known.includes(found[0])) continue;
        throw new Error(`column ${found.index + 1}: unknown name \`${found[0]}\`; known: x, y, z, d`);
    }
    if (/[^-+*/^(),.0-9A-Za-z_ ]/.test(text)) throw new Error("column 1: expected a number, a name or `(`");
    try {
        return new Function(
            "x",
            "y",
            "z",
            "d",
            `const {sin, cos, sqrt, abs, min, max, exp} = Math;
            return ${text.replaceAll("^", "**")};`,
        );
    } catch {
        throw new Error(`column ${text.length}: expected a number, a name or \`(\`, found the end`);
    }
}

function foam_of(values) {
    if (!Object.keys(values).some((name) => name.startsWith("foam."))) return null;
    const cell = graded(values["foam.cell"], 3);
    const kind = values["foam.kind"] ?? "voronoi";
    const periodic = ["gyroid", "schwarz-p", "schwarz-d", "neovius"].includes(kind);
    const member = graded(values[periodic ? "foam.wall" : "foam.beam"], 0.5);
    const seed = number(values["foam.seed"], 1);
    const jitter = periodic ? 0 : 0.6;
    return (x, y, z, d) => {
        const size = max(0.3, cell(x, y, z, d));
        const k = (2 * PI) / (periodic ? size : 1.6 * size);
        const u = k * (x + jitter * sin(0.7 * y + seed));
        const v = k * (y + jitter * sin(0.8 * z + 2 * seed));
        const w = k * (z + jitter * sin(0.6 * x + 3 * seed));
        const sheet =
            kind === "schwarz-p"
                ? cos(u) + cos(v) + cos(w)
                : sin(u) * cos(v) + sin(v) * cos(w) + sin(w) * cos(u);
        const width = member(x, y, z, d);
        return periodic ? abs(sheet) / (1.5 * k) - width / 2 : (1.05 - abs(sheet)) / (1.2 * k) - width * 0.6;
    };
}

/** The part of a recipe's values. `extents` is the size of its mesh, mm. */
export function make_field(values, regions, extents, with_supports) {
    const body = body_of(values, extents);
    const foam = foam_of(values);
    const skin = values["skin.thickness"] === undefined ? null : graded(values["skin.thickness"], 0.8);
    const scale = number(values["part.scale"], 1);
    const part = (px, py, pz) => {
        const [x, y, z] = [px / scale, py / scale, pz / scale];
        const d = body.at(x, y, z);
        if (!foam && !skin) return d * scale;
        if (d > 0) return d * scale;
        let inside = foam ? foam(x, y, z, -d) : 1;
        if (skin) inside = min(inside, -d - skin(x, y, z, -d));
        for (const region of regions)
            inside = region.make === "solid" ? min(inside, hypot(x, y) - 4.5) : inside;
        return max(d, inside) * scale;
    };
    const half = body.half.map((one) => one * scale);
    const lift = with_supports ? 3 : 0;
    const lo = [-half[0], -half[1], -half[2] - lift];
    const pitch = max(4, half[0] / 2.5);
    const under = (x, y) => {
        // the height at which the body begins above a pillar
        for (let z = -half[2]; z < 0; z += half[2] / 40)
            if (body.at(x / scale, y / scale, z / scale) < 0) return z;
        return null;
    };
    const tops = new Map();
    const support = (x, y, z) => {
        const i = Math.round(x / pitch);
        const j = Math.round(y / pitch);
        const key = i * 1000 + j;
        if (!tops.has(key)) tops.set(key, under(i * pitch, j * pitch));
        const top = tops.get(key);
        if (top === null || z > top) return 9;
        const taper = max(0.25, min(0.6, (top - z) * 0.4));
        return hypot(x - i * pitch, y - j * pitch) - taper;
    };
    return { lo, hi: half, part, support: with_supports ? support : () => 9 };
}
