// The page as a whole: accessibility, an absent server, a browser without WebGL2, a wrong token.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { make_mock } from "../mock/server.mjs";
import { open_browser, open_studio, start_server, stop_server, violations } from "./studio.mjs";

let browser;
before(async () => {
    browser = await open_browser();
});
after(() => browser.close());

for (const scheme of ["light", "dark"]) {
    test(`no serious faults of accessibility, ${scheme}`, async () => {
        const studio = await open_studio(browser, { scheme });
        const { page } = studio;
        assert.equal(await page.getAttribute("html", "data-theme"), scheme);
        assert.deepEqual(await violations(page), [], "form");
        await page.getByRole("checkbox", { name: "all keys" }).check();
        await page.fill("#field-foam-0-beam", "9000");
        await page.locator("#field-foam-0-beam-wrong").waitFor();
        assert.deepEqual(await violations(page), [], "all keys and a mistake");
        await page.getByRole("radio", { name: "Recipe text" }).click();
        await page.waitForSelector(".cm-content");
        assert.deepEqual(await violations(page), [], "text");
        await page.getByRole("tab", { name: "Check" }).click();
        await page.getByRole("button", { name: "Check", exact: true }).click();
        await page.locator(".fault").first().click();
        assert.deepEqual(await violations(page), [], "check");
        await page.getByRole("tab", { name: "Make" }).click();
        await page.getByRole("button", { name: /^Make \d+ layers$/ }).click();
        await page.getByRole("link", { name: "Download" }).waitFor();
        assert.deepEqual(await violations(page), [], "make");
        await page.getByRole("button", { name: "New" }).click();
        await page.waitForSelector(".gallery");
        assert.deepEqual(await violations(page), [], "start");
        assert.deepEqual(studio.errors, []);
        await studio.close();
    });
}

test("the theme can be changed and is kept", async () => {
    const studio = await open_studio(browser);
    const { page } = studio;
    await page.getByRole("button", { name: "Dark colours" }).click();
    assert.equal(await page.getAttribute("html", "data-theme"), "dark");
    await page.reload();
    await page.getByRole("button", { name: "Light colours" }).waitFor();
    assert.equal(await page.getAttribute("html", "data-theme"), "dark");
    await studio.close();
});

test("the whole page can be reached by the keyboard", async () => {
    const studio = await open_studio(browser);
    const { page } = studio;
    const seen = new Set();
    for (let i = 0; i < 90; ++i) {
        await page.keyboard.press("Tab");
        seen.add(
            await page.evaluate(() => {
                const at = document.activeElement;
                return at?.getAttribute("aria-label")?.split(".")[0] ?? at?.id ?? "";
            }),
        );
    }
    const wanted = [
        "tab-design",
        "field-foam-0-cell",
        "cell, slider",
        "3D view",
        "Layer",
        "Picture of layer 201",
    ];
    for (const name of wanted) assert.ok(seen.has(name), `${name} in ${[...seen].join("; ")}`);
    await page.locator(".view-frame").focus();
    const shot = await page.locator(".view-frame").screenshot();
    for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowRight");
    await page.waitForTimeout(800);
    assert.notDeepEqual(await page.locator(".view-frame").screenshot(), shot);
    await studio.close();
});

test("the page waits for a server that is away, and posts its recipe again", async () => {
    const studio = await open_studio(browser);
    const { page } = studio;
    const { job } = await studio.state();
    await stop_server(studio.mock);
    await page.getByText("The server is away").waitFor();
    await page.fill("#field-part-0-radius", "14"); // asked for while nobody answers
    const anew = make_mock({ token: "secret" });
    await start_server(anew, studio.port);
    await page.getByText("The server is away").waitFor({ state: "detached" });
    await studio.until(() => !window.__studio.state.building && window.__studio.state.job);
    assert.ok(anew.state.jobs.size >= 1);
    assert.equal(anew.state.jobs.has((await studio.state()).job), true);
    await page.fill("#field-part-0-radius", "15");
    await studio.until((old) => window.__studio.state.job !== old, job);
    assert.deepEqual(studio.errors, []);
    await page.close();
    await stop_server(anew);
});

test("a wrong token is said clearly", async () => {
    const studio = await open_studio(browser);
    const page = await browser.newPage();
    await page.goto(`http://127.0.0.1:${studio.port}/?token=wrong`);
    await page.getByText("refused the token").waitFor();
    await page.close();
    await studio.close();
});

test("without WebGL2 the server draws the part", async () => {
    const plain = await open_browser(["--disable-3d-apis"]);
    const studio = await open_studio(plain, { wait: false });
    await studio.page.waitForSelector(".view-picture");
    await studio.until(() => document.querySelector(".view-picture").naturalWidth === 640);
    assert.deepEqual(studio.errors, []);
    await studio.close();
    await plain.close();
});

for (const [width, height] of [
    [820, 1180],
    [390, 844],
]) {
    test(`nothing runs over the edge at ${width} px`, async () => {
        const studio = await open_studio(browser, { width, height });
        assert.equal(await studio.page.evaluate(() => document.documentElement.scrollWidth), width);
        await studio.close();
    });
}
