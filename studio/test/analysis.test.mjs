// Stiffness and searches on the page against the program itself: the figures are those of its commands.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { open_browser, patience } from "./studio.mjs";

const lamella = process.env.LAMELLA;
const skip = lamella ? false : "LAMELLA is not set";

let browser, folder, program, page, errors, environment;

const end = `[layers]
height = 0.5
[printer]
profile = "prusa-sl1s"
[material]
name = "pla"
`;
const foam = `[part]
shape = "box"
size = [12, 12, 12]
${end}[foam]
cell = 4
beam = 0.6
`;
const cantilever = `[part]
shape = "box"
size = [40, 20, 4]
${end}[[load]]
box = [[20, -2, -2], [20, 2, 2]]
force = [0, -10, 0]
[[anchor]]
face = "-x"
[optimize]
dimensions = 2
elements = 40
volume = 0.4
iterations = 15
`;

before(async () => {
    if (!skip) browser = await open_browser();
});
after(() => browser?.close());
beforeEach(() => {
    folder = mkdtempSync(join(tmpdir(), "studio-"));
    // No plan of an earlier run is found.
    environment = { ...process.env, XDG_CACHE_HOME: join(folder, "cache") };
});
afterEach(async () => {
    await page?.close();
    page = undefined;
    if (program?.exitCode === null) {
        const ended = new Promise((resolve) => program.on("exit", resolve));
        program.kill("SIGINT");
        await ended;
    }
    rmSync(folder, { recursive: true });
});

async function open(recipe) {
    const file = join(folder, "part.toml");
    writeFileSync(file, recipe);
    program = spawn(lamella, ["studio", file, "--folder", folder, "--token", "0123456789abcdef0123"], {
        env: environment,
    });
    const address = await new Promise((resolve, reject) => {
        program.stdout.on("data", (data) => {
            const found = String(data).match(/http:\/\/[^\s]+/);
            if (found) resolve(found[0]);
        });
        program.on("exit", (code) => reject(new Error(`the studio ended with ${code}`)));
    });
    page = await browser.newPage({ viewport: { width: 1400, height: 850 } });
    page.setDefaultTimeout(patience);
    errors = [];
    page.on("pageerror", (error) => errors.push(error.stack ?? error.message));
    await page.goto(address);
    return file;
}

const state = () => page.evaluate(() => window.__studio.state);
const until = (what, argument) => page.waitForFunction(what, argument, { timeout: patience });

/** What a command says about the recipe. Its plans are of its own: what it finds was not found for it. */
const command = (words, file) =>
    JSON.parse(
        execFileSync(lamella, [...words, "-q", "--json", file], {
            env: { ...environment, XDG_CACHE_HOME: join(folder, "other") },
            encoding: "utf8",
        }),
    );

test("a foam's stiffness is that of the command", { skip }, async () => {
    const file = await open(foam);
    await until(() => window.__studio?.state.job);
    await page.getByRole("tab", { name: "Stiffness" }).click();
    await page.getByLabel("Elements along a side").selectOption("32");
    await page.getByLabel("Samples").selectOption("2");
    await page.getByRole("button", { name: "Homogenise" }).click();
    await until(() => window.__studio.state.homogenized?.state === "done");
    const { directions, law, ...found } = (await state()).homogenized.result;
    assert.deepEqual(found, command(["homogenize", "--rve", "32", "--samples", "2"], file));
    assert.equal(directions.young.length, directions.polar * directions.around);
    assert.ok(Math.max(...directions.young) <= found.E_greatest * 1.001);
    assert.ok(law.length > 2);
    await page.getByText(`${Number(found.E.toPrecision(4))} ±`).waitFor();
    assert.deepEqual(errors, []);
});

test("a search is watched, and ends with the command's report and its part", { skip }, async () => {
    const file = await open(cantilever);
    await page.locator(".search-card").getByRole("button", { name: "Optimise" }).click();
    await until(() => window.__studio.state.searched?.steps.length > 0);
    await until(() => {
        const { searched, job, building, design, shown } = window.__studio.state;
        return searched.state === "done" && job && !building && !design && shown?.job === job;
    });
    const { searched } = await state();
    const report = command(["optimize"], file);
    assert.deepEqual(searched.result, report);
    assert.deepEqual(searched.steps, report.history);
    assert.equal(searched.steps.length, 15);
    assert.ok(searched.designs > 0);
    await page.getByText(`${Number(report.compliance_nmm.toPrecision(4))} N mm`, { exact: true }).waitFor();
    assert.deepEqual(errors, []);
});

test("a long search is stopped soon, keeps its design, and another recipe is not held up", { skip }, async () => {
    await open(cantilever.replace("elements = 40", "elements = 300").replace("iterations = 15", "iterations = 5000\ntolerance = 1e-9"));
    await page.locator(".search-card").getByRole("button", { name: "Optimise" }).click();
    await until(() => window.__studio.state.design?.number > 1); // it has evolved
    const begun = Date.now();
    await page.getByRole("button", { name: "stop" }).click();
    await until(() => window.__studio.state.searched.state === "cancelled");
    assert.ok(Date.now() - begun < 30000);
    const { searched, design } = await state();
    assert.ok(searched.result.compliance_nmm > 0);
    assert.equal(searched.result.history.length, searched.steps.length);
    assert.ok(design);
    await page.getByText("Stopped: this is the best design so far.").waitFor();
    assert.deepEqual(errors, []);
});

test("the modulus of a graded foam paints the part", { skip }, async () => {
    await open(foam.replace("cell = 4", 'cell = "4 + 0.1 * x"'));
    await until(() => window.__studio?.state.job && window.__studio.state.voxels > 0);
    await page.waitForTimeout(1500);
    const plain = await page.locator(".view-frame canvas").screenshot();
    await page.getByRole("radio", { name: "modulus" }).click();
    await until(() => window.__studio.state.paint);
    const { paint } = await state();
    assert.ok(paint.hi_mpa > 1.2 * paint.lo_mpa);
    assert.equal(paint.is_asked, false);
    await page.waitForTimeout(1500);
    assert.notDeepEqual(await page.locator(".view-frame canvas").screenshot(), plain);
    await page.getByRole("tab", { name: "Stiffness" }).click();
    await page.getByRole("button", { name: "Homogenise" }).click();
    await page.getByRole("alert").filter({ hasText: "a sample stands for one place" }).waitFor();
    assert.deepEqual(errors, []);
});
