// Stage: the canvas of the view. Draws only when something has changed: quickly at first, finely after.
import { Vector3 } from "three";
import type { Triple } from "../server/types";
import { Orbit } from "./camera";
import { Pace } from "./pace";
import type { Paint } from "./paint";
import { pick } from "./pick";
import { Renderer, type Scene } from "./renderer";
import type { Volume } from "./volume";

/** The fine picture is begun when nothing has changed for this long, ms. */
const settle = 160;
/** Rows of the fine picture that are drawn at once: to begin with, and at least. */
const first_rows = 64;
const least_rows = 16;
const fine_stride = 0.7;

export class Stage {
    readonly orbit: Orbit;
    readonly pace = new Pace();
    /** Called after each frame: markers follow the camera. */
    after_frame: () => void = () => {};
    private renderer: Renderer | null;
    private volume: Volume | null = null;
    private paint: Paint | null = null;
    private scene: Scene | null = null;
    private asked = 0;
    private settle_timer = 0;
    /** The next row of the fine picture, and how many are drawn a frame. */
    private row = 0;
    private rows = first_rows;
    private readonly watcher: ResizeObserver;
    private size = { width: 1, height: 1 };

    constructor(
        private readonly canvas: HTMLCanvasElement,
        private readonly frame: HTMLElement,
    ) {
        this.renderer = Renderer.make(canvas);
        this.orbit = new Orbit(frame);
        this.orbit.controls.addEventListener("change", () => this.invalidate());
        this.watcher = new ResizeObserver(() => this.resize());
        this.watcher.observe(frame);
        canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
        canvas.addEventListener("webglcontextrestored", () => {
            this.renderer = Renderer.make(canvas);
            if (this.volume) this.renderer?.set_volume(this.volume);
            this.renderer?.set_paint(this.paint);
            this.invalidate();
        });
        this.resize();
    }

    get has_webgl(): boolean {
        return this.renderer !== null;
    }

    get voxels(): number {
        return this.volume ? Math.max(...this.volume.size) : 0;
    }

    dispose(): void {
        this.watcher.disconnect();
        this.orbit.controls.dispose();
        cancelAnimationFrame(this.asked);
        clearTimeout(this.settle_timer);
    }

    set_volume(volume: Volume): void {
        this.volume = volume;
        this.renderer?.set_volume(volume);
        this.orbit.look_at(volume.lo, volume.hi);
        this.invalidate();
    }

    set_paint(paint: Paint | null): void {
        if (paint === this.paint) return;
        this.paint = paint;
        this.renderer?.set_paint(paint);
        this.invalidate();
    }

    set_scene(scene: Omit<Scene, "fine" | "stride">): void {
        const next = { ...scene, fine: true, stride: fine_stride };
        const same = JSON.stringify(next) === JSON.stringify(this.scene);
        this.scene = next;
        if (!same) this.invalidate();
    }

    /** Something has changed: draws quickly, and finely when nothing changes for a while. */
    invalidate(): void {
        clearTimeout(this.settle_timer);
        this.ask((now) => this.draw(now));
    }

    private ask(step: (now: number) => void): void {
        cancelAnimationFrame(this.asked);
        this.asked = requestAnimationFrame(step);
    }

    private resize(): void {
        const box = this.frame.getBoundingClientRect();
        this.size = { width: Math.max(1, box.width), height: Math.max(1, box.height) };
        this.orbit.set_aspect(this.size.width / this.size.height);
        this.invalidate();
    }

    private pixels(scale: number): [number, number] {
        return [
            Math.max(1, Math.round(this.size.width * scale)),
            Math.max(1, Math.round(this.size.height * scale)),
        ];
    }

    private draw(now: number): void {
        this.pace.frame(now);
        this.orbit.camera.updateMatrixWorld();
        if (this.renderer && this.scene && !this.renderer.context_lost) {
            const [width, height] = this.pixels(this.pace.scale);
            if (this.canvas.width !== width || this.canvas.height !== height) {
                this.canvas.width = width;
                this.canvas.height = height;
            }
            this.renderer.draw(this.orbit.camera, {
                ...this.scene,
                fine: false,
                stride: this.pace.scale < 0.6 ? 2.2 : 1.4,
            });
        }
        this.after_frame();
        this.row = 0;
        this.settle_timer = window.setTimeout(() => this.ask(() => this.draw_rows()), settle);
    }

    /** Draws the fine picture a few rows a frame, so that a movement can begin at any time. */
    private draw_rows(): void {
        if (!this.renderer || !this.scene || this.renderer.context_lost) return;
        const [width, height] = this.pixels(Math.min(2, devicePixelRatio));
        const rows = Math.min(height - this.row, this.rows);
        const begun = performance.now();
        this.renderer.draw_rows(
            this.orbit.camera,
            { ...this.scene, fine: true, stride: fine_stride },
            width,
            height,
            this.row,
            rows,
        );
        this.row += rows;
        this.ask(() => {
            const taken = performance.now() - begun;
            this.rows = Math.max(least_rows, Math.round(this.rows * (taken < 25 ? 2 : taken > 70 ? 0.5 : 1)));
            if (this.row < height) this.draw_rows();
            else this.renderer?.show_rows(this.canvas);
        });
    }

    /** Place on the screen of a point of the part, in pixels of the view; null behind the eye. */
    on_screen(p: Triple): [number, number] | null {
        const at = new Vector3(...p).project(this.orbit.camera);
        if (at.z > 1) return null;
        return [((at.x + 1) / 2) * this.size.width, ((1 - at.y) / 2) * this.size.height];
    }

    /** The point at a pixel of the view, as far from the eye's plane as `p`. */
    place_beside(p: Triple, x: number, y: number): Triple {
        const depth = new Vector3(...p).project(this.orbit.camera).z;
        const at = new Vector3((x / this.size.width) * 2 - 1, 1 - (y / this.size.height) * 2, depth);
        return at.unproject(this.orbit.camera).toArray();
    }

    /** Size on the screen of a length of 1 mm at a point, px. */
    pixels_a_mm(p: Triple): number {
        const { camera } = this.orbit;
        const depth = new Vector3(...p).sub(camera.position).dot(camera.getWorldDirection(new Vector3()));
        return this.size.height / (2 * Math.max(depth, 1e-6) * Math.tan(((camera.fov / 2) * Math.PI) / 180));
    }

    place_at_middle(): Triple | null {
        return this.place_at(this.size.width / 2, this.size.height / 2);
    }

    /** The place of the part at a pixel of the view; null when there is none. */
    place_at(x: number, y: number): Triple | null {
        if (!this.volume || !this.scene) return null;
        this.orbit.camera.updateMatrixWorld();
        const across = (x / this.size.width) * 2 - 1,
            up = 1 - (y / this.size.height) * 2;
        return pick(this.volume, this.orbit.camera, across, up, this.scene.cut);
    }
}
