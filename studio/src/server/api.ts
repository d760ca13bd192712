// One function a request of the server's interface.
import { get_blob, get_bytes, get_json, with_token } from "./http";
import { session } from "./token";
import type {
    Change,
    Contours,
    Curve,
    Example,
    Host,
    HostFacts,
    HostStatus,
    Islands,
    Job,
    Machine,
    Outlook,
    Output,
    Paths,
    Port,
    Print,
    PrintMessage,
    PrintRequest,
    Report,
    Sending,
    Table,
    Times,
    Values,
    Version,
} from "./types";

type Signal = AbortSignal | undefined;

export const get_version = () => get_json<Version>("/api/version");
export const get_table = () => get_json<Table>("/api/settings");
export const get_machines = () => get_json<Machine[]>("/api/machines");
export const get_examples = () => get_json<Example[]>("/api/examples");
export const get_recipe = () =>
    get_json<{ text: string; path: string | null; saved: boolean }>("/api/recipe");

export const save_recipe = (text: string, path: string | null) =>
    get_json<{ path: string }>("/api/recipe", { method: "PUT", json: path ? { text, path } : { text } });

/** `layer`: the one that will be asked for of the new text's job, so that the server begins with it. */
export const edit_recipe = (text: string, changes: Change[], layer?: number) =>
    get_json<{ text: string }>("/api/edit", {
        method: "POST",
        json: { text, changes, ...(layer === undefined ? {} : { layer, session }) },
    });

export const read_values = (text: string, signal: Signal) =>
    get_json<Values>("/api/values", { method: "POST", json: { text }, signal });

export const send_file = (file: File) =>
    get_json<{ path: string }>(`/api/files?name=${encodeURIComponent(file.name)}`, {
        method: "POST",
        bytes: file,
    });

export const post_job = (text: string, sequence: number, signal: Signal) =>
    get_json<Job>("/api/jobs", { method: "POST", json: { text, session, sequence, searches: false }, signal });

/** The page goes: nobody waits for what the server computes for it. */
export function end_session(): void {
    void fetch(with_token(`/api/sessions/${session}`), { method: "DELETE", keepalive: true });
}

const of_job = (job: Job, rest: string) => `/api/jobs/${job.job}/${rest}`;

/** A window in the plane of a layer, mm. */
export interface Window {
    x0: number;
    y0: number;
    x1: number;
    y1: number;
}

export function get_mask(
    job: Job,
    layer: number,
    width: number,
    window: Window,
    signal: Signal,
): Promise<Blob> {
    const places = Object.entries(window).map(([name, value]) => `${name}=${+(value as number).toFixed(5)}`);
    return get_blob(of_job(job, `layers/${layer}/mask.png?colors=1&width=${width}&${places.join("&")}`), {
        signal,
    });
}

export const get_contours = (job: Job, layer: number, what: "part" | "supports", signal: Signal) =>
    get_json<Contours>(of_job(job, `layers/${layer}/contours?tolerance=0.02&what=${what}`), { signal });

export const get_paths = (job: Job, layer: number, signal: Signal) =>
    get_json<Paths>(of_job(job, `layers/${layer}/paths?session=${session}`), { signal });

export const get_curve = (job: Job, signal: Signal) =>
    get_json<Curve>(of_job(job, `curve?values=400&session=${session}`), { signal });

export const get_islands = (job: Job, signal: Signal) =>
    get_json<Islands>(of_job(job, `curve/islands?values=400&session=${session}`), { signal });

export const get_times = (job: Job, values: number, signal: Signal) =>
    get_json<Times>(of_job(job, `curve/time?values=${values}&session=${session}`), { signal });

export const get_volume = (job: Job, voxels: number, signal: Signal) =>
    get_bytes(of_job(job, `volume?n=${voxels}&session=${session}`), { signal });

export interface FrameView {
    width: number;
    azimuth: number;
    elevation: number;
    cut: string;
    cut_at: number;
    paint: string;
}

export function get_frame(job: Job, view: FrameView, signal: Signal): Promise<Blob> {
    const query = Object.entries(view)
        .map(([name, value]) => `${name}=${value as string}`)
        .join("&");
    return get_blob(of_job(job, `frame.png?${query}`), { signal });
}

export const get_check = (job: Job, signal: Signal) =>
    get_json<Report>(of_job(job, `check?session=${session}`), { signal });

export const start_output = (job: Job, file: string) =>
    get_json<{ output: number }>(of_job(job, "outputs"), {
        method: "POST",
        json: file ? { file, session } : { session },
    });

export const get_output = (id: number) => get_json<Output>(`/api/outputs/${id}`);
export const remove_output = (id: number) => get_json<object>(`/api/outputs/${id}`, { method: "DELETE" });

export const get_ports = () => get_json<Port[]>("/api/ports");
export const get_outlook = (job: Job, signal: Signal) => get_json<Outlook>(of_job(job, "print"), { signal });
export const start_print = (job: Job, request: PrintRequest) =>
    get_json<Print>(of_job(job, "print"), { method: "POST", json: request });
export const get_hosts = () => get_json<{ file: string; hosts: Host[] }>("/api/hosts");
const of_host = (name: string, what = "") => `/api/hosts/${encodeURIComponent(name)}${what}`;
export const get_host = (name: string, signal: Signal) => get_json<HostFacts>(of_host(name), { signal });
export const get_host_status = (name: string) => get_json<HostStatus>(of_host(name, "/status"));
export const order_host = (name: string, what: "pause" | "resume" | "cancel") =>
    get_json<HostStatus>(of_host(name, `/${what}`), { method: "POST", json: {} });
export const send_job = (job: Job, host: string, start: boolean) =>
    get_json<Sending>(of_job(job, "send"), { method: "POST", json: { host, start } });
export const get_sending = () => get_json<Sending | { state: "none" }>("/api/sending");
export const cancel_sending = () => get_json<Sending>("/api/sending", { method: "DELETE" });
export const get_print = () => get_json<Print | { state: "none" }>("/api/print");
export const get_print_messages = () => get_json<PrintMessage[]>("/api/print/messages");
export const order_print = (what: "pause" | "resume" | "stop" | "halt") =>
    get_json<Print>(`/api/print/${what}`, { method: "POST", json: {} });
export const choose_button = (button: number) =>
    get_json<Print>("/api/print/choose", { method: "POST", json: { button } });
