// The program itself, as LAMELLA names it.
import { spawn } from "node:child_process";

export const token = "0123456789abcdef0123";

/** Starts the studio; resolves once it listens. */
export async function start_program(folder, recipes = [], port = 0) {
    const program = spawn(process.env.LAMELLA, ["studio", ...recipes, "--folder", folder, "--port", `${port}`,
        "--token", token]);
    const address = await new Promise((resolve, reject) => {
        let text = "";
        program.stdout.on("data", (data) => {
            text += data;
            const found = text.match(/http:\/\/[^\s]+/);
            if (found) resolve(found[0]);
        });
        program.on("exit", (code) => reject(new Error(`the studio ended with ${code}`)));
    });
    return {
        address,
        port: Number(new URL(address).port),
        runs: () => program.exitCode === null && program.signalCode === null,
        end: (signal = "SIGINT") => {
            const ended = new Promise((resolve) => program.on("exit", resolve));
            program.kill(signal);
            return ended;
        },
    };
}
