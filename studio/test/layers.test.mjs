// View and layers: what is drawn, zoomed, clicked, checked and made.
import assert from "node:assert/strict";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { open_browser, open_studio } from "./studio.mjs";

let browser, studio;
before(async () => {
    browser = await open_browser();
});
after(() => browser.close());
beforeEach(async () => {
    studio = await open_studio(browser, { width: 1240, height: 860 });
});
afterEach(async () => {
    assert.deepEqual(studio.errors, []);
    await studio.close();
});

const middle_of = async (selector) => {
    const box = await studio.page.locator(selector).boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
};

/** Share of a picture's pixels that differ from the one in its corner. */
async function drawn_share(selector) {
    const shot = await studio.page.locator(selector).screenshot();
    return studio.page.evaluate(async (base64) => {
        const bytes = Uint8Array.from(atob(base64), (one) => one.charCodeAt(0));
        const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
        const context = canvas.getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        let other = 0;
        for (let i = 0; i < data.length; i += 4) {
            const far =
                Math.abs(data[i] - data[0]) +
                Math.abs(data[i + 1] - data[1]) +
                Math.abs(data[i + 2] - data[2]);
            if (far > 90) ++other;
        }
        return other / (data.length / 4);
    }, shot.toString("base64"));
}

test("the view draws the part, coarsely and then finely", async () => {
    assert.ok((await drawn_share(".view")) > 0.05);
    await studio.until(() => window.__studio.state.voxels > 64);
    assert.ok((await drawn_share(".view")) > 0.05);
});

test("turning the part stays smooth", async (context) => {
    const { page } = studio;
    await studio.until(() => window.__studio.state.voxels > 64);
    const [x, y] = await middle_of(".view-frame");
    let best = 0;
    for (let round = 0; round < 3 && best < 10; ++round) {
        await page.mouse.move(x, y);
        await page.mouse.down();
        for (let i = 0; i < 150; ++i) {
            // Not awaited: hands move on while the page draws.
            void page.mouse.move(x + 90 * Math.sin(i / 12), y + 20 * Math.cos(i / 12)).catch(() => {});
            await page.waitForTimeout(16);
        }
        best = Math.max(best, await page.evaluate(() => window.__studio.fps));
        await page.mouse.up();
    }
    context.diagnostic(`${best.toFixed(1)} frames a second`);
    assert.ok(best >= 5, `${best} frames a second`); // 10 and more where the machine does nothing else
});

test("a click on the part goes to its layer", async () => {
    const { page } = studio;
    const { layer } = await studio.state();
    const [x, y] = await middle_of(".view-frame");
    await page.mouse.click(x, y - 60);
    await studio.until((old) => window.__studio.state.layer !== old, layer);
    await studio.until(() => window.__studio.state.shown.layer === window.__studio.state.layer);
});

test("the cut takes a part of the picture away", async () => {
    const { page } = studio;
    await studio.until(() => window.__studio.state.voxels > 64);
    await page.waitForTimeout(1500);
    const whole = await page.locator(".view").screenshot();
    await page.getByRole("radio", { name: "z", exact: true }).click();
    await page.getByRole("slider", { name: "Place of the cut" }).fill("0.3");
    await page.waitForTimeout(1500);
    assert.notDeepEqual(await page.locator(".view").screenshot(), whole);
});

test("the scrubber obeys keys and the wheel, Shift is fine", async () => {
    const { page } = studio;
    const scrubber = page.getByRole("slider", { name: "Layer", exact: true });
    const { layers } = await studio.state();
    await scrubber.focus();
    await scrubber.press("Home");
    assert.equal((await studio.state()).layer, 0);
    await scrubber.press("ArrowUp");
    await scrubber.press("ArrowUp");
    assert.equal((await studio.state()).layer, 2);
    await scrubber.hover();
    await page.mouse.wheel(0, -100);
    await studio.until((wanted) => window.__studio.state.layer === wanted, 2 + Math.round(layers / 100));
    await page.keyboard.down("Shift");
    await page.mouse.wheel(0, -100);
    await page.keyboard.up("Shift");
    await studio.until((wanted) => window.__studio.state.layer === wanted, 3 + Math.round(layers / 100));
    await scrubber.press("End");
    assert.equal((await studio.state()).layer, layers - 1);
    await studio.until(() => window.__studio.state.shown.layer === window.__studio.state.layer);
});

test("the picture of the layer zooms to the pixels of the machine", async () => {
    const { page } = studio;
    assert.equal((await studio.state()).shown.exact, false);
    const [x, y] = await middle_of(".layer-room");
    await page.mouse.move(x, y);
    for (let i = 0; i < 12; ++i) await page.mouse.wheel(0, -200);
    await studio.until(() => window.__studio.state.shown.exact);
    assert.ok((await drawn_share(".layer-room")) > 0.01);
});

test("the check lists faults, a click goes to the layer", async () => {
    const { page } = studio;
    await page.keyboard.press("Alt+2");
    await page.getByRole("button", { name: "Check", exact: true }).click();
    await page.waitForSelector(".fault");
    assert.equal((await studio.state()).faults, 4);
    assert.equal(await page.locator(".check-card").first().getAttribute("class"), "check-card fail");
    await page.locator(".fault").first().click();
    const label = await page.locator(".fault").first().textContent();
    assert.ok(label.includes(`layer ${(await studio.state()).layer + 1}`));
    assert.equal(await page.locator(".scrubber-mark").count(), 4);
    assert.equal(await page.locator(".fault-marker").count(), 4);
});

test("an output is made, and can be downloaded and cancelled", async () => {
    const { page } = studio;
    await page.getByRole("tab", { name: "Make" }).click();
    await page.getByRole("button", { name: /^Make \d+ layers$/ }).click();
    const link = page.getByRole("link", { name: "Download" });
    await link.waitFor();
    const [download] = await Promise.all([page.waitForEvent("download"), link.click()]);
    assert.equal(download.suggestedFilename(), "sphere.sl1");
    await page.getByRole("button", { name: /^Make \d+ layers$/ }).click();
    await page.getByRole("button", { name: "Cancel sphere.sl1" }).click();
    await studio.until(() => document.querySelectorAll(".output").length === 1);
});
