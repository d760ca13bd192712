// Curves of tables: their arithmetic against brute force.
import assert from "node:assert/strict";
import { test } from "node:test";
import { build } from "esbuild";

const { outputFiles } = await build({ entryPoints: ["src/form/rows.ts"], write: false, format: "esm", bundle: true });
const rows = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);

test("rows are read as they are written, and nothing else is", () => {
    const knots = [[-1.5, 2], [0, 1e-3]];
    assert.deepEqual(rows.knots_of(rows.knots_text(knots)), knots);
    for (const wrong of [undefined, "", "1", "1,2;3", "1,2,3", "a,b", "1,2;x,3"]) assert.equal(rows.knots_of(wrong), null);
});

test("a knot stays between its neighbours", () => {
    const knots = [[0, 1], [5, 2], [10, 3]];
    const span = rows.span_of(knots);
    for (const to of [-100, 0, 3, 10, 100]) {
        const [a, b, c] = rows.moved(knots, 1, [to, 7], span);
        assert.ok(a[0] < b[0] && b[0] < c[0]);
        assert.equal(b[1], 7);
    }
});

test("a drawn curve is kept to a fiftieth of the span, by few knots", () => {
    const knots = [[-10, 1], [0, 3], [10, 1], [30, 2]];
    const span = rows.span_of(knots);
    const wave = (x) => 2 + Math.sin(x / 3);
    const stroke = Array.from({ length: 400 }, (_, i) => [-5 + i / 40, wave(-5 + i / 40)]);
    const made = rows.drawn(knots, stroke, span);
    const tolerance = 0.021 * (span.hi[1] - span.lo[1]);
    for (let x = -4.5; x < 4.5; x += 0.01) {
        assert.ok(Math.abs(rows.value_at(made, x) - wave(x)) < tolerance, `${x}`);
    }
    assert.ok(made.length < 16, `${made.length}`);
    assert.ok(made.every((one, i) => i === 0 || one[0] > made[i - 1][0]));
    assert.deepEqual(made.at(-1), [30, 2]);
    assert.deepEqual(rows.drawn(knots, [...stroke].reverse(), span), made);
});
