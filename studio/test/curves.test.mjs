// Curves over the layers, and the paint by structure: against the mock, and as the program computes them.
import assert from "node:assert/strict";
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

const ball = `[part]
shape = "sphere"
radius = 10
[layers]
height = 0.2
[printer]
profile = "prusa-sl1s"
`;

const summary = (page) => page.locator(".curve-name [role=status]");
const chosen = (page, of) => page.waitForFunction((wanted) => {
    const { curve, job } = window.__studio.state;
    return curve.of === wanted && curve.job === job && curve[wanted === "time" ? "seconds" : "islands"];
}, of);

test("curves of islands and times are chosen by keys, and lead to their layers", async () => {
    studio = await open_studio(browser, { recipe: ball });
    const { page } = studio;
    await page.getByRole("radio", { name: "area" }).focus();
    await page.keyboard.press("ArrowRight");
    await chosen(page, "islands");
    assert.equal(await summary(page).innerText(), "3 pieces begin with nothing below");
    const plot = await page.locator(".curve .u-over").boundingBox();
    await page.mouse.click(plot.x + 0.25 * plot.width, plot.y + plot.height / 2);
    assert.ok(Math.abs((await studio.state()).layer - 25) <= 1);
    await page.getByRole("radio", { name: "time" }).click();
    await chosen(page, "time");
    await page.getByText("of layers: 14 min in all", { exact: true }).waitFor();
    await page.emulateMedia({ colorScheme: "dark" });
    assert.deepEqual(await violations(page), []);
    await page.fill("#field-part-0-radius", "12"); // computed anew for the next job
    const { job } = await studio.state();
    await page.keyboard.press("Enter");
    await studio.until((old) => window.__studio.state.job !== old && window.__studio.state.curve.job !== old, job);
    assert.deepEqual(studio.errors, []);
});

/** Red, green and blue of a place of the view, as shares of its size. */
async function colour_at(page, across, down) {
    const shot = (await page.locator(".view-frame").screenshot()).toString("base64");
    return page.evaluate(async ([text, x, y]) => {
        const bytes = Uint8Array.from(atob(text), (one) => one.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        context.drawImage(bitmap, 0, 0);
        return [...context.getImageData(x * bitmap.width, y * bitmap.height, 1, 1).data.slice(0, 3)];
    }, [shot, across, down]);
}

test("the program's part shows skin, foam and graded cells; its times have a sum", { skip }, async () => {
    program = new Program();
    const foam = "[foam]\ncell = \"3 + 0.05 * z\"\nbeam = 1.4\n[skin]\nthickness = 2\n"; // full of material
    program.write("part.toml", ball.replace("prusa-sl1s", "marlin") + foam);
    const page = await program.open(browser, "part.toml");
    await program.shown();
    await page.getByRole("radio", { name: "structure" }).click();
    await program.until(() => window.__studio.state.paint?.of === "structure" && window.__studio.state.voxels > 64);
    assert.equal((await page.locator(".paint-legend").innerText()).replace(/\s+/g, " ").trim(), "skin foam");
    await page.waitForTimeout(1500);
    const skin = await colour_at(page, 0.5, 0.42);
    assert.ok(Math.max(...skin) - Math.min(...skin) < 30, `grey: ${skin}`);
    await page.getByRole("radio", { name: "y", exact: true }).click();
    await page.waitForTimeout(1500);
    const cut = await colour_at(page, 0.5, 0.5);
    assert.ok(cut[0] > cut[2] + 60, `golden: ${cut}`);
    await page.getByRole("radio", { name: "number" }).click();
    await program.until(() => window.__studio.state.paint?.of === "number");
    assert.equal(await page.getByRole("combobox", { name: "Number that is painted" }).inputValue(), "foam.cell");
    assert.match(await page.locator(".paint-ends").innerText(), /^2\.5\d?\s+3\s+3\.\d+ mm$/);
    assert.deepEqual(await violations(page), []);
    await page.getByRole("radio", { name: "islands" }).click();
    await page.getByText(/pieces? begins? with nothing below$/).waitFor();
    await page.getByRole("radio", { name: "time" }).click();
    await program.until(() => {
        const { curve } = window.__studio.state;
        return curve.seconds && curve.layers_a_value === 1;
    });
    const { curve } = await program.state();
    const minutes = Math.round(curve.seconds.reduce((sum, one) => sum + one, 0) / 60);
    await page.getByText(`${minutes} min in all, without ways between layers`).waitFor();
    await page.getByRole("combobox", { name: "profile" }).selectOption("laser-k40");
    await page.getByText("laser-k40: no time of its layers is known, as of machines for filament and resin").waitFor();
    assert.deepEqual(program.errors, []);
});
