// The recipe: form, text, undo, saving, and models that are dropped.
import assert from "node:assert/strict";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { box_stl, open_browser, open_studio } from "./studio.mjs";

let browser, studio;
before(async () => {
    browser = await open_browser();
});
after(() => browser.close());
beforeEach(async (context) => {
    studio = await open_studio(browser, context.name.startsWith("start:") ? { recipe: "", wait: false } : {});
});
afterEach(async () => {
    assert.deepEqual(studio.errors, []);
    await studio.close();
});

const new_layer = () =>
    studio.until(() => {
        const { job, shown, building } = window.__studio.state;
        return !building && shown?.job === job;
    });

test("the page shows the recipe, and its address no longer shows the token", async () => {
    assert.equal(new URL(studio.page.url()).search, "");
    assert.equal(await studio.page.inputValue("#field-foam-0-cell"), "4");
    await studio.page.reload();
    await studio.page.waitForSelector("#field-foam-0-cell");
});

test("a slider changes the text of the recipe, and a new layer is shown", async () => {
    const before_it = await studio.state();
    const slider = studio.page.getByRole("slider", { name: "cell, slider" });
    await slider.focus();
    for (let i = 0; i < 5; ++i) await slider.press("PageUp");
    await studio.until((old) => window.__studio.state.job !== old, before_it.job);
    await new_layer();
    const state = await studio.state();
    assert.match(state.text, /^cell = (?!4 )[0-9.]+ +# mean diameter of a cell, mm$/m);
    assert.equal(state.shown.job, state.job);
    assert.equal(state.layer, before_it.layer);
});

test("a mistake in a formula is shown at its field and at its line", async () => {
    const { page } = studio;
    await page.getByRole("button", { name: "cell as a formula" }).click();
    await page.fill("#field-foam-0-cell", "3 + q * z");
    const wrong = page.locator("#field-foam-0-cell-wrong");
    await wrong.waitFor();
    assert.match(await wrong.textContent(), /unknown name `q`/);
    assert.equal(await page.getAttribute("#field-foam-0-cell", "aria-invalid"), "true");
    assert.equal(await page.textContent(".status .wrong"), "1 mistake");
    await page.click(".status .wrong");
    await page.waitForSelector(".cm-lint-marker-error");
    await page.getByRole("radio", { name: "Form" }).click();
    await page.fill("#field-foam-0-cell", "3 + 0.1 * z");
    await wrong.waitFor({ state: "detached" });
});

test("a value out of its range is refused in place, the text stays", async () => {
    const { page } = studio;
    const { text } = await studio.state();
    await page.fill("#field-foam-0-beam", "9000");
    await page.locator("#field-foam-0-beam-wrong").waitFor();
    assert.match(await page.textContent("#field-foam-0-beam-wrong"), /too large/);
    assert.equal((await studio.state()).text, text);
    assert.equal(await page.inputValue("#field-foam-0-beam"), "9000");
});

test("undo and redo go over the form and the text", async () => {
    const { page } = studio;
    const { text } = await studio.state();
    await page.selectOption("#field-foam-0-kind", "gyroid");
    await studio.until((old) => window.__studio.state.text !== old, text);
    const by_form = (await studio.state()).text;
    assert.match(by_form, /kind = "gyroid"/);
    assert.match(by_form, /wall = 0.6/);
    assert.doesNotMatch(by_form, /beam/);
    await page.getByRole("radio", { name: "Recipe text" }).click();
    await page.click(".cm-content");
    await page.keyboard.press("Control+End");
    await page.keyboard.type("\n[skin]\nthickness = 1.2\n");
    await studio.until(() => /thickness = 1.2/.test(window.__studio.state.text));
    await page.getByRole("radio", { name: "Form" }).click();
    await studio.until(() => document.querySelector("#field-skin-0-thickness")?.value === "1.2");
    await page.getByRole("button", { name: "Undo" }).click();
    await page.getByRole("button", { name: "Undo" }).click();
    await studio.until((old) => window.__studio.state.text === old, text);
    await page.getByRole("button", { name: "Redo" }).click();
    await studio.until((next) => window.__studio.state.text === next, by_form);
});

test("sections and entries of lists are added and removed", async () => {
    const { page } = studio;
    await page.getByRole("button", { name: "Add skin" }).click();
    await studio.until(() => /\[skin\]\nthickness = 0.8/.test(window.__studio.state.text));
    await page.getByRole("button", { name: "+ field" }).click();
    await page.waitForSelector("#field-field-0-name");
    await page.getByRole("button", { name: "Add another field" }).click();
    await page.waitForSelector("#field-field-1-name");
    assert.equal(await page.inputValue("#field-field-1-name"), "field_2");
    await page.getByRole("button", { name: "Remove field 1" }).click();
    await studio.until(() => (window.__studio.state.text.match(/\[\[field\]\]/g) ?? []).length === 1);
    assert.match((await studio.state()).text, /name = "field_2"/);
    await page.getByRole("button", { name: "Remove skin" }).click();
    await studio.until(() => !window.__studio.state.text.includes("[skin]"));
});

test("the search finds keys that are not shown", async () => {
    const { page } = studio;
    await page.keyboard.press("/");
    await page.keyboard.type("jitter");
    await page.waitForSelector("#field-foam-0-jitter");
    assert.equal(await page.locator(".field").count(), 1);
});

test("Ctrl+S saves the recipe", async () => {
    const { page, mock } = studio;
    await page.fill("#field-part-0-radius", "12");
    await page.keyboard.press("Enter");
    await studio.until(() => /radius = 12/.test(window.__studio.state.text));
    await page.waitForSelector(".unsaved");
    await page.keyboard.press("Control+s");
    await page.waitForSelector(".unsaved", { state: "detached" });
    assert.match(mock.state.text, /radius = 12/);
});

test("start: a model that is dropped becomes a recipe with layers", async () => {
    const { page } = studio;
    await page.waitForSelector(".drop-zone");
    const bytes = [...box_stl(20, 30, 10)];
    const transfer = await page.evaluateHandle((data) => {
        const files = new DataTransfer();
        files.items.add(new File([new Uint8Array(data)], "bracket.stl"));
        return files;
    }, bytes);
    await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
    await new_layer();
    const state = await studio.state();
    assert.match(state.text, /mesh = "bracket.stl"/);
    assert.equal(state.layers, 200);
});

test("start: a file of another kind is refused with one message", async () => {
    const { page } = studio;
    await page.waitForSelector(".drop-zone");
    await page.setInputFiles("input[type=file]", {
        name: "note.txt",
        mimeType: "text/plain",
        buffer: Buffer.from("x"),
    });
    assert.match(await page.textContent(".notice.error"), /not a model/);
});

test("start: an example is opened for the machine that was chosen", async () => {
    const { page } = studio;
    await page.waitForSelector(".gallery");
    await page.selectOption("#start-machine", "marlin");
    await page.getByRole("button", { name: /capsule shell/i }).click();
    await new_layer();
    assert.match((await studio.state()).text, /profile = "marlin"/);
    await page.waitForSelector(".legend");
});
