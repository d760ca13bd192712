// Requests to the server. Every failure is a Failure with one message for people.
import { token } from "./token";
import type { Mistake } from "./types";

export class Failure extends Error {
    /** `status` 0: the server did not answer. */
    constructor(
        readonly status: number,
        message: string,
        readonly mistakes: Mistake[] = [],
    ) {
        super(message);
    }

    /** Whether newer work replaced this request, so nobody waits for its answer. */
    get outdated(): boolean {
        return this.status === 409 || this.status === -1;
    }
}

export interface Options {
    method?: "GET" | "POST" | "PUT" | "DELETE";
    json?: unknown;
    bytes?: Blob;
    signal?: AbortSignal | undefined;
}

async function failure_of(reply: Response): Promise<Failure> {
    let message = `${reply.status} ${reply.statusText}`;
    let mistakes: Mistake[] = [];
    try {
        const body = (await reply.json()) as { message?: string; mistakes?: Mistake[] };
        message = body.message ?? message;
        mistakes = body.mistakes ?? [];
    } catch {
        // The reply is no JSON: its status says all there is.
    }
    if (reply.status === 401)
        message = "The server refused the token. Open the address that lamella studio printed.";
    return new Failure(reply.status, message, mistakes);
}

/** A server that has too much to do at once is asked again, so many times, after so long (ms). */
const tries = 4;
const pause = 400;

async function send(path: string, options: Options): Promise<Response> {
    for (let left = tries - 1; ; --left) {
        const reply = await send_once(path, options);
        if (reply.ok) return reply;
        if ((reply.status !== 429 && reply.status !== 503) || left === 0) throw await failure_of(reply);
        await new Promise((resolve) => setTimeout(resolve, pause));
    }
}

async function send_once(path: string, options: Options): Promise<Response> {
    const headers: Record<string, string> = { Authorization: `Bearer ${token}` };
    if (options.json !== undefined) headers["Content-Type"] = "application/json";
    try {
        return await fetch(path, {
            method: options.method ?? "GET",
            headers,
            body: options.bytes ?? (options.json === undefined ? null : JSON.stringify(options.json)),
            signal: options.signal ?? null,
        });
    } catch (error) {
        if (options.signal?.aborted) throw new Failure(-1, "cancelled");
        throw new Failure(0, "The server does not answer.");
    }
}

async function read<T>(path: string, options: Options, take: (reply: Response) => Promise<T>): Promise<T> {
    const reply = await send(path, options);
    try {
        return await take(reply);
    } catch {
        if (options.signal?.aborted) throw new Failure(-1, "cancelled");
        throw new Failure(0, "The server broke off its answer.");
    }
}

export const get_json = <T>(path: string, options: Options = {}): Promise<T> =>
    read(path, options, (reply) => reply.json() as Promise<T>);

export const get_bytes = (path: string, options: Options = {}): Promise<ArrayBuffer> =>
    read(path, options, (reply) => reply.arrayBuffer());

export const get_blob = (path: string, options: Options = {}): Promise<Blob> =>
    read(path, options, (reply) => reply.blob());

/** An address that carries the token itself, for downloads and event streams. */
export function with_token(path: string): string {
    return `${path}${path.includes("?") ? "&" : "?"}token=${encodeURIComponent(token)}`;
}
