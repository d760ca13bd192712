// What the mock knows: settings, kinds, machines and examples.
import { readFileSync } from "node:fs";

const { sections, settings } = JSON.parse(readFileSync(new URL("settings.json", import.meta.url), "utf8"));

const beams = ["cell_min", "cell_max", "beam_min", "beam_max"];
const walls = ["cell_min", "cell_max", "wall_min", "wall_max"];
const periodic = { needs: ["cell", "wall"], takes: ["network", ...walls] };

const kinds = [
    {
        section: "part",
        key: "shape",
        default: "none",
        words: {
            none: { needs: [], takes: [] },
            sphere: { needs: ["radius"], takes: [] },
            box: { needs: ["size"], takes: [] },
            cylinder: { needs: ["radius", "height"], takes: [] },
            capsule: { needs: ["radius", "height"], takes: [] },
            torus: { needs: ["radius", "tube"], takes: [] },
            gyroid: { needs: ["size", "period", "thickness"], takes: [] },
        },
    },
    {
        section: "foam",
        key: "kind",
        default: "voronoi",
        words: {
            voronoi: { needs: ["cell", "beam"], takes: ["seed", "stretch", "turn", ...beams] },
            kelvin: { needs: ["cell", "beam"], takes: ["seed", "jitter", "stretch", "turn", ...beams] },
            closed: {
                needs: ["cell", "beam", "wall"],
                takes: ["wall_min", "wall_max", "window", "seed", "stretch", "turn", ...beams],
            },
            "k-nearest": {
                needs: ["cell", "beam"],
                takes: ["neighbours", "seed", "stretch", "turn", ...beams],
            },
            gyroid: periodic,
            "schwarz-p": periodic,
            "schwarz-d": periodic,
            neovius: periodic,
            lattice: { needs: ["cell", "beam", "unit_cell|struts"], takes: beams },
        },
    },
    {
        section: "skin",
        key: "pattern",
        default: "closed",
        words: {
            closed: { needs: [], takes: [] },
            voronoi: { needs: ["window", "strut"], takes: ["corner", "seed"] },
            hexagons: { needs: ["window", "strut"], takes: ["corner"] },
            image: { needs: ["image", "image_size", "strut"], takes: ["threshold", "invert"] },
        },
    },
    {
        section: "region",
        key: "make",
        default: "",
        words: {
            solid: { needs: ["field"], takes: ["blend", "tool"] },
            empty: { needs: ["field"], takes: ["blend"] },
            foam: { needs: ["field"], takes: ["blend", "cell", "beam", "wall", "window", "modulus", "tool"] },
            skin: { needs: ["field", "thickness"], takes: ["blend", "tool"] },
            blocker: { needs: ["field"], takes: [] },
            enforcer: { needs: ["field"], takes: [] },
        },
    },
    {
        section: "field",
        key: "kind",
        default: "formula",
        words: {
            formula: { needs: ["formula"], takes: ["bounds", "at", "turn"] },
            mesh: { needs: ["file"], takes: ["unit", "scale", "at", "turn"] },
            sphere: { needs: ["radius"], takes: ["at"] },
            box: { needs: ["size"], takes: ["at", "turn"] },
            cylinder: { needs: ["radius", "height"], takes: ["at", "turn"] },
            capsule: { needs: ["radius", "height"], takes: ["at", "turn"] },
            torus: { needs: ["radius", "tube"], takes: ["at", "turn"] },
        },
    },
];

const resin = (name, description, backend, extension, width, height, pixel) => ({
    name,
    description,
    backend,
    process: "resin",
    extension,
    width,
    height,
    pixel,
});
const filament = (name, description) => ({
    name,
    description,
    backend: "gcode",
    process: "filament",
    extension: ".gcode",
});

export const profiles = [
    resin("elegoo-mars-4-ultra", "Elegoo Mars 4 Ultra", "goo", ".goo", 8520, 4320, 0.018),
    resin("generic-8k", "display with 8K pixels of 25 um (images)", "png", "", 7680, 4320, 0.025),
    filament("marlin", "filament printer with Marlin firmware"),
    filament("prusa-mk4", "Original Prusa MK4, nozzle 0.4 mm"),
    resin("prusa-sl1s", "Original Prusa SL1S SPEED", "sl1", ".sl1", 2560, 1620, 0.05),
    filament("voron-2.4-300", "Voron 2.4, 300 mm, nozzle 0.4 mm, Klipper firmware"),
];

export const machines = profiles.map(({ name, description, backend, process, extension }) => ({
    name,
    description,
    backend,
    process,
    extension,
}));

export const examples = [
    {
        name: "sphere_foam",
        title: "A ball of open-cell foam, cut by the sphere it fills",
        text: `# A ball of open-cell foam, cut by the sphere it fills.

[part]
shape = "sphere"    # centred at the origin
radius = 10         # mm

[foam]
cell = 4            # mean diameter of a cell, mm
beam = 0.5          # radius of the beams, mm
seed = 1            # another number, another foam

[layers]
height = 0.05       # mm

[printer]
profile = "prusa-sl1s"
`,
    },
    {
        name: "capsule_shell",
        title: "A capsule with a closed skin over a foam core",
        text: `# A capsule with a closed skin over a foam core.

[part]
shape = "capsule"
radius = 9          # mm
height = 34         # mm, from end to end

[foam]
kind = "gyroid"
cell = 5            # mm
wall = 0.8          # mm

[skin]
thickness = 0.8     # mm, inward from the surface

[support]
kind = "bridges"

[layers]
height = 0.1        # mm

[printer]
profile = "generic-8k"
`,
    },
    {
        name: "graded_bar",
        title: "A bar whose cells grow with the height, as G-code",
        text: `# A bar whose cells grow with the height.

[part]
shape = "box"
size = [40, 24, 24] # mm

[foam]
cell = "4 + 0.15 * (z + 12)"
beam = 0.6          # mm

[[field]]
name = "boss"
kind = "cylinder"
radius = 4.5
height = 30

[[region]]
field = "boss"
make = "solid"
blend = 1.2         # mm

[layers]
height = 0.2        # mm

[printer]
profile = "marlin"
`,
    },
];

export const table = { sections, settings, kinds };
export const find_setting = (section, key) =>
    settings.find((one) => one.section === section && one.key === key);
