// A machine for the program to print to.
import { spawn } from "node:child_process";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

/** What a sender asks for itself. */
const is_own = (line) => /^M(105|108|110|115|155|400)\b/.test(line);

/** Returns its port, and the commands of the job and of its end that it got. */
export async function start_machine() {
    const machine = spawn("python3", [fileURLToPath(new URL("machine.py", import.meta.url))]);
    const lines = [];
    const port = await new Promise((resolve, reject) => {
        createInterface({ input: machine.stdout }).on("line", (line) => {
            if (line.startsWith("/dev/")) resolve(line);
            else if (!is_own(line)) lines.push(line);
        });
        machine.on("exit", (code) => reject(new Error(`the machine ended with ${code}`)));
    });
    return { port, lines: () => lines, end: () => machine.kill() };
}
