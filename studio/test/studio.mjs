// Opens the page in Chromium against the mock, for the tests.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { chromium } from "playwright-core";
import { make_mock } from "../mock/server.mjs";

const axe_source = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const flags = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
/** Slow machines draw without a graphics card while other work runs. */
export const patience = 60000;

/** Serious faults of accessibility on the page as it is. */
export async function violations(page) {
    await page.evaluate(axe_source); // evaluated by the test, not by the page: its policy stays as it is
    const found = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    return found.violations
        .filter((one) => one.impact === "serious" || one.impact === "critical")
        .map((one) => `${one.id}: ${one.nodes.map((node) => node.target.join(" ")).join(", ")}`);
}

export async function open_browser(extra = []) {
    return chromium.launch({
        executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
        args: [...flags, ...extra],
    });
}

export function start_server(mock, port = 0) {
    return new Promise((resolve) =>
        mock.server.listen(port, "127.0.0.1", () => resolve(mock.server.address().port)),
    );
}

export function stop_server(mock) {
    mock.server.closeAllConnections();
    return new Promise((resolve) => mock.server.close(resolve));
}

/** Opens the page. Errors of the page and refusals by its policy are collected in `errors`. */
export async function open_studio(
    browser,
    { recipe, scheme = "light", width = 1280, height = 800, wait = true } = {},
) {
    const mock = make_mock({ token: "secret", finest: 96, ...(recipe === undefined ? {} : { recipe }) });
    const port = await start_server(mock);
    const page = await browser.newPage({ viewport: { width, height }, colorScheme: scheme });
    page.setDefaultTimeout(patience);
    const errors = [];
    page.on("pageerror", (error) => errors.push(error.stack ?? error.message));
    page.on("console", (message) => {
        if (/Content Security Policy|Refused to/.test(message.text())) errors.push(message.text());
    });
    await page.goto(`http://127.0.0.1:${port}/?token=secret`);
    const studio = {
        mock,
        port,
        page,
        errors,
        state: () => page.evaluate(() => window.__studio.state),
        until: (what, argument) => page.waitForFunction(what, argument, { timeout: patience }),
        close: async () => {
            await page.close();
            await stop_server(mock);
        },
    };
    if (wait) {
        await studio.until(() => {
            const { job, shown, voxels } = window.__studio?.state ?? {};
            return job && shown?.job === job && voxels > 0;
        });
    }
    return studio;
}

/** A binary STL of a box, mm. */
export function box_stl(x, y, z) {
    const corner = (i) => [i & 1 ? x : 0, i & 2 ? y : 0, i & 4 ? z : 0];
    const faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    const bytes = Buffer.alloc(84 + 50 * faces.length);
    bytes.writeUInt32LE(faces.length, 80);
    faces.forEach((face, k) =>
        face.forEach((i, v) =>
            corner(i).forEach((one, c) => bytes.writeFloatLE(one, 84 + 50 * k + 12 + 12 * v + 4 * c)),
        ),
    );
    return bytes;
}
