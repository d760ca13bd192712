// Finds the place of the part under the pointer, on the volume in memory.
import type { PerspectiveCamera } from "three";
import { Vector3 } from "three";
import type { Triple } from "../server/types";
import { type Cut, clipped } from "./cut";
import { type Volume, coverage_at } from "./volume";

/** Returns the place in mm; null when the ray meets nothing. `x`, `y`: on the screen, -1 to 1. */
export function pick(
    volume: Volume,
    camera: PerspectiveCamera,
    x: number,
    y: number,
    cut: Cut,
): Triple | null {
    const eye = camera.position;
    const ray = new Vector3(x, y, 0.5).unproject(camera).sub(eye).normalize();
    const from: Triple = [eye.x, eye.y, eye.z];
    const along: Triple = [ray.x, ray.y, ray.z];
    const { lo, hi } = clipped(volume.lo, volume.hi, cut);
    let begin = 0;
    let end = Infinity;
    for (let k = 0; k < 3; ++k) {
        const a = (lo[k]! - from[k]!) / (along[k]! || 1e-9),
            b = (hi[k]! - from[k]!) / (along[k]! || 1e-9);
        begin = Math.max(begin, Math.min(a, b));
        end = Math.min(end, Math.max(a, b));
    }
    const step = 0.5 * Math.min(...volume.size.map((n, k) => (volume.hi[k]! - volume.lo[k]!) / n));
    for (let t = begin + 1e-6; t < end; t += step) {
        const p = from.map((one, k) => one + along[k]! * t) as Triple;
        if (coverage_at(volume, p) >= volume.surface) return p;
    }
    return null;
}
