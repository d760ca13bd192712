// What a job of the mock looks like: masks, contours, paths, the curve and the volume.
import { png } from "./png.mjs";

const share = (distance, pitch) => Math.max(0, Math.min(1, 0.5 - distance / pitch));

/** Heights of the planes of the layers: the middle of each layer. */
export function plane(job, layer) {
    return job.bounds.lo[2] + (layer + 0.5) * job.height;
}

export function mask(job, layer, window, width, colours) {
    const { lo, hi } = job.bounds;
    const x0 = window.x0 ?? lo[0],
        x1 = window.x1 ?? hi[0];
    const y0 = window.y0 ?? lo[1],
        y1 = window.y1 ?? hi[1];
    const height = Math.max(1, Math.round((width * (y1 - y0)) / (x1 - x0)));
    const pitch = (x1 - x0) / width;
    const z = plane(job, layer);
    const channels = colours ? 3 : 1;
    const bytes = new Uint8Array(width * height * channels);
    for (let j = 0; j < height; ++j) {
        const y = y1 - (j + 0.5) * pitch;
        for (let i = 0; i < width; ++i) {
            const x = x0 + (i + 0.5) * pitch;
            const part = share(job.field.part(x, y, z), pitch);
            const support = part < 1 ? share(job.field.support(x, y, z), pitch) : 0;
            const at = (j * width + i) * channels;
            if (!colours) {
                bytes[at] = 255 * Math.max(part, 0.6 * support);
                continue;
            }
            const base = [
                0x10 + (0x59 - 0x10) * support,
                0x14 + (0x8f - 0x14) * support,
                0x18 + (0xcc - 0x18) * support,
            ];
            [0xdf, 0xe8, 0xf2].forEach((full, c) => {
                bytes[at + c] = base[c] + (full - base[c]) * part;
            });
        }
    }
    return png(width, height, channels, bytes);
}

/** Marching squares, joined to loops. */
export function contours(job, layer, pitch = 0.4) {
    const { lo, hi } = job.bounds;
    const z = plane(job, layer);
    const nx = Math.ceil((hi[0] - lo[0]) / pitch) + 3,
        ny = Math.ceil((hi[1] - lo[1]) / pitch) + 3;
    const at = (i, j) => [lo[0] + (i - 1) * pitch, lo[1] + (j - 1) * pitch];
    const value = new Float64Array(nx * ny);
    let area = 0;
    for (let j = 0; j < ny; ++j) {
        for (let i = 0; i < nx; ++i) {
            value[j * nx + i] = job.field.part(...at(i, j), z) || 1e-9;
            area += share(value[j * nx + i], pitch) * pitch * pitch;
        }
    }
    const next = new Map();
    const point = (i, j, u, v) => {
        const [a, b] = [value[j * nx + i], value[v * nx + u]];
        const [p, q] = [at(i, j), at(u, v)];
        const t = a / (a - b);
        return [p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t];
    };
    for (let j = 0; j + 1 < ny; ++j) {
        for (let i = 0; i + 1 < nx; ++i) {
            const corner = [
                [i, j],
                [i + 1, j],
                [i + 1, j + 1],
                [i, j + 1],
            ];
            const inside = corner.map(([u, v]) => value[v * nx + u] < 0);
            const starts = [],
                ends = [];
            for (let k = 0; k < 4; ++k) {
                const other = (k + 1) % 4;
                if (inside[k] === inside[other]) continue;
                (inside[k] ? starts : ends).push(point(...corner[k], ...corner[other]));
            }
            starts.forEach((start, k) =>
                next.set(start.map((c) => c.toFixed(6)).join(), [start, ends[k] ?? ends[0]]),
            );
        }
    }
    const loops = [];
    while (next.size) {
        const points = [];
        let key = next.keys().next().value;
        while (next.has(key)) {
            const [start, end] = next.get(key);
            next.delete(key);
            points.push(+start[0].toFixed(3), +start[1].toFixed(3));
            key = end.map((c) => c.toFixed(6)).join();
        }
        if (points.length > 4) loops.push({ parent: -1, points });
    }
    return { contours: loops, area };
}

export function paths(job, layer) {
    const walls = contours(job, layer).contours;
    const list = walls.map(({ points }, i) => ({
        role: i % 3 ? "inner wall" : "outer wall",
        tool: 0,
        width: 0.45,
        speed: i % 3 ? 60 : 30,
        closed: true,
        points,
    }));
    const { lo, hi } = job.bounds;
    const z = plane(job, layer);
    for (let y = lo[1] + 0.5; y < hi[1]; y += 1.2) {
        let start = null;
        for (let x = lo[0]; x <= hi[0] + 0.3; x += 0.3) {
            const solid = job.field.part(x, y, z) < -0.4;
            if (solid && start === null) start = x;
            if (!solid && start !== null) {
                const points = [start, y, x, y].map((one) => +one.toFixed(3));
                list.push({ role: "infill", tool: 0, width: 0.45, speed: 90, closed: false, points });
                start = null;
            }
        }
    }
    const travels = list.slice(1).map(({ points }, i) => {
        const before = list[i];
        const from = before.closed ? before.points.slice(0, 2) : before.points.slice(-2);
        return { after: i + 1, speed: 150, retracts: i % 4 === 0, points: [...from, ...points.slice(0, 2)] };
    });
    return { paths: list, travels, seconds: 0.2 * list.length, z: plane(job, layer) };
}

export function curve(job, values) {
    const step = Math.max(1, Math.ceil(job.count / values));
    const area = [],
        support = [];
    const { lo, hi } = job.bounds;
    const pitch = Math.max(hi[0] - lo[0], hi[1] - lo[1]) / 60;
    for (let layer = 0; layer < job.count; layer += step) {
        let a = 0,
            s = 0;
        for (let y = lo[1] + pitch / 2; y < hi[1]; y += pitch) {
            for (let x = lo[0] + pitch / 2; x < hi[0]; x += pitch) {
                const z = plane(job, Math.min(job.count - 1, layer + Math.floor(step / 2)));
                a += share(job.field.part(x, y, z), pitch);
                s += share(job.field.support(x, y, z), pitch);
            }
        }
        area.push(+(a * pitch * pitch).toFixed(3));
        support.push(+(s * pitch * pitch).toFixed(3));
    }
    return { layers_a_value: step, area_mm2: area, support_area_mm2: support };
}

const shared = (job, values) => {
    const step = Math.max(1, Math.ceil(job.count / values));
    return { step, count: Math.ceil(job.count / step) };
};

/** Three islands, in the layer in the middle. */
export function islands(job, values) {
    const { step, count } = shared(job, values);
    const list = new Array(count).fill(0);
    list[Math.floor(count / 2)] = 3;
    return { layers_a_value: step, islands: list, pitch_mm: 0.1 };
}

/** Each layer takes 6 s, the lowest tenth 30 s. */
export function times(job, values) {
    const { step, count } = shared(job, values);
    return { layers_a_value: step, seconds: Array.from({ length: count }, (_, i) => (i < count / 10 ? 30 : 6)) };
}

export function volume(job, n) {
    const { lo, hi } = job.bounds;
    const edges = hi.map((one, k) => one - lo[k]);
    const voxel = Math.max(...edges) / n;
    const size = edges.map((edge) => Math.max(2, Math.ceil(edge / voxel)));
    const step = edges.map((edge, k) => edge / size[k]);
    const head = Buffer.from(JSON.stringify({ size, lo, hi, channels: 2 }));
    const data = Buffer.alloc(size[0] * size[1] * size[2] * 2);
    let at = 0;
    for (let k = 0; k < size[2]; ++k) {
        for (let j = 0; j < size[1]; ++j) {
            for (let i = 0; i < size[0]; ++i) {
                const p = [
                    lo[0] + (i + 0.5) * step[0],
                    lo[1] + (j + 0.5) * step[1],
                    lo[2] + (k + 0.5) * step[2],
                ];
                data[at++] = 255 * share(job.field.part(...p), voxel);
                data[at++] = 255 * share(job.field.support(...p), voxel);
            }
        }
    }
    const length = Buffer.alloc(4);
    length.writeUInt32LE(head.length);
    return Buffer.concat([length, head, data]);
}

/** A round shaded picture: the mock has no renderer. */
export function frame(width, azimuth) {
    const bytes = new Uint8Array(width * width);
    const light = (azimuth * Math.PI) / 180;
    for (let j = 0; j < width; ++j) {
        for (let i = 0; i < width; ++i) {
            const x = (i / width - 0.5) * 2.4,
                y = (j / width - 0.5) * 2.4;
            const r = Math.hypot(x, y);
            if (r < 1)
                bytes[j * width + i] =
                    90 + 140 * Math.max(0, Math.cos(light) * x - y * 0.6 + Math.sqrt(1 - r * r) * 0.6);
        }
    }
    return png(width, width, 1, bytes);
}
