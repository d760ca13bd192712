// The modulus in all directions: a surface whose distance from its middle is Young's modulus that way.
import { effect, signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Stiffness } from "../server/analysis";
import type { Triple } from "../server/types";
import { dark } from "../shell/theme";
import { colour } from "./chart";
import { figure } from "./numbers";

type Directions = Stiffness["directions"];

/** Where the eye is, degrees; kept from one foam to the next. */
const eye = signal({ azimuth: -55, elevation: 25 });

/** Dark blue to yellow, as the view's paint. */
const scale: Triple[] = [
    [68, 1, 84],
    [59, 82, 139],
    [33, 145, 140],
    [93, 200, 99],
    [253, 231, 37],
];

function on_scale(share: number, light: number): string {
    const place = 4 * Math.max(0, Math.min(1, share));
    const i = Math.min(3, Math.floor(place));
    const mixed = scale[i]!.map((one, k) => light * (one + (scale[i + 1]![k]! - one) * (place - i)));
    return `rgb(${mixed.map(Math.round).join()})`;
}

interface Facet {
    corners: Triple[];
    share: number;
}

/** Facets of the surface; the greatest modulus is 1. */
function facets_of({ polar, around, young }: Directions): Facet[] {
    const most = Math.max(...young),
        least = Math.min(...young);
    const at = (ring: number, turn: number): { p: Triple; e: number } => {
        const e = young[ring * around + (turn % around)]!;
        const down = (Math.PI * ring) / (polar - 1),
            angle = (2 * Math.PI * turn) / around,
            r = e / most;
        return {
            p: [r * Math.sin(down) * Math.cos(angle), r * Math.sin(down) * Math.sin(angle), r * Math.cos(down)],
            e,
        };
    };
    const facets: Facet[] = [];
    for (let ring = 0; ring + 1 < polar; ++ring) {
        for (let turn = 0; turn < around; ++turn) {
            const four = [at(ring, turn), at(ring + 1, turn), at(ring + 1, turn + 1), at(ring, turn + 1)];
            const e = four.reduce((sum, one) => sum + one.e / 4, 0);
            facets.push({
                corners: four.map((one) => one.p),
                share: most > least * 1.0001 ? (e - least) / (most - least) : 0.5,
            });
        }
    }
    return facets;
}

/** Turns a place to the screen: right, up, towards the eye. */
function turned([x, y, z]: Triple, azimuth: number, elevation: number): Triple {
    const a = (azimuth * Math.PI) / 180,
        b = (elevation * Math.PI) / 180;
    const right = -x * Math.sin(a) + y * Math.cos(a);
    const flat = x * Math.cos(a) + y * Math.sin(a);
    return [right, z * Math.cos(b) - flat * Math.sin(b), flat * Math.cos(b) + z * Math.sin(b)];
}

const cross = (a: Triple, b: Triple): Triple => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];
const less = (a: Triple, b: Triple): Triple => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** Light from above the eye's left shoulder. */
function light_on(corners: Triple[]): number {
    const normal = cross(less(corners[2]!, corners[0]!), less(corners[3]!, corners[1]!));
    const length = Math.hypot(...normal) || 1;
    const towards = normal[2] < 0 ? -1 : 1;
    const [x, y, z] = normal.map((one) => (towards * one) / length) as Triple;
    return 0.55 + 0.45 * Math.max(0, -0.35 * x + 0.45 * y + 0.82 * z);
}

function draw(canvas: HTMLCanvasElement, facets: Facet[]): void {
    const box = canvas.getBoundingClientRect();
    const ratio = Math.min(2, devicePixelRatio);
    canvas.width = Math.max(1, Math.round(box.width * ratio));
    canvas.height = Math.max(1, Math.round(box.height * ratio));
    const context = canvas.getContext("2d")!;
    const { azimuth, elevation } = eye.value;
    const reach = 0.4 * Math.min(canvas.width, canvas.height);
    const place = ([right, up]: Triple): [number, number] => [
        canvas.width / 2 + reach * right,
        canvas.height / 2 - reach * up,
    ];
    const axes = (["x", "y", "z"] as const).map((name, k) => ({
        name,
        end: turned([0, 1, 2].map((one) => (one === k ? 1.16 : 0)) as Triple, azimuth, elevation),
    }));
    const draw_axes = (front: boolean) => {
        for (const { name, end } of axes) {
            if (end[2] >= 0 !== front) continue;
            context.strokeStyle = context.fillStyle = colour(`--axis-${name}`);
            context.lineWidth = 1.5 * ratio;
            context.beginPath();
            context.moveTo(...place(front ? (end.map((one) => 0.75 * one) as Triple) : [0, 0, 0]));
            context.lineTo(...place(end));
            context.stroke();
            context.font = `600 ${12 * ratio}px system-ui, sans-serif`;
            context.textAlign = "center";
            context.textBaseline = "middle";
            context.fillText(name, ...place(end.map((one) => 1.07 * one) as Triple));
        }
    };
    draw_axes(false);
    const seen = facets
        .map(({ corners, share }) => {
            const there = corners.map((one) => turned(one, azimuth, elevation));
            return { there, share, depth: there.reduce((sum, one) => sum + one[2], 0) };
        })
        .sort((a, b) => a.depth - b.depth);
    context.lineWidth = ratio;
    for (const { there, share } of seen) {
        context.fillStyle = context.strokeStyle = on_scale(share, light_on(there));
        context.beginPath();
        there.forEach((one, i) => (i ? context.lineTo(...place(one)) : context.moveTo(...place(one))));
        context.closePath();
        context.fill();
        context.stroke(); // closes the seams between facets
    }
    draw_axes(true);
}

function turn(sideways: number, upward: number): void {
    const { azimuth, elevation } = eye.value;
    eye.value = {
        azimuth: azimuth - sideways,
        elevation: Math.max(-90, Math.min(90, elevation + upward)),
    };
}

export function Surface({ found, unit }: { found: Stiffness; unit: string }) {
    const canvas = useRef<HTMLCanvasElement>(null);
    useEffect(() => {
        const on = canvas.current!;
        const facets = facets_of(found.directions);
        const watcher = new ResizeObserver(() => draw(on, facets));
        watcher.observe(on);
        const stop = effect(() => {
            void dark.value;
            void eye.value;
            draw(on, facets);
        });
        return () => {
            watcher.disconnect();
            stop();
        };
    }, [found]);
    const on_key = (event: KeyboardEvent) => {
        const step = event.shiftKey ? 2 : 10;
        const move = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] }[
            event.key
        ];
        if (!move) return;
        event.preventDefault();
        turn(move[0]!, move[1]!);
    };
    return (
        <figure class="surface">
            <div
                role="application"
                tabIndex={0}
                aria-label={`Modulus in all directions, from ${figure(found.E_least)} to ${figure(found.E_greatest)} ${unit}. Arrow keys turn it.`}
                onKeyDown={on_key}
                onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
                onPointerMove={(event) => {
                    if (event.currentTarget.hasPointerCapture(event.pointerId))
                        turn(event.movementX * 0.7, event.movementY * 0.7);
                }}
            >
                <canvas ref={canvas} aria-hidden="true" />
            </div>
            <figcaption class="paint-legend">
                <div class="paint-scale" aria-hidden="true" />
                <div class="paint-ends">
                    <span>{figure(found.E_least)}</span>
                    <span>
                        {figure(found.E_greatest)} {unit}
                    </span>
                </div>
            </figcaption>
        </figure>
    );
}
