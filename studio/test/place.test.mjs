// What is put, moved and removed at places of the part, in the view and in the layer, is in the recipe.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { models, Program, skip } from "./program.mjs";
import { open_browser } from "./studio.mjs";

const turned_box = `[part]
shape = "box"
size = [30, 20, 16]
turn = [0, 0, 90]
[foam]
cell = 3
beam = 0.4
[skin]
thickness = 0.8
[layers]
height = 0.2
[support]
kind = "bridges"
[printer]
profile = "marlin"
`;

let browser, program, page;

before(async () => {
    if (!skip) browser = await open_browser();
});
after(() => browser?.close());
beforeEach(() => {
    program = new Program();
    program.write("part.toml", turned_box);
});
afterEach(async () => assert.deepEqual(await program.close(), []));

async function open() {
    page = await program.open(browser, "part.toml");
    await program.shown();
    await program.until(() => window.__studio.state.voxels > 0);
}

async function middle_of(selector) {
    const { x, y, width, height } = await page.locator(selector).first().boundingBox();
    return [x + width / 2, y + height / 2];
}

async function drag(from, to) {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 4 });
    await page.mouse.move(...to, { steps: 4 });
    await page.mouse.up();
}

const points_in = (text) => text.match(/points = \[\[(.*)\]\]/)[1].split("], [").map((one) => one.split(",").map(Number));

test("a right click on the part offers finer cells, which are then dragged, moved and removed", { skip }, async () => {
    await open();
    await page.mouse.click(...(await middle_of(".view-frame")), { button: "right" });
    await page.getByRole("menuitem", { name: "Finer cells here" }).click();
    const put = await program.text_with(/kind = "attractors"/);
    assert.match(put, /^cell = "attractors_1"$/m);
    const [first] = points_in(put);
    // on the surface of the box as it was designed, before it is turned
    const off = [15, 10, 8].map((half, k) => half - Math.abs(first[k]));
    assert.ok(Math.min(...off.map(Math.abs)) < 0.6 && Math.min(...off) > -0.6, `${first}`);

    const at = await middle_of(".view .mark button");
    await drag(at, [at[0] + 50, at[1]]);
    await program.until((old) => !window.__studio.state.text.includes(old), `points = [[${first.join(", ")}]]`);
    await program.shown();
    const [second] = points_in((await program.state()).text);
    assert.ok(Math.hypot(...second.map((one, k) => one - first[k])) > 1);

    const mark = page.locator(".view .mark button").first();
    await mark.focus();
    await mark.press("PageUp");
    await program.text_with(new RegExp(`points = .*, ${(second[2] + 1).toFixed(2).replace(/\.?0+$/, "")}\\d*\\]\\]`));
    await mark.press("Delete");
    const last = await program.text_with(/^((?!attractors)[^])*$/);
    assert.match(last, /^cell = 3$/m);
    await page.keyboard.press("Control+z");
    await program.text_with(/attractors/);
});

test("no supports where the next click says", { skip }, async () => {
    await open();
    await page.getByRole("button", { name: "Put…" }).click();
    await page.waitForFunction(() => document.activeElement.getAttribute("role") === "menuitem");
    await page.keyboard.press("Escape");
    assert.equal(await page.locator(".place-menu").count(), 0);
    await page.getByRole("button", { name: "Put…" }).click();
    await page.getByRole("menuitem", { name: "No supports here" }).click();
    await page.mouse.click(...(await middle_of(".view-frame")));
    await program.text_with(/make = "blocker"/);
    await page.locator(".handle-card").getByRole("button", { name: "remove", exact: true }).click();
    const text = await program.text_with(/^((?!blocker)[^])*$/);
    assert.ok(!text.includes("[[field]]"));
});

/** Moves the pointer to the middle of the layer's picture until the page says that the place is (x, y), mm. */
async function pointed_at(x, y) {
    for (let i = 0; i < 100; ++i) {
        const at = await middle_of(".layer-room");
        await page.mouse.move(at[0] + (i % 2), at[1]);
        await page.waitForTimeout(100);
        const told = await page.locator(".numbers div", { hasText: /^at/ }).locator("dd").textContent();
        const [px, py] = told.split(",").map(Number);
        if (Math.hypot(px - x, py - y) < 0.3) return at;
    }
    throw new Error(`the middle never was at ${x}, ${y}`);
}

test("in the layer a ball is made empty, and pixels become dark", { skip }, async () => {
    await open();
    await page.getByRole("radio", { name: "contours" }).click();
    const area = () => page.locator(".numbers div", { hasText: "area" }).locator("dd").textContent();
    await page.locator(".legend").waitFor({ state: "detached" }); // of the paths: the picture is larger without
    const before = Number.parseFloat(await area());
    const middle = await pointed_at(0, 0);
    await page.mouse.click(...middle, { button: "right" });
    await page.getByRole("menuitem", { name: "Empty ball" }).click();
    const text = await program.text_with(/make = "empty"/);
    const at = text.match(/at = \[(.*)\]/)[1].split(",").map(Number);
    assert.ok(Math.abs(at[0]) < 0.5 && Math.abs(at[1]) < 0.5, `${at}`);
    await page.waitForFunction(
        (old) => Number.parseFloat(document.querySelectorAll(".numbers dd")[2].textContent) < old,
        before,
    );
});

test("what cannot be put now says why", { skip }, async () => {
    program.write("part.toml", turned_box.replace(/\[skin\]\nthickness = 0.8\n/, "").replace("cell = 3", 'cell = "3 + 0.1*z"'));
    await open();
    await page.getByRole("button", { name: "Put…" }).click();
    const hole = page.getByRole("menuitem", { name: /Hole through the skin/ });
    assert.equal(await hole.getAttribute("aria-disabled"), "true");
    assert.match(await hole.textContent(), /no skin/);
    assert.match(await page.getByRole("menuitem", { name: /Finer cells here/ }).textContent(), /formula already/);
});

test("the rows of a table are a curve that is dragged, drawn and moved by keys", { skip }, async () => {
    program.write(
        "part.toml",
        turned_box.replace("cell = 3", 'cell = "profile"') +
            '[[grading]]\nname = "profile"\nkind = "table"\nalong = "x"\nrows = [[-15, 2], [0, 4], [15, 2]]\n',
    );
    await open();
    const knot = page.locator(".rows-curve circle").nth(1);
    await knot.scrollIntoViewIfNeeded();
    await knot.focus();
    await knot.press("ArrowDown");
    const moved = Number((await program.text_with(/rows = \[\[-15, 2\], \[0, 3\.\d+\], \[15, 2\]\]/)).match(/\[0, (3\.\d+)\]/)[1]);
    assert.ok(moved < 4 && moved > 3.5);
    await knot.press("Insert");
    await program.text_with(/rows = \[\[-15, 2\], \[0, [\d.]+\], \[7\.5, [\d.]+\], \[15, 2\]\]/);
    const box = await page.locator(".rows-curve").boundingBox();
    await page.mouse.move(box.x + 50, box.y + 30);
    await page.mouse.down();
    for (let i = 1; i <= 30; ++i) await page.mouse.move(box.x + 50 + 7 * i, box.y + 30 + 2 * i);
    await page.mouse.up();
    const drawn = (await program.text_with(/rows = /)).match(/rows = \[\[(.*)\]\]/)[1].split("], [");
    assert.ok(drawn.length <= 4, `a straight stroke needs few knots: ${drawn}`);
});

test("a picture that is dropped becomes a pattern of the skin", { skip: skip || !models }, async () => {
    await open();
    const picture = readFileSync(join(models, "../inputs/net.png"));
    const transfer = await page.evaluateHandle((data) => {
        const files = new DataTransfer();
        files.items.add(new File([new Uint8Array(data)], "net.png"));
        return files;
    }, [...picture]);
    await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
    await page.getByRole("button", { name: /A pattern like it/ }).click();
    const text = await program.text_with(/pattern = "by-example"/);
    assert.match(text, /^image = "net\.png"$/m);
    assert.ok(readFileSync(join(program.folder, "net.png")).equals(picture));
    assert.deepEqual((await program.state()).mistakes, []);
});

test("faults are red on the part", { skip }, async () => {
    program.write("part.toml", turned_box.replace(/\[skin\]\nthickness = 0.8\n/, "").replace("beam = 0.4", "beam = 0.15"));
    await open();
    await page.waitForTimeout(1500);
    const red = async () => {
        const picture = (await page.locator(".view-frame canvas").screenshot()).toString("base64");
        return page.evaluate(async (text) => {
            const bytes = Uint8Array.from(atob(text), (one) => one.charCodeAt(0));
            const bitmap = await createImageBitmap(new Blob([bytes]));
            const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
            context.drawImage(bitmap, 0, 0);
            const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
            let count = 0;
            for (let i = 0; i < data.length; i += 4) if (data[i] > 130 && data[i + 1] < 90 && data[i + 2] < 90) ++count;
            return count;
        }, picture);
    };
    const before = await red();
    await page.keyboard.press("Alt+2");
    await page.getByRole("button", { name: "Check", exact: true }).click();
    await page.waitForSelector(".fault");
    await page.evaluate(() => {
        for (const one of document.querySelectorAll(".fault-markers")) one.style.setProperty("display", "none");
    });
    await page.waitForTimeout(2500);
    assert.ok((await red()) > before + 20);
});
