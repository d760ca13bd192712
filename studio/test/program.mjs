// The program itself behind the page, in a folder of its own: LAMELLA names it.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { patience } from "./studio.mjs";

export const lamella = process.env.LAMELLA;
export const models = process.env.LAMELLA_MODELS;
export const token = "0123456789abcdef0123";
export const skip = lamella ? false : "LAMELLA is not set";

/** A running studio with a page on it. */
export class Program {
    folder = mkdtempSync(join(tmpdir(), "studio-"));
    errors = [];

    /** Writes a file of the folder; returns its path. */
    write(name, content) {
        const path = join(this.folder, name);
        writeFileSync(path, content);
        return path;
    }

    /** Starts the studio; resolves to its address once it listens. */
    async start(recipe, at = 0) {
        const named = recipe ? [join(this.folder, recipe)] : [];
        const options = ["--folder", this.folder, "--port", `${at}`, "--token", token];
        this.process = spawn(lamella, ["studio", ...named, ...options]);
        const address = await new Promise((resolve, reject) => {
            let text = "";
            this.process.stdout.on("data", (data) => {
                text += data;
                const found = text.match(/http:\/\/[^\s]+/);
                if (found) resolve(found[0]);
            });
            this.process.on("exit", (code) => reject(new Error(`the studio ended with ${code}`)));
        });
        this.port = Number(new URL(address).port);
        return address;
    }

    async open(browser, recipe, options = {}) {
        const address = await this.start(recipe);
        this.page = await browser.newPage({ viewport: { width: 1400, height: 850 }, ...options });
        this.page.setDefaultTimeout(patience);
        this.page.on("pageerror", (error) => this.errors.push(error.stack ?? error.message));
        this.page.on("console", (message) => {
            if (/Content Security Policy|Refused to/.test(message.text())) this.errors.push(message.text());
        });
        await this.page.goto(address);
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

    async end(signal = "SIGINT") {
        if (this.process?.exitCode !== null) return;
        const ended = new Promise((resolve) => this.process.on("exit", resolve));
        this.process.kill(signal);
        await ended;
    }

    /** Ends all, and returns the errors of the page. */
    async close() {
        await this.page?.close();
        await this.end();
        rmSync(this.folder, { recursive: true });
        return this.errors;
    }
}
