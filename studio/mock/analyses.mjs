// The mock's analyses: figures that look right, and searches that take steps of a twentieth of a second.
import { volume } from "./layers.mjs";

const tick = 50;
const solid = 3250;

class NotThere extends Error {
    constructor(message, status = 404) {
        super(message);
        this.status = status;
    }
}

/** The modulus of a foam by its cells and beams; null where the recipe has no material. */
export function modulus_of(values) {
    if (!values["material.name"] || !values["foam.cell"]) return null;
    return { predicted_MPa: values["foam.modulus"] ? [40, 320] : [25, 100], is_asked: Boolean(values["foam.modulus"]) };
}

/** What of a part can be told apart, by its keys. */
export function structure_of(values, supports) {
    const has = (section) => Object.keys(values).some((key) => key.startsWith(`${section}.`));
    const parts = has("foam") && has("skin") ? ["skin", "foam"] : [has("foam") ? "foam" : "body"];
    if (supports) parts.push("supports");
    return parts.length > 1 ? parts : [];
}

/** Skin in the upper half, foam below it. */
export function structure_volume(job, n) {
    const { structure, bounds } = job.info;
    if (!structure.length) throw new NotThere("nothing can be told apart", 400);
    const size = [n, n, n];
    const head = Buffer.from(JSON.stringify({ size, ...bounds, channels: 3, parts: structure }));
    const data = Buffer.alloc(3 * n ** 3);
    for (let at = 0; at < n ** 3; ++at) data.set([at > n ** 3 / 2 ? 255 : 1, 1, 1], 3 * at);
    const length = Buffer.alloc(4);
    length.writeUInt32LE(head.length);
    return Buffer.concat([length, head, data]);
}

/** A modulus that grows with x; where one is asked for, the first tenth is softer and the last one stiffer. */
export function modulus_volume(job, n) {
    const { modulus } = job.info;
    if (!modulus) throw new NotThere("modulus: the foam's modulus is unknown", 400);
    const bytes = volume(job, n);
    const length = bytes.readUInt32LE(0);
    const { size, lo, hi } = JSON.parse(bytes.subarray(4, 4 + length).toString());
    const [lo_mpa, hi_mpa] = modulus.predicted_MPa;
    const head = Buffer.from(
        JSON.stringify({ size, lo, hi, channels: 1, scale: { lo_mpa, hi_mpa, is_asked: modulus.is_asked } }),
    );
    const codes = Buffer.alloc(size[0] * size[1] * size[2]);
    for (let at = 0; at < codes.length; ++at) {
        const share = (at % size[0]) / size[0];
        codes[at] = 3 + 252 * share;
        if (modulus.is_asked && share < 0.1) codes[at] = 1;
        if (modulus.is_asked && share > 0.9) codes[at] = 2;
    }
    const before = Buffer.alloc(4);
    before.writeUInt32LE(head.length);
    return Buffer.concat([before, head, codes]);
}

function directions() {
    const [polar, around] = [13, 24];
    const young = [];
    for (let ring = 0; ring < polar; ++ring) {
        const z = Math.cos((Math.PI * ring) / (polar - 1));
        for (let turn = 0; turn < around; ++turn) young.push(60 + 30 * z * z);
    }
    return { polar, around, young };
}

function stiffness(rve, samples) {
    return {
        foam: "voronoi",
        period_mm: 16,
        elements: rve || 96,
        material: { E: solid, nu: 0.35 },
        density: 0.1525,
        E: 72.5,
        nu: 0.31,
        G: 27.7,
        K: 63.6,
        anisotropy: 0.042,
        E_least: 60,
        E_greatest: 90,
        E_hashin_shtrikman: 240,
        samples: Array.from({ length: samples }, (_, i) => ({ density: 0.15 + 0.005 * i, E: 70 + 5 * i, nu: 0.31 })),
        directions: directions(),
        law: [0.03, 0.06, 0.12, 0.24].map((ratio) => ({
            ratio,
            density: 9 * ratio * ratio + ratio,
            young: 10 * ratio ** 3,
            poisson: 0.3,
            spread: 0.03,
        })),
    };
}

const step_of = (index) => ({
    appearance: 0,
    compliance: 2 + 20 / index,
    volume: 0.4,
    greyness: 0.3 / index,
    change: 0.2,
});

const report = (steps) => ({
    elements: 4096,
    grid: [32, 16, 8],
    young_mpa: solid,
    material_is_assumed: false,
    full_compliance_nmm: 1.5,
    compliance_nmm: steps.at(-1).compliance,
    compliance_bound_of_full: 0,
    volume: 0.4,
    volume_bound: 0.4,
    mass_g: 6.4,
    stray_pieces: 0,
    converged: false,
    cases: [
        { case: "1", largest_displacement_mm: 0.14, displacement_at_mm: [20, 0, 1.5], peak_von_mises_mpa: 1.6 },
    ],
    notes: [],
});

/** Analyses of one server. They run at once; `reply` answers below /api/analyses/. */
export function make_analyses(send_event) {
    const all = new Map();
    const searched = new Set();
    let next = 1;
    const has_search = (text) => /^\[optimize\]/m.test(text);

    const whole = ({ steps, result, ...rest }) => ({ ...summary(rest, steps), steps, result });
    const summary = ({ timer, session, job, text, ...rest }, steps) => ({
        ...rest,
        count: steps.length,
        step: steps.at(-1) ?? null,
    });
    function tell(analysis) {
        const { steps, result, ...rest } = analysis;
        send_event(analysis.session, "analysis", summary(rest, steps));
    }
    function end(analysis, state) {
        clearInterval(analysis.timer);
        analysis.state = state;
        tell(analysis);
    }
    function begin(kind, session, job, go_on) {
        const analysis = {
            analysis: next++,
            kind,
            session,
            job,
            state: "running",
            share: 0,
            most: 0,
            designs: 0,
            message: "",
            steps: [],
            result: null,
        };
        all.set(analysis.analysis, analysis);
        analysis.timer = setInterval(() => {
            go_on(analysis);
            if (analysis.state === "running") tell(analysis);
        }, tick).unref();
        return whole(analysis);
    }

    function homogenize(job, { rve = 0, samples = 1, session }) {
        if (/[a-z]/i.test(job.values["foam.cell"] ?? "")) {
            throw new NotThere("foam.cell: it varies in space, and a sample stands for one place; accepted: a number", 400);
        }
        return begin("homogenize", session, job, (analysis) => {
            analysis.share = Math.min(1, analysis.share + 0.1);
            if (analysis.share < 0.999) return;
            analysis.result = stiffness(rve, samples);
            end(analysis, "done");
        });
    }

    function optimize(job, { text, session }) {
        if (!has_search(text)) throw new NotThere("[optimize] is missing: there is nothing to optimise", 400);
        const most = Number(job.values["optimize.iterations"] ?? 20);
        const begun = begin("optimize", session, job, (analysis) => {
            analysis.steps.push(step_of(analysis.steps.length + 1));
            analysis.most = most;
            analysis.share = analysis.steps.length / most;
            if (analysis.steps.length % 4 === 1) ++analysis.designs;
            if (analysis.steps.length < most) return;
            analysis.result = report(analysis.steps);
            searched.add(text);
            end(analysis, "done");
        });
        return begun;
    }

    function reply(url, method, response) {
        const [, , , id, what] = url.pathname.split("/");
        const analysis = all.get(Number(id));
        if (!analysis) throw new NotThere("there is no such analysis");
        if (method === "DELETE") {
            clearInterval(analysis.timer);
            all.delete(Number(id));
            return {};
        }
        if (what === "stop" && analysis.state === "running") {
            if (analysis.steps.length) analysis.result = report(analysis.steps);
            analysis.message = "stopped; the report is that of the best design so far";
            end(analysis, "cancelled");
        }
        if (what !== "volume") return whole(analysis);
        if (!analysis.designs) throw new NotThere("this analysis has no design, or none yet");
        response.setHeader("Content-Type", "application/octet-stream");
        response.end(volume(analysis.job, 32 + (analysis.designs % 8)));
        return undefined;
    }

    return { homogenize, optimize, reply, is_searched: (text) => !has_search(text) || searched.has(text) };
}
