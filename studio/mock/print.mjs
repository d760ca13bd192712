// A printer of the mock: it heats for a second, then prints a layer at each step.

export const ports = [
    { path: "/dev/ttyACM0", by_id: "", description: "Prusa Research Original Prusa MK4" },
    {
        path: "/dev/ttyUSB0",
        by_id: "/dev/serial/by-id/usb-1a86_USB_Serial-if00-port0",
        description: "1a86 USB Serial",
    },
];
const step = 250; // ms
const layers_ahead = 8;
const running = ["connecting", "printing", "paused", "stopping"];

/** `refuse(status, message)` throws; `send(event, data)` tells all listeners. */
export function make_printer(refuse, send) {
    let print = null;
    let messages = [];
    let left = null; // of a print that was stopped
    let timer = 0;

    const say = (text) => {
        const message = { print: print.print, number: messages.length + 1, text };
        messages.push(message);
        send("print_message", message);
    };
    const end = (state, message) => {
        clearInterval(timer);
        Object.assign(print, { state, message, doing: "", seconds_left: null, question: null });
        say(message);
        if (state === "done") left = null;
        else left = { job: print.job, next: (print.layer ?? -1) + 1 };
        send("print", print);
    };
    const heat = () => {
        const t = print.temperatures;
        t.nozzle = Math.min(t.nozzle_target, t.nozzle + 50);
        t.bed = Math.min(t.bed_target, t.bed + 12);
        return t.nozzle === t.nozzle_target;
    };
    const go_on = () => {
        print.seconds += 20;
        if (print.state === "stopping") {
            Object.assign(print.temperatures, { nozzle_target: 0, bed_target: 0 });
            return end("stopped", "the heaters and motors were switched off");
        }
        if (print.state === "connecting") {
            print.state = "printing";
            print.firmware = "Mock 1.0";
            print.doing = "heating";
            say("the printer is Mock 1.0");
        } else if (print.doing === "heating") {
            if (heat()) print.doing = "";
        } else if (print.state === "printing") {
            print.layer = (print.layer ?? -1) + 1;
            print.lines += 120;
            print.layers_computed = Math.min(print.layers, print.layer + layers_ahead);
            print.share = print.layer / print.layers;
            print.seconds_left = (print.layers - print.layer) * 20;
            Object.assign(print, { lines_a_second: 118.4, bytes_a_second: 4210 });
            if (print.layer === print.layers - 1) return end("done", `${print.lines} lines, 0 resends`);
        }
        send("print", print);
    };
    const start = (job, body) => {
        if (job.info.backend !== "gcode") refuse(400, objection(job));
        if (running.includes(print?.state)) refuse(409, "a print runs already; accepted: another one later");
        const { serial, baud } = body.to ?? {};
        if (!ports.some((one) => one.path === serial || one.by_id === serial))
            refuse(404, `to.serial: there is no port ${serial}`);
        if (left && !body.resume && !body.discard_journal) refuse(409, "a journal is left");
        messages = [];
        print = {
            state: "connecting",
            print: (print?.print ?? 0) + 1,
            job: job.info.job,
            name: job.info.name,
            machine: job.info.machine,
            to: { serial, baud },
            firmware: "",
            halts_at_once: true,
            doing: "",
            question: null,
            layers: job.count,
            layer: body.resume ? left.next - 1 : null,
            layers_computed: 0,
            share: null,
            seconds: 0,
            seconds_left: null,
            lines: 0,
            lines_a_second: 0,
            bytes_a_second: 0,
            temperatures: { nozzle: 25, nozzle_target: 210, bed: 24, bed_target: 60 },
            resumable: false,
            message: "",
        };
        say(`waiting for the printer at ${serial}, ${baud} baud`);
        clearInterval(timer);
        timer = setInterval(go_on, step);
        return { status: 202, reply: print };
    };
    const objection = (job) =>
        `${job.info.machine} does not use G-code (its kind is ${job.info.backend}); accepted: a machine that ` +
        "does, such as marlin";
    const outlook = (job) => {
        const accepted = job.info.backend === "gcode";
        const rest = left && {
            journal: `${job.info.name}.print.journal`,
            next_layer: left.next,
            is_of_job: left.job === job.info.job,
        };
        return { accepted, message: accepted ? "" : objection(job), left: accepted ? rest : null };
    };
    const orders = {
        pause: () => Object.assign(print, { state: "paused" }),
        resume: () => Object.assign(print, { state: "printing", question: null }),
        stop: () => Object.assign(print, { state: "stopping" }),
        halt: () => end("stopped", "the printer was halted at once (M112)"),
        choose: () => Object.assign(print, { question: null }),
    };
    return {
        start,
        outlook,
        /** For tests: the printer asks, or fails. */
        ask: (text, buttons) => Object.assign(print, { question: { text, buttons } }),
        fail: (message) => end("failed", message),
        stop: () => clearInterval(timer),
        reply: (method, rest) => {
            if (method === "GET" && rest === "") return print ?? { state: "none" };
            if (method === "GET" && rest === "messages") return messages;
            if (method !== "POST" || !orders[rest]) refuse(404, "no such address");
            if (!running.includes(print?.state)) refuse(409, "no print runs");
            orders[rest]();
            return print;
        },
    };
}
