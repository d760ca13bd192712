// Outputs that this page has started, and how far they are.
import { signal } from "@preact/signals";
import { get_output, remove_output, start_output } from "../server/api";
import { Failure } from "../server/http";
import type { Output } from "../server/types";
import { report } from "../state/notices";
import { job } from "../state/store";

export interface Row {
    output: Output;
    machine: string;
    begun: number;
    /** Layers a second, while it runs. */
    rate: number;
}

export const rows = signal<Row[]>([]);

export const runs = ({ state }: Output): boolean => state === "waiting" || state === "running";

/** Takes over what the server says about an output of this page. */
export function take_output(output: Output): void {
    rows.value = rows.value.map((row) => {
        if (row.output.output !== output.output) return row;
        const seconds = (Date.now() - row.begun) / 1000;
        return { ...row, output, rate: seconds > 0.5 ? output.done / seconds : row.rate };
    });
}

/** An empty name: the file is kept until the studio ends, and is there to be downloaded. */
export async function start(file: string): Promise<void> {
    const made = job.value;
    if (!made) return;
    try {
        const { output } = await start_output(made, file);
        const begun: Output = {
            output,
            state: "waiting",
            done: 0,
            of: made.layers.count,
            file,
            bytes: 0,
            is_kept: file !== "",
            message: "",
        };
        rows.value = [{ output: begun, machine: made.machine, begun: Date.now(), rate: 0 }, ...rows.value];
        take_output(await get_output(output));
    } catch (error) {
        report(error);
    }
}

/** Cancels an output that runs, or removes one that has ended. */
export async function remove(row: Row): Promise<void> {
    try {
        await remove_output(row.output.output);
    } catch (error) {
        if (!(error instanceof Failure && error.status === 404)) {
            report(error);
            return;
        }
    }
    rows.value = rows.value.filter((one) => one.output.output !== row.output.output);
}

/** Asks anew for all outputs: the line to the server was broken, events may be missing. */
export async function ask_again(): Promise<void> {
    for (const { output } of rows.value) {
        if (!runs(output)) continue;
        try {
            take_output(await get_output(output.output));
        } catch (error) {
            if (!(error instanceof Failure && error.status === 404)) continue;
            take_output({ ...output, state: "failed", message: "The server no longer knows this output." });
        }
    }
}
