// A small server with the interface of `lamella studio`, for developing and testing the page alone.
//   node mock/server.mjs [--port 8460] [--token TOKEN] [--empty]
import { createHash, randomBytes } from "node:crypto";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { make_analyses, modulus_volume, structure_volume } from "./analyses.mjs";
import { examples, find_setting, machines, table } from "./catalog.mjs";
import { build_job, check, objection, read_values } from "./jobs.mjs";
import * as draw from "./layers.mjs";
import { make_hosts } from "./hosts.mjs";
import { make_printer, ports } from "./print.mjs";
import { edit_toml } from "./toml.mjs";

const dist = fileURLToPath(new URL("../dist/", import.meta.url));
const kinds_of_files = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
};
const policy =
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self'; frame-ancestors 'none'; " +
    "base-uri 'none'; form-action 'none'";
const mesh_endings = [".stl", ".obj", ".ply", ".3mf"];

class Refusal extends Error {
    constructor(status, message, mistakes) {
        super(message);
        this.status = status;
        this.mistakes = mistakes;
    }
}

function read_body(request) {
    return new Promise((resolve, reject) => {
        const parts = [];
        request.on("data", (part) => parts.push(part));
        request.on("end", () => resolve(Buffer.concat(parts)));
        request.on("error", reject);
    });
}

/** The size of a binary STL's box; of other files that of the mock's pebble. */
function extents_of(bytes) {
    if (bytes.length < 134 || bytes.length !== 84 + 50 * bytes.readUInt32LE(80)) return [24, 30, 36];
    const lo = [1e9, 1e9, 1e9],
        hi = [-1e9, -1e9, -1e9];
    for (let at = 84; at < bytes.length; at += 50) {
        for (let k = 0; k < 9; ++k) {
            const value = bytes.readFloatLE(at + 12 + 4 * k);
            lo[k % 3] = Math.min(lo[k % 3], value);
            hi[k % 3] = Math.max(hi[k % 3], value);
        }
    }
    return hi.map((one, k) => one - lo[k]);
}

/** `finest`: most voxels of a volume along an edge; a volume takes the mock a while. */
export function make_mock({
    token = randomBytes(8).toString("hex"),
    recipe = examples[0].text,
    finest = 256,
} = {}) {
    const state = {
        text: recipe,
        path: recipe ? "part.toml" : null,
        saved: true,
        jobs: new Map(),
        extents: new Map(),
        outputs: new Map(),
        streams: new Map(),
        sequences: new Map(),
        next_output: 1,
    };
    const send_event = (session, event, data) => {
        for (const [stream, of] of state.streams) {
            if (of === session) stream.write(`event: ${event}\ndata: ${JSON.stringify(data)}\n\n`);
        }
    };

    const refuse = (status, message) => {
        throw new Refusal(status, message);
    };
    const send_to_all = (event, data) =>
        new Set(state.streams.values()).forEach((session) => send_event(session, event, data));
    const printer = make_printer(refuse, send_to_all);
    const hosts = make_hosts(refuse, send_to_all);

    const analyses = make_analyses(send_event);
    const routes = {
        "GET /api/version": () => ({
            name: "lamella",
            version: "mock",
            studio: true,
            recipe: state.path,
            threads: 2,
        }),
        "GET /api/settings": () => table,
        "GET /api/machines": () => machines,
        "GET /api/examples": () => examples,
        "GET /api/ports": () => ports,
        "GET /api/recipe": () => ({ text: state.text, path: state.path, saved: state.saved }),
        "PUT /api/recipe": (_, body) => {
            state.text = body.text;
            state.path = body.path ?? state.path ?? "part.toml";
            return { path: state.path };
        },
        "POST /api/edit": (_, body) => {
            let text = body.text;
            const mistakes = [];
            for (const change of body.changes) {
                const setting = change.key === null ? null : find_setting(change.section, change.key);
                const name = `${change.section}.${change.key}`;
                if (!setting && change.key !== null)
                    mistakes.push({ line: null, text: `${name}: unknown key` });
                const wrong = setting && change.value !== null ? objection(setting, change.value) : null;
                if (wrong) mistakes.push({ line: null, text: `${name}: ${wrong}` });
                const list = table.sections.find((one) => one.name === change.section)?.list ?? false;
                text = edit_toml(text, { ...change, list }, setting);
            }
            if (mistakes.length) throw new Refusal(422, "the edit has mistakes", mistakes);
            return { text };
        },
        "POST /api/values": (_, body) => {
            const { values, lists, given, mistakes } = read_values(body.text);
            if (mistakes.length) throw new Refusal(422, "the recipe has mistakes", mistakes);
            return { values, lists, given };
        },
        "POST /api/files": (url, body) => {
            const name = url.searchParams.get("name") ?? "";
            if (!/^[\w. -]+$/.test(name) || !mesh_endings.includes(extname(name).toLowerCase())) {
                throw new Refusal(400, `${name}: not a mesh file; accepted: ${mesh_endings.join(", ")}`);
            }
            state.extents.set(name, extents_of(body));
            return { path: name };
        },
        "POST /api/jobs": (_, body) => {
            if ((state.sequences.get(body.session) ?? -1) > body.sequence) throw new Refusal(409, "outdated");
            state.sequences.set(body.session, body.sequence);
            const { job, mistakes } = build_job(body.text, state.extents);
            if (mistakes) throw new Refusal(422, "the recipe has mistakes", mistakes);
            if (body.searches === false && !analyses.is_searched(body.text))
                throw new Refusal(428, "the part has to be optimised first");
            state.jobs.set(job.info.job, job);
            return job.info;
        },
        "POST /api/optimize": (_, body) => {
            const { job, mistakes } = build_job(body.text, state.extents);
            if (mistakes) throw new Refusal(422, "the recipe has mistakes", mistakes);
            return { status: 202, reply: analyses.optimize(job, body) };
        },
    };

    const window_of = (url) =>
        Object.fromEntries(
            ["x0", "y0", "x1", "y1"]
                .filter((key) => url.searchParams.has(key))
                .map((key) => [key, Number(url.searchParams.get(key))]),
        );

    async function job_reply(url, method, request, response) {
        const [, , , identity, ...rest] = url.pathname.split("/");
        const job = state.jobs.get(identity);
        if (!job) throw new Refusal(404, "no such job");
        const ask = (name, fallback) => Number(url.searchParams.get(name) ?? fallback);
        if (method === "POST" && rest[0] === "outputs")
            return start_output(job, JSON.parse(await read_body(request)));
        if (method === "POST" && rest[0] === "print")
            return printer.start(job, JSON.parse(await read_body(request)));
        if (method === "POST" && rest[0] === "send") return hosts.send(job, JSON.parse(await read_body(request)));
        if (method === "POST" && rest[0] === "homogenize")
            return { status: 202, reply: analyses.homogenize(job, JSON.parse(await read_body(request))) };
        if (method === "DELETE") return {};
        if (rest[0] === "print") return printer.outlook(job);
        const tag = `"${identity}-${createHash("sha256")
            .update(url.pathname + url.search)
            .digest("hex")
            .slice(0, 8)}"`;
        if (rest.length && rest[0] !== "check") {
            response.setHeader("ETag", tag);
            response.setHeader("Cache-Control", "private, max-age=31536000, immutable");
        }
        const bytes = (type, data, zip = false) => {
            response.setHeader("Content-Type", type);
            if (zip) response.setHeader("Content-Encoding", "gzip");
            response.end(zip ? gzipSync(data, { level: 1 }) : data);
        };
        if (!rest.length) return job.info;
        if (rest[0] === "structure")
            return bytes("application/octet-stream", structure_volume(job, ask("n", 96)), true);
        if (rest[1] === "islands") return draw.islands(job, ask("values", 400));
        if (rest[1] === "time") return draw.times(job, ask("values", 400));
        if (rest[0] === "curve") return draw.curve(job, ask("values", 400));
        if (rest[0] === "volume")
            return bytes("application/octet-stream", draw.volume(job, Math.min(finest, ask("n", 96))), true);
        if (rest[0] === "modulus")
            return bytes("application/octet-stream", modulus_volume(job, ask("n", 96)), true);
        if (rest[0] === "frame.png")
            return bytes("image/png", draw.frame(ask("width", 512), ask("azimuth", 35)));
        if (rest[0] === "check") {
            for (let done = 0; done <= job.count; done += Math.ceil(job.count / 5)) {
                send_event(url.searchParams.get("session"), "progress", {
                    what: "check",
                    id: null,
                    done,
                    of: job.count,
                    text: "",
                });
                await new Promise((resolve) => setTimeout(resolve, 60));
            }
            return check(job);
        }
        const layer = Number(rest[1]);
        if (rest[0] !== "layers" || !(layer >= 0 && layer < job.count))
            throw new Refusal(404, "no such layer");
        if (rest[2] === "contours") return draw.contours(job, layer);
        if (rest[2] === "paths") return draw.paths(job, layer);
        const colours = url.searchParams.get("colors") === "1";
        return bytes("image/png", draw.mask(job, layer, window_of(url), ask("width", 800), colours));
    }

    function start_output(job, body) {
        const id = state.next_output++;
        const extension = machines.find((one) => one.name === job.info.machine).extension;
        const output = {
            output: id,
            state: "running",
            done: 0,
            of: job.count,
            bytes: 0,
            message: "",
            is_kept: Boolean(body.file),
            file: body.file || job.info.name + extension,
        };
        state.outputs.set(id, output);
        output.timer = setInterval(() => {
            output.done = Math.min(job.count, output.done + Math.ceil(job.count / 20));
            if (output.done === job.count) {
                clearInterval(output.timer);
                output.state = "done";
                output.bytes = extension ? job.count * 1234 : 0;
            }
            send_event(body.session, "output", public_output(output));
        }, 60);
        return { status: 202, reply: { output: id } };
    }
    const public_output = ({ timer, ...rest }) => rest;

    function output_reply(url, method, response) {
        const [, , , id, file] = url.pathname.split("/");
        const output = state.outputs.get(Number(id));
        if (!output) throw new Refusal(404, "no such output");
        if (method === "DELETE") {
            clearInterval(output.timer);
            state.outputs.delete(Number(id));
            return {};
        }
        if (!file) return public_output(output);
        response.setHeader("Content-Disposition", `attachment; filename="${output.file}"`);
        response.setHeader("Content-Type", "application/octet-stream");
        response.end(Buffer.alloc(output.bytes));
    }

    function open_stream(url, request, response) {
        const session = url.searchParams.get("session");
        response.writeHead(200, { "Content-Type": "text/event-stream", "Cache-Control": "no-store" });
        response.write(`event: hello\ndata: ${JSON.stringify({ session, version: "mock" })}\n\n`);
        state.streams.set(response, session);
        request.on("close", () => state.streams.delete(response));
    }

    function serve_file(url, response) {
        const name = url.pathname === "/" ? "index.html" : url.pathname.slice(1);
        if (!/^[\w.-]+$/.test(name)) throw new Refusal(404, "no such file");
        let bytes;
        try {
            bytes = readFileSync(dist + name);
        } catch {
            throw new Refusal(404, "no such file");
        }
        response.setHeader("Content-Type", kinds_of_files[extname(name)] ?? "application/octet-stream");
        response.end(bytes);
    }

    async function answer(request, response) {
        const url = new URL(request.url, "http://localhost");
        response.setHeader("Content-Security-Policy", policy);
        response.setHeader("X-Content-Type-Options", "nosniff");
        if (!url.pathname.startsWith("/api/")) return serve_file(url, response);
        const given = request.headers.authorization?.replace("Bearer ", "") ?? url.searchParams.get("token");
        if (given !== token) throw new Refusal(401, "the token is missing or wrong");
        if (url.pathname === "/api/events") return open_stream(url, request, response);
        let reply;
        if (/^\/api\/jobs\/./.test(url.pathname))
            reply = await job_reply(url, request.method, request, response);
        else if (/^\/api\/print(\/|$)/.test(url.pathname))
            reply = printer.reply(request.method, url.pathname.split("/")[3] ?? "");
        else if (/^\/api\/(hosts|sending)(\/|$)/.test(url.pathname))
            reply = hosts.reply(request.method, url.pathname.split("/").slice(2));
        else if (url.pathname.startsWith("/api/outputs/"))
            reply = output_reply(url, request.method, response);
        else if (url.pathname.startsWith("/api/sessions/")) reply = {};
        else if (url.pathname.startsWith("/api/analyses/"))
            reply = analyses.reply(url, request.method, response);
        else {
            const route = routes[`${request.method} ${url.pathname}`];
            if (!route) throw new Refusal(404, "no such address");
            const bytes = request.method === "GET" ? null : await read_body(request);
            const raw = bytes === null || url.pathname === "/api/files";
            reply = route(url, raw ? bytes : JSON.parse(bytes.toString() || "{}"));
        }
        if (reply === undefined) return;
        response.statusCode = reply.status ?? 200;
        response.setHeader("Content-Type", "application/json");
        response.end(JSON.stringify(reply.reply ?? reply));
    }

    const server = createServer((request, response) => {
        answer(request, response).catch((error) => {
            response.statusCode = error.status ?? 500;
            response.setHeader("Content-Type", "application/json");
            response.setHeader("Cache-Control", "no-store");
            response.end(JSON.stringify({ message: error.message, mistakes: error.mistakes }));
        });
    });
    server.on("close", printer.stop);
    server.on("close", hosts.stop);
    return { server, token, state, printer };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const flag = (name, fallback) => {
        const at = process.argv.indexOf(name);
        return at < 0 ? fallback : process.argv[at + 1];
    };
    const empty = process.argv.includes("--empty");
    const { server, token } = make_mock({ token: flag("--token"), ...(empty ? { recipe: "" } : {}) });
    const port = Number(flag("--port", "8460"));
    server.listen(port, "127.0.0.1", () => console.log(`http://127.0.0.1:${port}/?token=${token}`));
}
