// The program itself behind the page, as LAMELLA names it.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { patience } from "./studio.mjs";

export const models = process.env.LAMELLA_MODELS;
export const skip = process.env.LAMELLA ? false : "LAMELLA is not set";
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

/** A running studio in a folder of its own, with a page on it. */
export class Program {
    folder = mkdtempSync(join(tmpdir(), "studio-"));
    errors = [];

    /** Writes a file of the folder; returns its path. */
    write(name, content) {
        const path = join(this.folder, name);
        writeFileSync(path, content);
        return path;
    }

    async open(browser, recipe, options = {}) {
        this.program = await start_program(this.folder, [join(this.folder, recipe)]);
        this.page = await browser.newPage({ viewport: { width: 1400, height: 850 }, ...options });
        this.page.setDefaultTimeout(patience);
        this.page.on("pageerror", (error) => this.errors.push(error.stack ?? error.message));
        this.page.on("console", (message) => {
            if (/Content Security Policy|Refused to/.test(message.text())) this.errors.push(message.text());
        });
        await this.page.goto(this.program.address);
        return this.page;
    }

    state() {
        return this.page.evaluate(() => window.__studio.state);
    }

    until(what, argument) {
        return this.page.waitForFunction(what, argument, { timeout: patience });
    }

    /** The layer that is looked at is that of the newest job. */
    shown() {
        return this.until(() => {
            const { job, shown, building } = window.__studio.state;
            return job && !building && shown?.job === job && shown.layer === window.__studio.state.layer;
        });
    }

    /** The recipe's text holds what the pattern says, and its layer is shown. */
    async text_with(pattern) {
        await this.until(([source]) => new RegExp(source).test(window.__studio.state.text), [pattern.source]);
        await this.shown();
        return (await this.state()).text;
    }

    /** Ends all, and returns the errors of the page. */
    async close() {
        await this.page?.close();
        if (this.program?.runs()) await this.program.end();
        rmSync(this.folder, { recursive: true });
        return this.errors;
    }
}
