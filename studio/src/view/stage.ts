// Stage: the canvas of the view. Draws only when something has changed: coarsely while it moves, finely after.
import { Vector3 } from "three";
import type { Triple } from "../server/types";
import { Orbit } from "./camera";
import { Pace } from "./pace";
import { pick } from "./pick";
import { Renderer, type Scene } from "./renderer";
import type { Volume } from "./volume";

/** The view counts as moving until this long after the last movement, ms. */
const settle = 160;
const fine_stride = 0.7;
const coarse_stride = 1.3;
/** Least share of the pixels along an edge while the view moves. */
const least_scale = 0.3;

export class Stage {
    readonly orbit: Orbit;
    readonly pace = new Pace(least_scale);
    /** Called after each frame: markers follow the camera. */
    after_frame: () => void = () => {};
    private renderer: Renderer | null;
    private volume: Volume | null = null;
    private scene: Scene | null = null;
    private asked = 0;
    private moved = 0;
    private settle_timer = 0;
    private readonly watcher: ResizeObserver;
    private size = { width: 1, height: 1 };

    constructor(private readonly canvas: HTMLCanvasElement, private readonly frame: HTMLElement) {
        this.renderer = Renderer.make(canvas);
        this.orbit = new Orbit(frame);
        this.orbit.controls.addEventListener("change", () => this.move());
        this.watcher = new ResizeObserver(() => this.resize());
        this.watcher.observe(frame);
        canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
        canvas.addEventListener("webglcontextrestored", () => {
            this.renderer = Renderer.make(canvas);
            if (this.volume) this.renderer?.set_volume(this.volume);
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

    set_scene(scene: Omit<Scene, "stride">): void {
        this.scene = { ...scene, stride: fine_stride };
        this.invalidate();
    }

    invalidate(): void {
        if (!this.asked) this.asked = requestAnimationFrame((now) => this.draw(now));
    }

    private move(): void {
        this.moved = performance.now();
        clearTimeout(this.settle_timer);
        this.settle_timer = window.setTimeout(() => this.invalidate(), settle + 20);
        this.invalidate();
    }

    private resize(): void {
        const box = this.frame.getBoundingClientRect();
        this.size = { width: Math.max(1, box.width), height: Math.max(1, box.height) };
        this.orbit.set_aspect(this.size.width / this.size.height);
        this.invalidate();
    }

    private draw(now: number): void {
        this.asked = 0;
        const moving = performance.now() - this.moved < settle;
        this.pace.frame(now, moving);
        this.orbit.camera.updateMatrixWorld();
        if (this.renderer && this.scene && !this.renderer.context_lost) {
            const dense = Math.min(2, devicePixelRatio);
            const scale = moving ? this.pace.scale * (this.pace.scale < 1 ? 1 : dense) : dense;
            const width = Math.round(this.size.width * scale), height = Math.round(this.size.height * scale);
            if (this.canvas.width !== width || this.canvas.height !== height) {
                this.canvas.width = width;
                this.canvas.height = height;
            }
            this.renderer.draw(this.orbit.camera, { ...this.scene, stride: moving ? coarse_stride : fine_stride });
        }
        this.after_frame();
    }

    /** Place on the screen of a point of the part, in pixels of the view; null behind the eye. */
    on_screen(p: Triple): [number, number] | null {
        const at = new Vector3(...p).project(this.orbit.camera);
        if (at.z > 1) return null;
        return [(at.x + 1) / 2 * this.size.width, (1 - at.y) / 2 * this.size.height];
    }

    /** The place of the part at a pixel of the view; null when there is none. */
    place_at(x: number, y: number): Triple | null {
        if (!this.volume || !this.scene) return null;
        this.orbit.camera.updateMatrixWorld();
        const across = x / this.size.width * 2 - 1, up = 1 - y / this.size.height * 2;
        return pick(this.volume, this.orbit.camera, across, up, this.scene.cut);
    }
}
