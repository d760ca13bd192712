// Toolpaths: coloured by role, speed or width, with travel; given up for those of another layer.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { Program, skip } from "./program.mjs";
import { open_browser, open_studio } from "./studio.mjs";
import { violations } from "./violations.mjs";

let browser, studio, program;
before(async () => {
    browser = await open_browser();
});
after(() => browser.close());
afterEach(async () => {
    await studio?.close();
    await program?.close();
    studio = program = undefined;
});

const recipe = `[part]
shape = "sphere"
radius = 6
[layers]
height = 0.2
[printer]
profile = "marlin"
`;

const legend = (page) => page.getByLabel("Colours of the paths");
const words = async (page) => (await legend(page).innerText()).replace(/\s+/g, " ");
/** What the canvas of the layer holds once it is drawn anew. */
const picture = (page) =>
    page.evaluate(async () => {
        for (let i = 0; i < 2; ++i) await new Promise(requestAnimationFrame);
        return document.querySelector(".layer-room canvas").toDataURL();
    });

test("paths show role, speed, width and travel, by keys", async () => {
    studio = await open_studio(browser, { recipe });
    const { page } = studio;
    assert.match(await words(page), /outer wall infill/);
    const roles = await picture(page);
    await page.getByRole("radio", { name: "role" }).focus();
    await page.keyboard.press("ArrowRight");
    assert.equal((await studio.state()).path_look.colour, "speed");
    assert.match(await words(page), /^speed 30 60 90 mm\/s F1800 – F5400$/);
    const speeds = await picture(page);
    assert.notEqual(speeds, roles);
    await page.keyboard.press("ArrowRight");
    assert.match(await words(page), /^width 0\.45 mm$/);
    await page.getByRole("checkbox", { name: "travel" }).focus();
    const widths = await picture(page);
    await page.keyboard.press("Space");
    assert.match(await words(page), /travel travel, retracted$/);
    assert.notEqual(await picture(page), widths);
    assert.deepEqual(await violations(page), []);
    await page.getByRole("radio", { name: "contours" }).click();
    await page.getByText("Colours", { exact: true }).waitFor({ state: "detached" });
    assert.deepEqual(studio.errors, []);
});

test("paths that take long are given up for those of another layer", async () => {
    studio = await open_studio(browser, { recipe });
    const { page } = studio;
    const { layer } = await studio.state();
    const failed = [];
    page.on("requestfailed", (request) => failed.push(new URL(request.url()).pathname));
    await page.route(`**/layers/${layer + 1}/paths*`, () => {}); // never answered
    await page.getByRole("slider", { name: "Layer", exact: true }).focus();
    await page.keyboard.press("Shift+ArrowUp");
    await page.waitForTimeout(100);
    await page.keyboard.press("Shift+ArrowUp");
    await studio.until((wanted) => window.__studio.state.shown.layer === wanted, layer + 2);
    assert.ok(failed.some((path) => path.endsWith(`/layers/${layer + 1}/paths`)));
    assert.deepEqual(studio.errors, []);
});

test("the mask of a layer is shown while its paths are on their way", async () => {
    studio = await open_studio(browser, { recipe });
    const { page } = studio;
    const { layer } = await studio.state();
    let answer;
    const asked = new Promise((resolve) => {
        page.route(`**/layers/${layer + 1}/paths*`, (route) => {
            answer = () => route.continue();
            resolve();
        });
    });
    await page.getByRole("slider", { name: "Layer", exact: true }).focus();
    await page.keyboard.press("ArrowUp");
    await asked;
    await studio.until((wanted) => window.__studio.state.shown.layer === wanted, layer + 1);
    const mask = await picture(page);
    answer();
    await page.waitForFunction(
        (before) => document.querySelector(".layer-room canvas").toDataURL() !== before,
        mask,
    );
    assert.equal((await studio.state()).shown.layer, layer + 1);
    assert.deepEqual(studio.errors, []);
});

test("the speeds of the legend are those of the G-code", { skip }, async () => {
    program = new Program();
    const path = program.write("part.toml", `${recipe}least_layer_time = 12\nwall_speed = 25\n`);
    const page = await program.open(browser, "part.toml");
    await program.shown();
    await page.getByRole("radio", { name: "speed" }).click();
    const { layer } = await program.state();
    execFileSync(process.env.LAMELLA, ["slice", "-q", path, "-o", join(program.folder, "part.gcode")]);
    const text = readFileSync(join(program.folder, "part.gcode"), "utf8").split(";LAYER_CHANGE")[layer + 1];
    let rate = 0;
    const rates = [];
    for (const line of text.split("\n")) {
        rate = Number(line.match(/ F(\d+)/)?.[1] ?? rate);
        if (/^G[123] X.* E\d/.test(line)) rates.push(rate);
    }
    assert.ok(Math.max(...rates) > Math.min(...rates));
    assert.match(await words(page), new RegExp(`F${Math.min(...rates)} – F${Math.max(...rates)}$`));
    assert.deepEqual(program.errors, []);
});
