// Two printers on the network of the mock: one takes what it is sent at once, the other does not answer.
const step_ms = 120;

export function make_hosts(refuse, send) {
    const hosts = [
        { name: "voron", kind: "moonraker", url: "http://voron.local" },
        { name: "saturn", kind: "sdcp", url: "http://192.168.1.31" },
    ];
    let sending = null;
    let status = { state: "idle", file: "" };
    let timer = null;
    const heaters = () => {
        const target = status.state === "printing" || status.state === "paused" ? [215, 60] : [0, 0];
        return [
            { name: "nozzle", now: target[0] || 24, target: target[0] },
            { name: "bed", now: target[1] || 23, target: target[1] },
        ];
    };
    const told = () => ({ ...status, heaters: heaters() });
    const go_on = (start) => {
        sending.layers = Math.min(sending.of_layers, sending.layers + Math.ceil(sending.of_layers / 5));
        sending.bytes = sending.layers * 40_000;
        if (sending.layers === sending.of_layers) {
            clearInterval(timer);
            sending.file = "part-1a2b3c4d.gcode";
            Object.assign(sending, { state: "done", prints: start });
            if (start) status = { state: "printing", file: sending.file, progress: 0.25, layer: 20, layers: 80, left_s: 5400 };
        }
        send("sending", sending);
    };
    return {
        stop: () => clearInterval(timer),
        send: (job, body) => {
            if (!hosts.some((one) => one.name === body.host)) refuse(400, "host: accepted: a name in hosts.toml");
            sending = {
                state: "running",
                sending: (sending?.sending ?? 0) + 1,
                job: job.info.job,
                host: body.host,
                file: "",
                layers: 0,
                of_layers: job.count,
                bytes: 0,
                of_bytes: null,
                prints: false,
                message: "",
            };
            clearInterval(timer);
            timer = setInterval(() => go_on(body.start === true), step_ms);
            return { status: 202, reply: sending };
        },
        /** Replies to /api/hosts and /api/sending. */
        reply: (method, [what, name, order]) => {
            if (what === "sending") {
                if (method === "DELETE" && sending) {
                    clearInterval(timer);
                    sending.state = "cancelled";
                }
                return sending ?? { state: "none" };
            }
            if (name === undefined) return { file: "/home/maker/.config/lamella/hosts.toml", hosts };
            if (name === "saturn") refuse(502, "saturn: cannot be reached at http://192.168.1.31: no answer");
            if (name !== "voron") refuse(404, "there is no such host");
            if (method === "POST") status.state = { pause: "paused", resume: "printing", cancel: "cancelled" }[order];
            if (method === "POST" || order === "status") return told();
            const software = "Moonraker v0.9";
            const facts = { software, machine: "voron", encrypted: false, free_bytes: 12_300_000_000 };
            return { status: 200, reply: { ...facts, status: told() } };
        },
    };
}
