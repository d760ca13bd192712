// Renderer: draws a volume by ray marching with WebGL2.
import type { PerspectiveCamera } from "three";
import { Matrix4 } from "three";
import type { Structure, Triple } from "../server/types";
import { type Cut, clipped } from "./cut";
import fragment from "./march.frag.glsl";
import { type Paint, rest_of } from "./paint";
import vertex from "./triangle.vert.glsl";
import type { Volume } from "./volume";

export interface Colours {
    part: Triple;
    support: Triple;
    cut: Triple;
    support_cut: Triple;
    layer: Triple;
    fault: Triple;
    grid: Triple;
    /** Of the part's structure. */
    structure: Record<Exclude<Structure, "supports">, Triple>;
}

export interface Scene {
    cut: Cut;
    layer_z: number;
    layer_height: number;
    colours: Colours;
    /** Boxes in which the surface is painted as faulty, of which the first are drawn. */
    faults: { lo: Triple; hi: Triple }[];
    /** False while the view moves: fewer samples. */
    fine: boolean;
    /** Length of a step in voxels: longer ones are faster and may miss thin walls. */
    stride: number;
}

/** As many as the shader takes. */
const most_faults = 64;

export class Renderer {
    private readonly program: WebGLProgram;
    private readonly places = new Map<string, WebGLUniformLocation | null>();
    private readonly matrix = new Matrix4();
    private volume: Volume | null = null;
    private textures: WebGLTexture[] = [];
    private paint: { paint: Paint; texture: WebGLTexture } | null = null;
    private still: {
        width: number;
        height: number;
        buffer: WebGLFramebuffer;
        pixels: WebGLRenderbuffer;
    } | null = null;

    /** Returns null when the browser has no WebGL2. */
    static make(canvas: HTMLCanvasElement): Renderer | null {
        const gl = canvas.getContext("webgl2", {
            alpha: true,
            antialias: false,
            depth: false,
            premultipliedAlpha: true,
            powerPreference: "high-performance",
        });
        if (!gl) return null;
        try {
            return new Renderer(gl);
        } catch {
            return null; // a browser that has the interface but cannot compile for its device
        }
    }

    private constructor(private readonly gl: WebGL2RenderingContext) {
        this.program = this.link();
        gl.useProgram(this.program);
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
        gl.bindVertexArray(gl.createVertexArray());
    }

    get context_lost(): boolean {
        return this.gl.isContextLost();
    }

    private link(): WebGLProgram {
        const gl = this.gl;
        const program = gl.createProgram();
        for (const [type, source] of [
            [gl.VERTEX_SHADER, vertex],
            [gl.FRAGMENT_SHADER, fragment],
        ] as const) {
            const shader = gl.createShader(type);
            if (!shader) throw new Error("no shader");
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
            throw new Error(gl.getProgramInfoLog(program) ?? "the shader was refused");
        }
        return program;
    }

    set_volume(volume: Volume): void {
        const gl = this.gl;
        for (const texture of this.textures) gl.deleteTexture(texture);
        this.volume = volume;
        this.textures = [
            this.texture(0, volume.size, gl.RG8, gl.RG, volume.data, gl.LINEAR),
            this.texture(
                1,
                volume.blocks,
                gl.R8,
                gl.RED,
                volume.largest.map((one) => (one ? 255 : 0)),
                gl.NEAREST,
            ),
        ];
    }

    /** Colours of the part; null: none. */
    set_paint(paint: Paint | null): void {
        const gl = this.gl;
        if (this.paint) gl.deleteTexture(this.paint.texture);
        this.paint = paint && {
            paint,
            texture:
                paint.of === "structure"
                    ? this.texture(2, paint.size, gl.RGB8, gl.RGB, paint.data, gl.LINEAR)
                    : this.texture(2, paint.size, gl.R8, gl.RED, paint.data, gl.NEAREST),
        };
    }

    private texture(
        unit: number,
        [nx, ny, nz]: Triple,
        inside: number,
        format: number,
        data: Uint8Array,
        filter: number,
    ): WebGLTexture {
        const gl = this.gl;
        const texture = gl.createTexture();
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_3D, texture);
        gl.texImage3D(gl.TEXTURE_3D, 0, inside, nx, ny, nz, 0, format, gl.UNSIGNED_BYTE, data);
        for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
            gl.texParameteri(gl.TEXTURE_3D, which, filter);
        }
        for (const which of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) {
            gl.texParameteri(gl.TEXTURE_3D, which, gl.CLAMP_TO_EDGE);
        }
        return texture;
    }

    private place(name: string): WebGLUniformLocation | null {
        if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
        return this.places.get(name) ?? null;
    }

    private triple(name: string, value: Triple): void {
        this.gl.uniform3f(this.place(name), ...value);
    }

    /** Draws all of the canvas at once. */
    draw(camera: PerspectiveCamera, scene: Scene): void {
        const gl = this.gl;
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT);
        this.march(camera, scene);
    }

    /** Draws some rows of a picture that is not shown yet. */
    draw_rows(
        camera: PerspectiveCamera,
        scene: Scene,
        width: number,
        height: number,
        first: number,
        rows: number,
    ): void {
        const gl = this.gl;
        if (!this.still || this.still.width !== width || this.still.height !== height)
            this.make_still(width, height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.still!.buffer);
        gl.viewport(0, 0, width, height);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(0, first, width, rows);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT);
        this.march(camera, scene);
        gl.disable(gl.SCISSOR_TEST);
        gl.flush();
    }

    /** Shows the picture that draw_rows has drawn. */
    show_rows(canvas: HTMLCanvasElement): void {
        const gl = this.gl;
        if (!this.still) return;
        const { width, height, buffer } = this.still;
        if (canvas.width !== width || canvas.height !== height) {
            canvas.width = width;
            canvas.height = height;
        }
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, buffer);
        gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
        gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    }

    private make_still(width: number, height: number): void {
        const gl = this.gl;
        if (this.still) {
            gl.deleteFramebuffer(this.still.buffer);
            gl.deleteRenderbuffer(this.still.pixels);
        }
        const pixels = gl.createRenderbuffer();
        gl.bindRenderbuffer(gl.RENDERBUFFER, pixels);
        gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, width, height);
        const buffer = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, pixels);
        this.still = { width, height, buffer, pixels };
    }

    private march(camera: PerspectiveCamera, scene: Scene): void {
        const gl = this.gl;
        const volume = this.volume;
        if (!volume) return;
        this.matrix.multiplyMatrices(camera.matrixWorld, camera.projectionMatrixInverse);
        gl.uniformMatrix4fv(this.place("unproject"), false, this.matrix.elements);
        gl.uniform3f(this.place("eye"), camera.position.x, camera.position.y, camera.position.z);
        gl.uniform1i(this.place("volume"), 0);
        gl.uniform1i(this.place("blocks"), 1);
        gl.uniform1i(this.place("paint"), 2);
        this.set_paint_colours(scene.colours);
        this.triple("paint_lo", this.paint?.paint.lo ?? volume.lo);
        this.triple("paint_hi", this.paint?.paint.hi ?? volume.hi);
        this.set_space(volume, scene);
        const { colours } = scene;
        this.triple("part_colour", colours.part);
        this.triple("support_colour", colours.support);
        this.triple("cut_colour", colours.cut);
        this.triple("support_cut_colour", colours.support_cut);
        this.triple("layer_colour", colours.layer);
        this.triple("grid_colour", colours.grid);
        this.triple("fault_colour", colours.fault);
        this.set_faults(scene.faults.slice(0, most_faults));
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }

    private set_paint_colours({ structure }: Colours): void {
        const gl = this.gl;
        const paint = this.paint?.paint;
        gl.uniform1i(this.place("painted_by"), !paint ? 0 : paint.of === "structure" ? 2 : 1);
        const rest = paint?.of === "structure" ? rest_of(paint.parts) : "body";
        this.triple("skin_colour", structure.skin);
        this.triple("frame_colour", structure.frame);
        this.triple("solid_colour", structure.solid);
        this.triple("rest_colour", structure[rest]);
    }

    private set_faults(faults: Scene["faults"]): void {
        const gl = this.gl;
        gl.uniform1i(this.place("faults"), faults.length);
        if (!faults.length) return;
        gl.uniform3fv(this.place("fault_lo"), faults.flatMap((one) => one.lo));
        gl.uniform3fv(this.place("fault_hi"), faults.flatMap((one) => one.hi));
    }

    private set_space(volume: Volume, scene: Scene): void {
        const gl = this.gl;
        const { lo, hi, size, block } = volume;
        const voxels = size.map((n, k) => (hi[k]! - lo[k]!) / n) as Triple;
        const rest = clipped(lo, hi, scene.cut);
        this.triple("lo", lo);
        this.triple("hi", hi);
        this.triple("clip_lo", rest.lo);
        this.triple("clip_hi", rest.hi);
        this.triple("block", voxels.map((edge) => edge * block) as Triple);
        gl.uniform1f(this.place("voxel"), Math.min(...voxels));
        gl.uniform1f(this.place("surface"), volume.surface / 255);
        gl.uniform1f(this.place("stride"), scene.stride);
        gl.uniform1i(this.place("fine"), scene.fine ? 1 : 0);
        gl.uniform1i(this.place("cut_axis"), scene.cut.axis);
        gl.uniform1f(this.place("cut_at"), scene.cut.at);
        gl.uniform1f(this.place("layer_z"), scene.layer_z);
        gl.uniform1f(this.place("layer_half"), scene.layer_height / 2);
        const width = Math.max(hi[0] - lo[0], hi[1] - lo[1]);
        gl.uniform1f(
            this.place("grid_pitch"),
            width > 400 ? 100 : width > 4 ? 10 ** Math.floor(Math.log10(width / 2)) : 1,
        );
    }
}
