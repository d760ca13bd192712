// The panel of Stiffness and the paint of the view, against the mock.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { open_browser, open_studio } from "./studio.mjs";
import { violations } from "./violations.mjs";

let browser;
before(async () => {
    browser = await open_browser();
});
after(() => browser.close());

const ball = `[part]
shape = "sphere"
radius = 10
[layers]
height = 0.1
[printer]
profile = "prusa-sl1s"
`;
const foam = `${ball}[material]
name = "pla"
[foam]
cell = 4
beam = 0.6
`;
const search = `${ball}[material]
name = "pla"
[[load]]
face = "+z"
force = [0, 0, -10]
[[anchor]]
face = "-z"
[optimize]
volume = 0.4
`;

const open_panel = (page) => page.getByRole("tab", { name: "Stiffness" }).click();

/** The value of a fact in a list of them. */
const fact = (page, list, name) =>
    page.getByLabel(list, { exact: true }).locator("div", { hasText: name }).first().locator("b").textContent();

for (const scheme of ["light", "dark"]) {
    test(`a foam is homogenised: figures, directions, law; ${scheme}`, async () => {
        const studio = await open_studio(browser, { recipe: foam, scheme });
        const { page } = studio;
        await open_panel(page);
        await page.getByLabel("Samples").selectOption("2");
        await page.getByRole("button", { name: "Homogenise" }).click();
        await page.getByLabel("Progress of the homogenisation").waitFor();
        await studio.until(() => window.__studio.state.homogenized?.state === "done");
        assert.equal((await studio.state()).homogenized.result.samples.length, 2);
        assert.equal(await fact(page, "Stiffness of the foam", "Young's modulus"), "72.5 ± 3.5 MPa");
        assert.equal(await fact(page, "Stiffness of the foam", "density"), "15.3 ± 0.35 %");
        assert.equal(await fact(page, "Stiffness of the foam", "Poisson"), "0.31");
        const surface = page.getByLabel(/^Modulus in all directions, from 60 to 90 MPa/);
        const shot = await surface.screenshot();
        await surface.focus();
        for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowUp");
        assert.notDeepEqual(await surface.screenshot(), shot, "the keys turn the surface");
        const turned = await surface.screenshot();
        const box = await surface.boundingBox();
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        await page.mouse.down();
        await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 30, { steps: 4 });
        await page.mouse.up();
        assert.notDeepEqual(await surface.screenshot(), turned, "the mouse turns the surface");
        const chart = page.getByLabel(/^Modulus over density: the law/);
        assert.ok((await chart.locator("canvas").boundingBox()).height > 100);
        assert.deepEqual(await violations(page), []);
        assert.deepEqual(studio.errors, []);
        await studio.close();
    });

    test(`a search shows its steps and its designs, then the part; ${scheme}`, async () => {
        const recipe = search.replace("volume = 0.4", "volume = 0.4\niterations = 100");
        const studio = await open_studio(browser, { recipe, scheme, wait: false });
        const { page } = studio;
        await page.getByText("This part has to be optimised first.").waitFor();
        assert.equal((await studio.state()).job, null);
        assert.deepEqual(await violations(page), [], "before");
        await page.locator(".search-card").getByRole("button", { name: "Optimise" }).click();
        assert.equal((await studio.state()).tab, "stiffness");
        const early = await studio.until(() => {
            const { searched, design, voxels } = window.__studio.state;
            return searched?.steps.length > 5 && voxels > 30 && design?.step;
        });
        await studio.until((step) => window.__studio.state.design?.step > step, await early.jsonValue());
        await studio.until(() => {
            const { searched, job, building, design } = window.__studio.state;
            return searched.state === "done" && job && !building && !design;
        });
        assert.equal((await studio.state()).searched.steps.length, 100);
        assert.equal(await fact(page, "Report of the search", "compliance"), "2.2 N mm");
        assert.equal(await fact(page, "Report of the search", "volume"), "40 %");
        await page.getByLabel(/^Steps of the search: compliance, N mm, now 2.2 at a volume of 40 %/).waitFor();
        await page.getByText("The search has done all its steps.").waitFor();
        assert.equal(await page.locator(".search-card").count(), 0);
        assert.deepEqual(await violations(page), [], "after");
        assert.deepEqual(studio.errors, []);
        await studio.close();
    });
}

test("a search can be stopped, and its best design is kept", async () => {
    const recipe = search.replace("volume = 0.4", "volume = 0.4\niterations = 4000");
    const studio = await open_studio(browser, { recipe, wait: false });
    const { page } = studio;
    await page.getByText("This part has to be optimised first.").waitFor();
    await page.keyboard.press("Alt+3");
    await page.getByRole("button", { name: "Optimise", exact: true }).first().click();
    await studio.until(() => window.__studio.state.searched?.steps.length > 3);
    await page.getByRole("button", { name: "stop" }).click();
    await studio.until(() => window.__studio.state.searched.state === "cancelled");
    await page.getByText("Stopped: this is the best design so far.").waitFor();
    const { searched, job, design } = await studio.state();
    assert.ok(searched.result.compliance_nmm > 2);
    assert.equal(job, null, "a design that is not the end of a search is no part");
    assert.ok(design);
    await page.getByRole("button", { name: "Go on" }).click();
    await studio.until((old) => window.__studio.state.searched.analysis > old, searched.analysis);
    await page.getByRole("button", { name: "stop" }).click();
    await studio.close();
});

test("what is missing is said, and can be added", async () => {
    const studio = await open_studio(browser, { recipe: ball });
    const { page } = studio;
    await open_panel(page);
    assert.equal(await page.getByRole("button", { name: "Homogenise" }).isDisabled(), true);
    await page.getByRole("button", { name: "Add foam" }).click();
    await page.getByRole("button", { name: "Add a material" }).click();
    await studio.until(() => /\[material\]\nname = "pla"/.test(window.__studio.state.text));
    assert.match((await studio.state()).text, /\[foam\]\n/);
    await page.getByRole("button", { name: "Add a load on top, held at the bottom" }).click();
    await studio.until(() => /\[optimize\]/.test(window.__studio.state.text));
    const { text } = await studio.state();
    assert.match(text, /\[\[load\]\]\nface = "\+z"\nforce = /);
    assert.match(text, /\[\[anchor\]\]\nface = "-z"/);
    await page.getByText("This part has to be optimised first.").waitFor();
    await studio.close();
});

test("the server's refusal is shown where it was asked", async () => {
    const graded = foam.replace("cell = 4", 'cell = "4 + 0.05 * z"');
    const studio = await open_studio(browser, { recipe: graded });
    const { page } = studio;
    await open_panel(page);
    await page.getByRole("button", { name: "Homogenise" }).click();
    await page.getByRole("alert").filter({ hasText: "a sample stands for one place" }).waitFor();
    await studio.close();
});

/** Red, green and blue of the middle of the view, as it is drawn. */
async function middle_of_view(page) {
    const shot = (await page.locator(".view-frame").screenshot()).toString("base64");
    return page.evaluate(async (text) => {
        const bytes = Uint8Array.from(atob(text), (one) => one.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(bitmap.width / 2 - 40, bitmap.height / 2 - 40, 80, 80);
        const sum = [0, 0, 0];
        data.forEach((value, i) => {
            if (i % 4 < 3) sum[i % 4] += value / 6400;
        });
        return sum;
    }, shot);
}

test("the part is painted by modulus, with a legend", async () => {
    const solid = foam.replace("beam = 0.6", "beam = 3"); // full of material
    const studio = await open_studio(browser, { recipe: solid });
    const { page } = studio;
    await page.waitForTimeout(1500);
    const plain = await middle_of_view(page);
    assert.ok(Math.max(...plain) - Math.min(...plain) < 30, `grey: ${plain}`);
    assert.equal(await page.locator(".paint-legend").count(), 0);
    await page.getByRole("radio", { name: "modulus" }).click();
    await studio.until(() => window.__studio.state.paint);
    await page.waitForTimeout(1500);
    const [red, green, blue] = await middle_of_view(page);
    assert.ok(blue > green + 25 && green > red + 5, `the lower part of the scale is blue: ${[red, green, blue]}`);
    assert.equal(await page.locator(".paint-ends").innerText().then((text) => text.replace(/\s+/g, " ")), "25 50 100 MPa");
    assert.equal(await page.getByText("softer than asked").count(), 0);
    assert.deepEqual(await violations(page), []);
    await page.getByRole("radio", { name: "plain" }).click();
    await page.waitForTimeout(1500);
    const again = await middle_of_view(page);
    assert.ok(Math.max(...again) - Math.min(...again) < 30, `grey again: ${again}`);
    await page.fill("#field-foam-0-cell", "5");
    await page.getByRole("radio", { name: "modulus" }).click();
    await studio.until(() => window.__studio.state.paint);
    assert.deepEqual(studio.errors, []);
    await studio.close();
});

test("foam that is not as asked has colours of its own; foam of unknown modulus has none", async () => {
    const studio = await open_studio(browser, { recipe: `${foam}modulus = 100\n` });
    await studio.page.getByRole("radio", { name: "modulus" }).click();
    await studio.page.getByText("softer than asked").waitFor();
    await studio.page.getByText("stiffer than asked").waitFor();
    await studio.close();
    const unknown = await open_studio(browser, { recipe: foam.replace('[material]\nname = "pla"\n', "") });
    assert.equal(await unknown.page.getByText("Paint", { exact: true }).count(), 0);
    await unknown.close();
});
