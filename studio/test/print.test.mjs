// Print: from the choice of a port to the end, against the mock; and by the program to a machine on a pseudo-terminal.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { start_machine } from "./machine.mjs";
import { start_program } from "./program.mjs";
import { open_browser, open_studio, patience } from "./studio.mjs";
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

/** Opens the tab by its key and starts a print at the second port. */
async function open_print(options = {}) {
    const studio = await open_studio(browser, { recipe: marlin_ball, ...options });
    await studio.page.keyboard.press("Alt+5");
    return studio;
}

async function start_print(studio) {
    await studio.page.getByLabel("Port").selectOption({ label: "ttyUSB0 · 1a86 USB Serial" });
    await studio.page.getByLabel("Baud").selectOption("115200");
    await studio.page.getByRole("button", { name: /^Print \d+ layers$/ }).click();
    await studio.until(() => window.__studio.state.print?.layer >= 1);
}

test("a print is started, told, paused, stopped and resumed", async () => {
    const studio = await open_print();
    const { page } = studio;
    await start_print(studio);
    const { print } = await studio.state();
    assert.deepEqual(print.to, { serial: "/dev/serial/by-id/usb-1a86_USB_Serial-if00-port0", baud: 115200 });
    await page.getByText(/^Layer \d+ of 30, computed \d+ of 30 · \d+ min left$/).waitFor();
    await page.getByText("210 of 210 °C").waitFor();
    await page.locator(".temperature-plot canvas").waitFor();
    await page.getByRole("log").getByText("the printer is Mock 1.0").waitFor();
    await page.getByRole("tab", { name: "Design" }).click();
    await page.getByRole("button", { name: /^printing layer \d+ of 30$/ }).click();
    await page.getByRole("button", { name: "Pause" }).click();
    await page.getByRole("status").getByText("Paused").waitFor();
    const { layer } = (await studio.state()).print;
    await page.waitForTimeout(600);
    assert.equal((await studio.state()).print.layer, layer);
    await page.getByRole("button", { name: "Resume" }).click();
    await studio.until((old) => window.__studio.state.print.layer > old, layer);
    await page.getByRole("button", { name: "Stop…" }).click();
    await page.getByRole("button", { name: "Go on" }).click();
    assert.equal((await studio.state()).print.state, "printing");
    await page.getByRole("button", { name: "Stop…" }).click();
    await page.getByRole("button", { name: "Stop the print" }).click();
    await page.getByRole("status").getByText("Stopped").waitFor();
    await page.getByText(/was stopped before layer \d+/).waitFor();
    await page.getByRole("button", { name: "Resume the print" }).click();
    await page.getByRole("status").getByText("Done").waitFor();
    await page.getByRole("button", { name: /^Print 30 layers$/ }).waitFor();
    assert.equal((await studio.state()).print.print, 2);
    assert.deepEqual(studio.errors, []);
    await studio.close();
});

test("a page that is loaded anew, and one that comes later, see the print", async () => {
    const studio = await open_print();
    const { page } = studio;
    await start_print(studio);
    await page.reload();
    await studio.until(() => window.__studio?.state.print?.layer >= 2);
    assert.match((await studio.state()).print_messages[0], /^waiting for the printer at/);
    await page.getByRole("tab", { name: "Print" }).click();
    await page.getByRole("button", { name: "Pause" }).waitFor();
    await page.getByRole("checkbox", { name: "show the layer that is printed" }).check();
    await studio.until(() => {
        const { print, layer } = window.__studio.state;
        return print.layer > 5 && layer === print.layer;
    });
    await studio.close();
});

test("a halt needs one click, a failure is told, a question is answered", async () => {
    const studio = await open_print();
    const { page, mock } = studio;
    await start_print(studio);
    mock.printer.ask("Nozzle Parked", ["Continue"]);
    await page.getByRole("alert").getByText("Nozzle Parked").waitFor();
    await page.getByRole("button", { name: "Continue" }).click();
    await page.getByRole("alert").waitFor({ state: "detached" });
    await page.getByRole("button", { name: "Halt" }).click();
    await page.locator(".print-card").getByText("halted at once (M112)").waitFor();
    await page.getByRole("button", { name: "Print from the start" }).click();
    await studio.until(() => window.__studio.state.print.state === "printing");
    mock.printer.fail("the printer has stopped: Thermal Runaway");
    await page.locator(".print-card .wrong").getByText("Thermal Runaway").waitFor();
    await studio.close();
});

test("what cannot be printed says what to choose", async () => {
    const studio = await open_print({ recipe: marlin_ball.replace("marlin", "prusa-sl1s") });
    const { page } = studio;
    await page.getByText("prusa-sl1s does not use G-code").waitFor();
    assert.equal(await page.getByRole("button", { name: /^Print/ }).count(), 0);
    await page.getByLabel("Machine").selectOption("marlin");
    await page.getByRole("button", { name: /^Print \d+ layers$/ }).waitFor();
    await page.getByLabel("Port").selectOption("another path");
    await page.getByLabel("Path", { exact: true }).fill("/dev/ttyNone");
    await page.getByRole("button", { name: /^Print \d+ layers$/ }).click();
    await page.getByRole("alert").getByText("there is no port /dev/ttyNone").waitFor();
    await page.getByText("More", { exact: true }).click();
    await page.getByLabel("Park at").fill("3");
    assert.equal(await page.getByRole("button", { name: /^Print \d+ layers$/ }).isDisabled(), true);
    await page.getByLabel("Park at").fill("3, 200");
    assert.equal(await page.getByRole("button", { name: /^Print \d+ layers$/ }).isDisabled(), false);
    await studio.close();
});

for (const scheme of ["light", "dark"]) {
    test(`no serious faults of accessibility while it prints, ${scheme}`, async () => {
        const studio = await open_print({ scheme });
        const { page } = studio;
        await page.getByText("More", { exact: true }).click();
        assert.deepEqual(await violations(page), [], "form");
        await start_print(studio);
        studio.mock.printer.ask("Nozzle Parked", ["Continue", "Purge more"]);
        await page.getByRole("button", { name: "Purge more" }).waitFor();
        assert.deepEqual(await violations(page), [], "printing");
        studio.mock.printer.fail("the printer has stopped");
        await page.locator(".print-card .wrong").waitFor();
        assert.deepEqual(await violations(page), [], "failed");
        await studio.close();
    });
}

const skip = process.env.LAMELLA ? false : "LAMELLA is not set";

test("the program prints to a machine, and stops it when it ends", { skip }, async (context) => {
    const folder = mkdtempSync(join(tmpdir(), "studio-"));
    writeFileSync(join(folder, "part.toml"), marlin_ball);
    const machine = await start_machine();
    context.after(() => machine.end());
    const program = await start_program(folder, [join(folder, "part.toml")]);
    context.after(async () => {
        if (program.runs()) await program.end("SIGKILL");
        rmSync(folder, { recursive: true });
    });
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    context.after(() => page.close());
    page.setDefaultTimeout(patience);
    const until = (what) => page.waitForFunction(what, undefined, { timeout: patience });
    const print = async () => {
        await page.getByRole("button", { name: /^Print \d+ layers$/ }).click();
        await until(() => {
            const { print } = window.__studio.state;
            return print?.state === "printing" && print.layer >= 1;
        });
    };
    await page.goto(program.address);
    await until(() => window.__studio?.state.job);
    await page.keyboard.press("Alt+5");
    await page.getByLabel("Port").selectOption("another path");
    await page.getByLabel("Path", { exact: true }).fill(machine.port);
    await print();
    await page.getByRole("log").getByText("the printer is Marlin").waitFor();
    await until(() => window.__studio.state.print.state === "done");
    assert.ok(machine.lines().includes("G28"));
    assert.ok(machine.lines().filter((line) => /^G1 .*E/.test(line)).length > 100);
    assert.equal(machine.lines().at(-1), "M73 P100 R0");
    await print();
    await program.end();
    assert.equal(machine.lines().at(-1), "M84");
    assert.ok(machine.lines().lastIndexOf("M104 S0") > machine.lines().lastIndexOf("M109 S210"));
    assert.ok(existsSync(join(folder, "sphere.print.journal")));
});
