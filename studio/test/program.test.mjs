// The page against the program itself: LAMELLA names it. From a dropped model to a file with the command's bytes.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { copyFileSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { box_stl, open_browser, patience } from "./studio.mjs";

const lamella = process.env.LAMELLA;
const models = process.env.LAMELLA_MODELS;
const token = "0123456789abcdef0123";
const skip = lamella ? false : "LAMELLA is not set";

let browser, folder, program, page, errors, port;

/** Starts the studio; resolves once it listens. */
async function start_program(recipe, at = 0) {
    const started = spawn(lamella, ["studio", ...(recipe ? [recipe] : []), "--folder", folder, "--port", `${at}`,
        "--token", token]);
    const address = await new Promise((resolve, reject) => {
        let text = "";
        started.stdout.on("data", (data) => {
            text += data;
            const found = text.match(/http:\/\/[^\s]+/);
            if (found) resolve(found[0]);
        });
        started.on("exit", (code) => reject(new Error(`the studio ended with ${code}`)));
    });
    program = started;
    port = Number(new URL(address).port);
    return address;
}

function end_program(signal = "SIGINT") {
    const ended = new Promise((resolve) => program.on("exit", resolve));
    program.kill(signal);
    return ended;
}

async function open(recipe) {
    const address = await start_program(recipe);
    page = await browser.newPage({ viewport: { width: 1400, height: 850 } });
    page.setDefaultTimeout(patience);
    errors = [];
    page.on("pageerror", (error) => errors.push(error.stack ?? error.message));
    page.on("console", (message) => {
        if (/Content Security Policy|Refused to/.test(message.text())) errors.push(message.text());
    });
    await page.goto(address);
}

const state = () => page.evaluate(() => window.__studio.state);
const until = (what, argument) => page.waitForFunction(what, argument, { timeout: patience });
const shown = () =>
    until(() => {
        const { job, shown, building } = window.__studio.state;
        return job && !building && shown?.job === job && shown.layer === window.__studio.state.layer;
    });

/** A box of foam on a machine with pixels of 0.05 mm. */
const foam_box = `[part]
mesh = "box.stl"
unit = "mm"
[foam]
cell = 3      # of the foam
beam = 0.4
[layers]
height = 0.1
[printer]
profile = "prusa-sl1s"
pixel = 0.05
antialiasing = "rows"
sub_rows = 4
`;

before(async () => {
    if (!skip) browser = await open_browser();
});
after(() => browser?.close());
beforeEach(() => {
    folder = mkdtempSync(join(tmpdir(), "studio-"));
    writeFileSync(join(folder, "box.stl"), box_stl(20, 15, 10));
    writeFileSync(join(folder, "part.toml"), foam_box);
});
afterEach(async () => {
    if (page) {
        await page.close();
        page = undefined;
        assert.deepEqual(errors, []);
    }
    if (program?.exitCode === null) await end_program();
    rmSync(folder, { recursive: true });
});

/** The greys of a picture's pixels, as the browser decodes them. */
const greys_of = (base64) =>
    page.evaluate(async (text) => {
        const bytes = Uint8Array.from(atob(text), (one) => one.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }), {
            colorSpaceConversion: "none", // the section says its gamma
        });
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        return { width: bitmap.width, greys: [...data.filter((_, i) => i % 4 === 0)] };
    }, base64);

const differing = (a, b) => a.reduce((count, grey, i) => count + (grey === b[i] ? 0 : 1), 0);

async function mask_of_page() {
    const { job, layer } = await state();
    const reply = await fetch(`http://127.0.0.1:${port}/api/jobs/${job}/layers/${layer}/mask.png?width=400&token=${token}`);
    return greys_of(Buffer.from(await reply.arrayBuffer()).toString("base64"));
}

test("a model that is dropped gets foam, whose layers are those of the command", { skip }, async () => {
    await open();
    await page.waitForSelector(".drop-zone");
    const transfer = await page.evaluateHandle((data) => {
        const files = new DataTransfer();
        files.items.add(new File([new Uint8Array(data)], "dropped.stl"));
        return files;
    }, [...box_stl(20, 15, 10)]);
    await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
    await shown();
    assert.ok(existsSync(join(folder, "dropped.stl")));
    assert.match((await state()).text, /mesh = "dropped\.stl"/);
    assert.match((await state()).text, /\[foam\]\ncell = 4/);
});

test("another cell size shows another layer, pixel by pixel that of the command", { skip }, async () => {
    await open(join(folder, "part.toml"));
    await shown();
    const { job } = await state();
    const first = await mask_of_page();
    const picture = await page.locator(".layer-room").screenshot();
    await page.fill("#field-foam-0-cell", "2.5");
    await page.keyboard.press("Enter");
    await until((old) => window.__studio.state.job !== old, job);
    await shown();
    const { text, layer } = await state();
    assert.match(text, /^cell = 2\.5 +# of the foam$/m);
    const second = await mask_of_page();
    assert.ok(differing(second.greys, first.greys) > 100);
    assert.notDeepEqual(await page.locator(".layer-room").screenshot(), picture);
    writeFileSync(join(folder, "now.toml"), text);
    const z = ((layer + 0.5) * 0.1).toFixed(6);
    execFileSync(lamella, ["section", join(folder, "now.toml"), "--z", z, "-o", join(folder, "now.png")]);
    const section = await greys_of(readFileSync(join(folder, "now.png")).toString("base64"));
    assert.equal(section.width, 400);
    assert.equal(differing(section.greys, second.greys), 0);
});

test("a slider's release shows a new layer soon", { skip }, async (context) => {
    if (models) copyFileSync(join(models, "koala_mm.obj"), join(folder, "koala.obj"));
    const koala = foam_box.replace("box.stl", models ? "koala.obj" : "box.stl");
    writeFileSync(join(folder, "part.toml"), koala);
    await open(join(folder, "part.toml"));
    await shown();
    await page.waitForTimeout(3000);
    const times = [];
    const slider = page.getByRole("slider", { name: "cell, slider" });
    await slider.focus();
    for (let i = 0; i < 9; ++i) {
        const { job } = await state();
        const begin = await page.evaluate(() => performance.now());
        await slider.press("ArrowRight"); // a cell that no job had before
        await until((old) => {
            const { job, shown } = window.__studio.state;
            return job !== old && shown?.job === job;
        }, job);
        times.push((await page.evaluate(() => performance.now())) - begin);
        await page.waitForTimeout(1500);
    }
    times.sort((a, b) => a - b);
    context.diagnostic(`${times.map((one) => one.toFixed(0)).join(", ")} ms`);
});

test("a wrong formula is told at its key, with the program's own words", { skip }, async () => {
    await open(join(folder, "part.toml"));
    await shown();
    await page.getByRole("button", { name: "cell as a formula" }).click();
    await page.fill("#field-foam-0-cell", "3 + q");
    const wrong = page.locator("#field-foam-0-cell-wrong");
    await wrong.waitFor();
    assert.match(await wrong.textContent(), /q/);
    await page.fill("#field-foam-0-cell", "3 + 0.05 * x");
    await wrong.waitFor({ state: "detached" });
    await shown();
});

test("a fault that is found leads to its layer", { skip }, async () => {
    await open(join(folder, "part.toml"));
    await shown();
    await page.keyboard.press("Alt+2");
    await page.getByRole("button", { name: "Check", exact: true }).click();
    await page.waitForSelector(".fault");
    const fault = page.locator(".fault").first();
    await fault.click();
    await shown();
    assert.ok((await fault.textContent()).includes(`layer ${(await state()).layer + 1}`));
});

test("what is made has the command's bytes", { skip }, async () => {
    await open(join(folder, "part.toml"));
    await shown();
    await page.getByRole("tab", { name: "Make" }).click();
    await page.getByRole("button", { name: /^Make \d+ layers$/ }).click();
    const link = page.getByRole("link", { name: "Download" });
    await link.waitFor();
    const [download] = await Promise.all([page.waitForEvent("download"), link.click()]);
    const name = download.suggestedFilename();
    execFileSync(lamella, ["slice", "-q", join(folder, "part.toml"), "-o", join(folder, name)]);
    assert.ok(readFileSync(await download.path()).equals(readFileSync(join(folder, name))));
});

test("the program ends and starts again: the page goes on", { skip }, async () => {
    await open(join(folder, "part.toml"));
    await shown();
    const at = port;
    await end_program("SIGKILL");
    await until(() => window.__studio.state.away);
    await start_program(join(folder, "part.toml"), at);
    await until(() => !window.__studio.state.away);
    await page.fill("#field-foam-0-cell", "4");
    await page.keyboard.press("Enter");
    await until(() => /cell = 4/.test(window.__studio.state.text));
    await shown();
});
