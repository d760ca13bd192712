// Printers on the network: chosen, sent to, watched, and what is wrong with them; against the mock.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { open_browser, open_studio } from "./studio.mjs";
import { violations } from "./violations.mjs";

const marlin_ball = `[part]
shape = "sphere"
radius = 3
[layers]
height = 0.2
[printer]
profile = "marlin"
`;

let browser;
before(async () => {
    browser = await open_browser();
});
after(() => browser.close());

async function open_print(options = {}) {
    const studio = await open_studio(browser, { recipe: marlin_ball, ...options });
    await studio.page.keyboard.press("Alt+5");
    return studio;
}

test("a job is sent to a printer on the network, watched, paused and cancelled", async () => {
    const studio = await open_print();
    const { page } = studio;
    await page.getByRole("heading", { name: "On the network" }).waitFor();
    await page.getByText("Moonraker v0.9 · voron · 12,300 MB free · not encrypted").waitFor();
    await page.getByRole("button", { name: "Send and print" }).click();
    await page.getByText(/^\d\.\d MB, layer \d+ of 30$/).waitFor();
    await page.getByText("voron prints part-1a2b3c4d.gcode").waitFor();
    await page.getByText(/^25 % · layer 20 of 80 · 1 h 30 min left · nozzle 215 of 215 °C/).waitFor();
    await page.getByRole("button", { name: "Pause", exact: true }).click();
    await page.getByRole("button", { name: "Resume", exact: true }).click();
    assert.deepEqual(await violations(page), []);
    await page.getByRole("button", { name: "Cancel the print" }).click();
    await page.locator(".print-head").getByText("cancelled").waitFor();

    await page.getByLabel("print it once it is there").uncheck();
    await page.getByRole("button", { name: "Send", exact: true }).click();
    await page.getByRole("button", { name: "Stop sending" }).click();
    await page.getByText("Sending to voron was stopped").waitFor();
    assert.deepEqual(studio.errors, []);
    await studio.close();
});

test("a printer that does not answer is told beside it, and nothing is sent; dark", async () => {
    const studio = await open_print({ scheme: "dark" });
    const { page } = studio;
    await page.getByLabel("Printer", { exact: true }).selectOption({ label: "saturn · sdcp" });
    await page.getByText("saturn: cannot be reached at http://192.168.1.31: no answer").waitFor();
    assert.ok(await page.getByRole("button", { name: "Send and print" }).isDisabled());
    assert.deepEqual(await violations(page), []);
    await studio.close();
});
