// Builds the jobs of recipes, or says what is wrong with them.
import { createHash } from "node:crypto";
import { modulus_of, structure_of } from "./analyses.mjs";
import { find_setting, profiles, table } from "./catalog.mjs";
import { graded, make_field } from "./field.mjs";
import { read_toml } from "./toml.mjs";

const graded_types = ["graded", "formula"];

/** Returns what is wrong with the text of one value; null when nothing is. */
export function objection(setting, value) {
    if (["number", "integer", "graded"].includes(setting.type) && value.trim() !== "") {
        const number = Number(value);
        if (Number.isFinite(number)) {
            const range = `accepted: a number from ${setting.lo} to ${setting.hi} ${setting.unit}`.trim();
            if (number < setting.lo) return `${value} is too small; ${range}`;
            if (number > setting.hi) return `${value} is too large; ${range}`;
            return null;
        }
        if (setting.type !== "graded") return `\`${value}\` is no number`;
    }
    if (setting.type === "choice" && !setting.choices.includes(value)) {
        return `\`${value}\` is unknown; accepted: ${setting.choices.join(", ")}`;
    }
    return null;
}

/** Values of a recipe, in the shape of POST /api/values. */
export function read_values(text) {
    const { sections, mistakes } = read_toml(text);
    const values = {};
    const lists = {};
    const given = [];
    for (const section of sections) {
        if (section.list) {
            (lists[section.name] ??= []).push(
                Object.fromEntries(section.entries.map((one) => [one.key, one.value])),
            );
            continue;
        }
        for (const { key, value } of section.entries) {
            values[`${section.name}.${key}`] = value;
            given.push(`${section.name}.${key}`);
        }
    }
    const machine = profiles.find((one) => one.name === (values["printer.profile"] ?? "generic-8k"));
    if (machine?.width) {
        values["printer.width"] ??= String(machine.width);
        values["printer.height"] ??= String(machine.height);
        values["printer.exposure"] ??= "2.5";
    }
    return { values, lists, given, sections, mistakes, machine };
}

function recipe_mistakes({ sections, values, mistakes, machine }) {
    const found = [...mistakes];
    for (const section of sections) {
        const known = table.sections.find((one) => one.name === section.name);
        if (!known) {
            found.push({ line: section.line, text: `[${section.name}]: unknown section` });
            continue;
        }
        for (const { key, value, line } of section.entries) {
            const setting = find_setting(section.name, key);
            const name = `${section.name}.${key}`;
            let wrong = setting ? objection(setting, value) : "unknown key";
            if (setting && !wrong && graded_types.includes(setting.type)) {
                try {
                    graded(value)(1, 1, 1, 1);
                } catch (error) {
                    wrong = error.message;
                }
            }
            if (wrong) found.push({ line, text: `${name}: ${wrong}` });
        }
        const chosen = table.kinds.find((one) => one.section === section.name);
        if (!chosen) continue;
        const given = section.entries.map((one) => one.key);
        const word = section.entries.find((one) => one.key === chosen.key)?.value ?? chosen.default;
        const kind = chosen.words[word];
        if (!kind) continue;
        for (const need of kind.needs) {
            if (need.split("|").some((key) => given.includes(key))) continue;
            found.push({
                line: section.line,
                text: `${section.name}.${need}: missing, required by kind ${word}`,
            });
        }
        const listed = Object.values(chosen.words).flatMap((one) => [...one.needs, ...one.takes]);
        for (const { key, line } of section.entries) {
            if (
                !listed.includes(key) ||
                kind.needs.join("|").split("|").includes(key) ||
                kind.takes.includes(key)
            )
                continue;
            found.push({ line, text: `${section.name}.${key}: does not apply to kind ${word}` });
        }
    }
    if (!values["part.mesh"] && (values["part.shape"] ?? "none") === "none") {
        found.push({ line: null, text: "part.mesh: a mesh, a shape or a field must be given" });
    }
    if (!machine)
        found.push({ line: null, text: `printer.profile: unknown machine ${values["printer.profile"]}` });
    return found;
}

/** Returns {job} or {mistakes}. `extents` maps mesh files to their sizes. */
export function build_job(text, extents) {
    const read = read_values(text);
    const mistakes = recipe_mistakes(read);
    if (mistakes.length) return { mistakes };
    const { values, lists, machine } = read;
    const supports = read.sections.some((one) => one.name === "support") && values["support.kind"] !== "none";
    const field = make_field(values, lists.region ?? [], extents.get(values["part.mesh"]), supports);
    const height = Number(values["layers.height"] ?? 0.05);
    const total = field.hi[2] - field.lo[2];
    const count = Math.max(1, Math.ceil(total / height));
    const display = machine.width
        ? { width: machine.width, height: machine.height, pixel_x: machine.pixel, pixel_y: machine.pixel }
        : null;
    const identity = createHash("sha256")
        .update(JSON.stringify([values, lists]))
        .digest("hex")
        .slice(0, 32);
    const bounds = { lo: field.lo, hi: field.hi };
    const name = (values["part.mesh"] ?? values["part.shape"]).replace(/\.[a-z0-9]+$/i, "");
    const notes = Number(values["foam.cell"]) > 20 ? ["foam.cell: cells are larger than the part"] : [];
    const info = {
        job: identity,
        name,
        machine: machine.name,
        backend: machine.backend,
        process: machine.process,
        bounds,
        layers: { count, heights: [[count, height]], height_mm: +(count * height).toFixed(4) },
        z0: bounds.lo[2],
        axes: [
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
        ],
        supports,
        modulus: modulus_of(values),
        structure: structure_of(values, supports),
        numbers: Number.isNaN(Number(values["foam.cell"] ?? 0)) ? [{ name: "foam.cell", unit: "mm" }] : [],
        notes,
        display,
    };
    return { job: { info, field, bounds, height, count, values } };
}

/** A report in the shape of `lamella check --json`. */
export function check(job) {
    const middle = Math.floor(job.count / 2);
    const place = (layer, x, y, size) => ({
        size_mm: size,
        at_mm: [x, y, job.bounds.lo[2] + (layer + 0.5) * job.height],
        layer,
        first_layer: layer,
        end_layer: layer + 3,
        box_mm: { lo: [x - 1, y - 1, 0], hi: [x + 1, y + 1, 1] },
    });
    const { lo, hi } = job.bounds;
    return {
        part: job.info.name,
        machine: job.info.machine,
        process: job.info.process,
        passed: false,
        layers: job.count,
        layer_height_mm: job.height,
        checks: [
            {
                check: "connectivity",
                verdict: "fail",
                passed: true,
                limit: "one piece, but for crumbs",
                count: 0,
                worst: [],
            },
            {
                check: "overhangs",
                verdict: "fail",
                passed: false,
                limit: "at most 0.225 mm over the layer below",
                count: 2,
                worst: [
                    place(Math.floor(job.count / 6), lo[0] * 0.5, hi[1] * 0.2, 2.37),
                    place(Math.floor(job.count / 4), hi[0] * 0.6, 0, 0.92),
                ],
            },
            {
                check: "thickness",
                verdict: "warn",
                passed: false,
                limit: "walls and struts of at least 0.4 mm",
                count: 5,
                worst: [
                    place(middle, 0, hi[1] * 0.5, 0.21),
                    place(middle + 4, hi[0] * 0.3, lo[1] * 0.4, 0.33),
                ],
            },
            {
                check: "cups",
                verdict: "warn",
                passed: true,
                limit: "no suction cup above 10 mm3",
                count: 0,
                worst: [],
            },
        ],
    };
}
