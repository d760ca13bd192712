// Sections of a recipe in JavaScript: a client of `lamella serve --stdio`.
//   node examples/javascript/sections.mjs examples/sphere_foam.toml
// prints the area of ten sections and shows the middle one in characters.
import { spawn } from 'node:child_process';

/** Talks to one server; requests are answered in the order in which they are made. */
export class SectionClient {
  #server;
  #received = Buffer.alloc(0);
  #waiting = [];

  constructor(command = 'lamella') {
    this.#server = spawn(command, ['serve', '--stdio'], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.#server.stdout.on('data', (bytes) => {
      this.#received = Buffer.concat([this.#received, bytes]);
      while (this.#deliver());
    });
    const fail = (error) => this.#waiting.splice(0).forEach(({ reject }) => reject(error));
    this.#server.on('error', fail);
    this.#server.on('close', () => fail(new Error('the server has ended')));
  }

  /** Sends a request; resolves to its reply, with the numbers behind it as `body`. */
  ask(request) {
    const text = Buffer.from(JSON.stringify(request));
    const length = Buffer.alloc(4);
    length.writeUInt32LE(text.length);
    this.#server.stdin.write(Buffer.concat([length, text]));
    return new Promise((resolve, reject) => this.#waiting.push({ resolve, reject }));
  }

  async contours(request) {
    const reply = await this.ask({ ...request, method: request.polygons ? 'fill' : 'contours' });
    const { body } = reply;
    const points = 4 * (reply.contours + 1) + 4 * reply.contours;
    return Array.from({ length: reply.contours }, (_, i) => {
      const [begin, end] = [body.readUInt32LE(4 * i), body.readUInt32LE(4 * (i + 1))];
      return {
        parent: body.readInt32LE(4 * (reply.contours + 1) + 4 * i),
        points: Array.from({ length: end - begin }, (_, k) =>
          [0, 8].map((along) => body.readDoubleLE(points + 16 * (begin + k) + along))),
      };
    });
  }

  async end() {
    await this.ask({ method: 'end' });
    this.#server.stdin.end();
  }

  /** Takes one whole reply from what was received; false when there is none yet. */
  #deliver() {
    if (this.#received.length < 4) return false;
    const body = 4 + this.#received.readUInt32LE(0);
    if (this.#received.length < body) return false;
    const head = JSON.parse(this.#received.subarray(4, body).toString());
    if (this.#received.length < body + head.bytes) return false;
    const reply = { ...head, body: Buffer.from(this.#received.subarray(body, body + head.bytes)) };
    this.#received = this.#received.subarray(body + head.bytes);
    const { resolve, reject } = this.#waiting.shift();
    if (reply.ok) resolve(reply);
    else reject(new Error(reply.message));
    return true;
  }
}

const shoelace = (points) => points.reduce((sum, [x, y], i) => {
  const [u, v] = points[(i + 1) % points.length];
  return sum + (x * v - u * y) / 2;
}, 0);

async function show(client, recipe) {
  const job = await client.ask({ method: 'open', recipe });
  const [height, count] = [job.upper[2] - job.lower[2], 10];
  for (let i = 0; i < count; ++i) {
    const z = job.lower[2] + (height * (i + 0.5)) / count;
    const contours = await client.contours({ job: job.job, z });
    const area = contours.reduce((sum, { points }) => sum + shoelace(points), 0);
    console.log(`z ${z.toFixed(2)} mm: ${contours.length} contours, ${area.toFixed(2)} mm2`);
  }
  const [columns, rows] = [72, 36];
  const { body } = await client.ask({
    method: 'coverage', job: job.job, z: (job.lower[2] + job.upper[2]) / 2, columns, rows,
    x: job.lower[0], y: job.upper[1],
    pitch_x: (job.upper[0] - job.lower[0]) / columns, pitch_y: (job.lower[1] - job.upper[1]) / rows,
  });
  for (let row = 0; row < rows; ++row) {
    const line = body.subarray(row * columns, (row + 1) * columns);
    console.log(Array.from(line, (grey) => ' .:*#'[Math.min(4, grey >> 5)]).join(''));
  }
}

async function main(recipe) {
  const client = new SectionClient(process.env.LAMELLA ?? 'lamella');
  try {
    await show(client, recipe);
  } finally {
    await client.end().catch(() => {}); // it may be what failed
  }
}

if (process.argv[1] && import.meta.url.endsWith(process.argv[1].split('/').pop())) {
  main(process.argv[2] ?? 'examples/sphere_foam.toml').catch((error) => {
    console.error(error.message);
    process.exitCode = 1;
  });
}
