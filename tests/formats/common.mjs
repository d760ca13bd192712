// What every check needs: running programs, and saying what was found to be wrong.
import {execFileSync} from "node:child_process";

/** Folder of lamella's sources, for models and examples. */
export const sources = process.env.SOURCES;

/** Runs a program in the check's own folder; returns what it writes to standard output. */
export function run(program, ...args) {
    return execFileSync(program, args, {encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "pipe"]});
}

/** Runs lamella quietly. */
export function lamella(...args) {
    return run(process.env.LAMELLA, ...args);
}

export function require(holds, message) {
    if (!holds) throw new Error(message);
}

/** Requires two numbers to agree to a share of the second. */
export function requireNear(found, expected, share, what) {
    require(Math.abs(found - expected) <= share * Math.abs(expected),
            `${what}: ${found} where ${expected} is expected, to ${100 * share} %`);
}

/** Area of a polygon of [x, y] points, positive when it turns counter-clockwise. */
export function shoelace(points) {
    let twice = 0;
    points.forEach(([x, y], i) => {
        const [u, v] = points[(i + 1) % points.length];
        twice += x * v - u * y;
    });
    return twice / 2;
}
