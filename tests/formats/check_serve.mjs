// The section server, asked by the example's client: areas in closed form, masks and runs against contours.
import assert from 'node:assert/strict';
import path from 'node:path';

const { SectionClient } = await import(path.join(process.env.SOURCES, 'examples/javascript/sections.mjs'));

const area = (contours) => contours.reduce((sum, { points }) => sum + points.reduce((part, [x, y], i) => {
  const [u, v] = points[(i + 1) % points.length];
  return part + (x * v - u * y) / 2;
}, 0), 0);

const client = new SectionClient(process.env.LAMELLA);
const ball = await client.ask({ id: 'first', method: 'open', text: '[part]\nshape = "sphere"\nradius = 5\n',
                                set: { 'layers.height': 0.1 } });
assert.equal(ball.id, 'first');
assert.equal(ball.layers, 100);
assert.deepEqual(ball.upper, [5, 5, 5]);
const raster = { columns: 500, rows: 400, x: -6, y: 5, pitch_x: 0.025, pitch_y: -0.025 };
for (const z of [-4.5, 0, 2.2]) {
  const circle = Math.PI * (25 - z * z);
  const contours = await client.contours({ job: ball.job, z, tolerance: 0.01 });
  assert.equal(contours.length, 1);
  assert.equal(contours[0].parent, -1);
  assert.ok(Math.abs(area(contours) / circle - 1) < 2e-3);
  const mask = await client.ask({ method: 'coverage', job: ball.job, z, ...raster });
  assert.equal(mask.body.length, 500 * 400);
  const lit = mask.body.reduce((sum, grey) => sum + grey / 255, 0) * 0.025 ** 2;
  assert.ok(Math.abs(lit / circle - 1) < 2e-3);
  const runs = await client.ask({ method: 'runs', job: ball.job, z, ...raster, lines: 2 });
  assert.equal(runs.lines, 800);
  let length = 0;
  for (let run = 0, at = 4 * (runs.lines + 1); run < runs.runs; ++run, at += 8)
    length += runs.body.readInt32LE(at + 4) - runs.body.readInt32LE(at);
  assert.ok(Math.abs(length / 256 / 2 * 0.025 ** 2 / circle - 1) < 2e-3);
}
const square = await client.contours({ job: ball.job, z: 0, polygons: [[0, 0, 2, 0, 2, 2, 0, 2]] });
assert.ok(Math.abs(area(square) - 4) < 0.01);
const layer = await client.ask({ method: 'contours', job: ball.job, layer: 99 });
assert.ok(Math.abs(layer.z - 4.95) < 1e-9);

// Requests that were made before any was answered are answered in their order.
const several = await Promise.all([1, 2, 3].map((z) => client.ask({ method: 'contours', job: ball.job, z })));
assert.deepEqual(several.map((reply) => reply.z), [1, 2, 3]);

for (const [request, message] of [
  [{ method: 'slice' }, /method: "slice" is unknown; accepted: open/],
  [{ method: 'contours', job: 99, z: 0 }, /job: 99 is not open/],
  [{ method: 'contours', job: ball.job }, /z: missing/],
  [{ method: 'contours', job: ball.job, z: 0, layer: 0 }, /layer: conflicts with z/],
  [{ method: 'contours', job: ball.job, z: 0, what: 'all' }, /accepted: part, supports, both/],
  [{ method: 'coverage', job: ball.job, z: 0, ...raster, columns: 2e9 }, /columns/],
  [{ method: 'coverage', job: ball.job, z: 0, ...raster, pitch_x: 'wide' }, /pitch_x/],
  [{ method: 'fill', job: ball.job, z: 0, polygons: [[0, 1, 2]] }, /polygons/],
  [{ method: 'open', text: '[part]\nshape = "ball"\n' }, /request\.toml:2: part\.shape/],
  [{ method: 'open', set: { 'foam.cel': 1 } }, /did you mean `foam\.cell`/],
  [{ method: 'run', job: ball.job, output: '-' }, /standard output/],
]) await assert.rejects(client.ask(request), message);

const written = await client.ask({ method: 'run', job: ball.job, output: 'ball.svg' });
assert.equal(written.layers, 100);
assert.ok(Math.abs(written.volume / (4 / 3 * Math.PI * 125) - 1) < 2e-3);
await client.ask({ method: 'close', job: ball.job });
await assert.rejects(client.contours({ job: ball.job, z: 0 }), /is not open/);
await client.end();
console.log('serve: sections, masks, runs, fills and mistakes as they should be');
