// The replies of the server, as the page uses them.

export type Triple = [number, number, number];

export interface Mistake {
    line: number | null;
    text: string;
}

export interface Version {
    name: string;
    version: string;
    studio: boolean;
    recipe: string | null;
    threads: number;
}

export type SettingType =
    | "boolean"
    | "integer"
    | "number"
    | "text"
    | "lines"
    | "path"
    | "choice"
    | "triple"
    | "graded"
    | "graded_triple"
    | "formula"
    | "rows";

export interface Setting {
    section: string;
    key: string;
    flag: string;
    type: SettingType;
    unit: string;
    lo: number | null;
    hi: number | null;
    choices: string[];
    default: string;
    help: string;
}

export interface Section {
    name: string;
    title: string;
    help: string;
    list: boolean;
}

/** A key that chooses which other keys of its section apply. */
export interface KindKey {
    section: string;
    key: string;
    /** The kind when the key is missing; empty when it is required. */
    default: string;
    words: Record<string, { needs: string[]; takes: string[] }>;
}

export interface Table {
    sections: Section[];
    settings: Setting[];
    kinds: KindKey[];
}

export interface Machine {
    name: string;
    description: string;
    backend: string;
    process: string;
    extension: string;
}

export interface Example {
    name: string;
    title: string;
    text: string;
}

export interface Values {
    values: Record<string, string>;
    lists: Record<string, Record<string, string>[]>;
    given: string[];
}

/** A change of one key. Value null removes the key; key null removes the section, or the entry of a list. */
export interface Change {
    section: string;
    index?: number;
    key: string | null;
    value: string | null;
}

export type Structure = "skin" | "frame" | "solid" | "foam" | "body" | "supports";

export interface Job {
    job: string;
    name: string;
    machine: string;
    backend: string;
    process: string;
    bounds: { lo: Triple; hi: Triple };
    layers: { count: number; heights: [number, number][]; height_mm: number };
    /** Rows of the matrix from the recipe's coordinates to those of the job; null: a point has several places. */
    axes: [Triple, Triple, Triple] | null;
    /** Height of the bed in the space of the job, mm. */
    z0: number;
    supports: boolean;
    /** Of the foam, where it is known. */
    modulus: { predicted_MPa: [number, number] } | null;
    /** What of the part can be told apart; empty: nothing. */
    structure: Structure[];
    /** Numbers that vary over the part. */
    numbers: { name: string; unit: string }[];
    notes: string[];
    display: {
        width: number;
        height: number;
        pixel_x: number;
        pixel_y: number;
    } | null;
}

export interface Contours {
    contours: { parent: number; points: number[] }[];
    area: number;
}

export interface Path {
    role: string;
    tool: number;
    /** The greatest of the path, mm and mm/s. */
    width: number;
    speed: number;
    closed: boolean;
    points: number[];
    /** Of each segment, where they vary. */
    widths?: number[];
    speeds?: number[];
}

export interface Travel {
    /** Number of paths that come before it. */
    after: number;
    speed: number;
    retracts: boolean;
    points: number[];
}

export interface Paths {
    paths: Path[];
    travels: Travel[];
    seconds: number;
}

export interface Curve {
    layers_a_value: number;
    area_mm2: number[];
    support_area_mm2: number[];
}

/** Pieces that begin with nothing below them, of all layers that share a value. */
export interface Islands {
    layers_a_value: number;
    islands: number[];
    pitch_mm: number;
}

export interface Times {
    layers_a_value: number;
    seconds: number[];
}

/** A place of a fault; its size is in a field named by its unit, such as size_mm2. */
export interface Place {
    at_mm: Triple;
    layer: number;
    box_mm?: { lo: Triple; hi: Triple };
    [size: `size_${string}`]: number;
}

export interface Check {
    check: string;
    verdict: string;
    passed: boolean;
    limit: string;
    count: number;
    worst: Place[];
}

export interface Report {
    passed: boolean;
    checks: Check[];
}

export interface Output {
    output: number;
    state: "waiting" | "running" | "done" | "failed" | "cancelled";
    done: number;
    of: number;
    file: string;
    /** 0 when it is a folder. */
    bytes: number;
    /** Whether it stays in the folder of the studio. */
    is_kept: boolean;
    message: string;
}

export interface Port {
    path: string;
    /** A name that survives replugging; may be empty. */
    by_id: string;
    description: string;
}

/** Whether a job can be printed, and what is left of a stopped print of its name. */
export interface Outlook {
    accepted: boolean;
    message: string;
    left: { journal: string; next_layer: number | null; is_of_job: boolean } | null;
}

export interface PrintRequest {
    to: { serial: string; baud: number; reset?: boolean; ping_pong?: boolean };
    park?: [number, number];
    resume?: boolean;
    discard_journal?: boolean;
}

/** Degrees Celsius; a target is 0 where the heater is off. */
export interface Temperatures {
    nozzle: number;
    nozzle_target: number;
    bed: number;
    bed_target: number;
}

export interface Print {
    state: "connecting" | "printing" | "paused" | "stopping" | "done" | "stopped" | "failed";
    print: number;
    job: string;
    name: string;
    machine: string;
    to: { serial: string; baud: number };
    firmware: string;
    halts_at_once: boolean;
    /** What keeps the print from going on, such as "heating". */
    doing: string;
    question: { text: string; buttons: string[] } | null;
    layers: number;
    layer: number | null;
    layers_computed: number;
    share: number | null;
    seconds: number;
    seconds_left: number | null;
    lines: number;
    lines_a_second: number;
    bytes_a_second: number;
    temperatures: Temperatures | null;
    resumable: boolean;
    message: string;
}

export interface PrintMessage {
    print: number;
    number: number;
    text: string;
}

/** A printer on the network that the user's file of hosts names. */
export interface Host {
    name: string;
    kind: string;
    url: string;
}

export interface HostStatus {
    state: "offline" | "idle" | "busy" | "printing" | "paused" | "finished" | "cancelled" | "failed";
    file: string;
    /** 0 to 1. */
    progress?: number;
    layer?: number;
    layers?: number;
    left_s?: number;
    heaters?: { name: string; now: number; target: number }[];
    message?: string;
}

export interface HostFacts {
    software: string;
    machine: string;
    encrypted: boolean;
    free_bytes?: number;
    status: HostStatus;
}

/** A job on its way to a host. */
export interface Sending {
    state: "running" | "done" | "failed" | "cancelled";
    sending: number;
    job: string;
    host: string;
    file: string;
    layers: number;
    of_layers: number;
    bytes: number;
    of_bytes: number | null;
    prints: boolean;
    message: string;
}

export interface Progress {
    what: "build" | "check" | "output";
    id: number | null;
    done: number;
    of: number;
    text: string;
}
