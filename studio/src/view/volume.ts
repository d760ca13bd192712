// The volume that the server sends: coverage of part and supports, and blocks of it that the view may skip.
import type { Triple } from "../server/types";

export interface Volume {
    size: Triple;
    lo: Triple;
    hi: Triple;
    /** Two bytes a voxel: part, supports. */
    data: Uint8Array;
    /** Coverage at which the surface is drawn, 0 to 255. */
    surface: number;
    /** Voxels along an edge of a block, blocks along each axis, and the largest coverage in each. */
    block: number;
    blocks: Triple;
    largest: Uint8Array;
}

const block_edge = 6;

export function read_volume(bytes: ArrayBuffer): Volume {
    const length = new DataView(bytes).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length))) as {
        size: Triple;
        lo: Triple;
        hi: Triple;
    };
    const data = new Uint8Array(bytes, 4 + length);
    const [nx, ny, nz] = head.size;
    if (data.length < nx * ny * nz * 2) throw new Error("The volume is shorter than its head says.");
    const blocks = head.size.map((n) => Math.ceil(n / block_edge)) as Triple;
    const surface = surface_of(data, head.size);
    const largest = largest_of(data, head.size, blocks, surface);
    return { ...head, data, surface, block: block_edge, blocks, largest };
}

const usual_surface = 128;
const low_surface = 70;
/** From this share of material on that the usual surface would not show, the low one is drawn. */
const lost_share = 0.01;

/** The coverage to draw: half, unless walls thinner than a voxel would get holes. */
function surface_of(data: Uint8Array, [nx, ny, nz]: Triple): number {
    const steps = [2, 2 * nx, 2 * nx * ny];
    let all = 0;
    let lost = 0;
    for (let z = 1; z + 1 < nz; ++z) {
        for (let y = 1; y + 1 < ny; ++y) {
            let at = ((z * ny + y) * nx + 1) * 2;
            for (let x = 1; x + 1 < nx; ++x, at += 2) {
                const value = data[at]!;
                all += value;
                if (value < 25 || value >= usual_surface) continue;
                const shown = steps.some(
                    (step) => data[at - step]! >= usual_surface || data[at + step]! >= usual_surface,
                );
                if (!shown) lost += value;
            }
        }
    }
    return lost > lost_share * all ? low_surface : usual_surface;
}

/** The largest coverage in each block and in the voxels beside it, which interpolation reaches. */
function largest_of(
    data: Uint8Array,
    [nx, ny, nz]: Triple,
    [bx, by, bz]: Triple,
    surface: number,
): Uint8Array {
    const largest = new Uint8Array(bx * by * bz);
    const reached = (n: number, count: number): [number, number][] =>
        Array.from({ length: n }, (_, i) => {
            const first = Math.max(0, Math.floor((i - 1) / block_edge));
            return [first, Math.min(count - 1, Math.floor((i + 1) / block_edge))];
        });
    const xs = reached(nx, bx),
        ys = reached(ny, by),
        zs = reached(nz, bz);
    let at = 0;
    for (let z = 0; z < nz; ++z) {
        for (let y = 0; y < ny; ++y) {
            for (let x = 0; x < nx; ++x, at += 2) {
                const value = Math.max(data[at]!, data[at + 1]!);
                if (value < surface) continue; // no surface: the block stays empty
                for (let k = zs[z]![0]; k <= zs[z]![1]; ++k) {
                    for (let j = ys[y]![0]; j <= ys[y]![1]; ++j) {
                        for (let i = xs[x]![0]; i <= xs[x]![1]; ++i) {
                            const block = (k * by + j) * bx + i;
                            if (largest[block]! < value) largest[block] = value;
                        }
                    }
                }
            }
        }
    }
    return largest;
}

/** Coverage of part and supports at a point, of the nearest voxel, 0 to 255. */
export function coverage_at(volume: Volume, p: Triple): number {
    const at = p.map((one, k) =>
        Math.floor(((one - volume.lo[k]!) / (volume.hi[k]! - volume.lo[k]!)) * volume.size[k]!),
    );
    const [x, y, z] = at as Triple;
    const [nx, ny, nz] = volume.size;
    if (x < 0 || y < 0 || z < 0 || x >= nx || y >= ny || z >= nz) return 0;
    const i = ((z * ny + y) * nx + x) * 2;
    return Math.max(volume.data[i]!, volume.data[i + 1]!);
}
