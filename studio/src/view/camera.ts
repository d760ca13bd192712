// The camera and its orbit round the part.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Triple } from "../server/types";

const usual: Triple = [-0.62, -0.86, 0.62];

export class Orbit {
    readonly camera = new PerspectiveCamera(28, 1, 0.1, 1000);
    readonly controls: OrbitControls;
    private reach = 0;
    private half: Triple = [1, 1, 1];
    private middle = new Vector3();

    constructor(element: HTMLElement) {
        this.camera.up.set(0, 0, 1);
        this.camera.position.set(...usual);
        this.controls = new OrbitControls(this.camera, element);
    }

    set_aspect(aspect: number): void {
        this.camera.aspect = aspect;
        this.camera.updateProjectionMatrix();
    }

    /** Looks at a box. A box of about the same size as before keeps the view. */
    look_at(lo: Triple, hi: Triple): void {
        const middle = new Vector3(...(lo.map((one, k) => (one + hi[k]!) / 2) as Triple));
        const half = lo.map((one, k) => (hi[k]! - one) / 2) as Triple;
        const reach = Math.hypot(...half);
        const moved = middle.clone().sub(this.middle).length();
        const same = this.reach > 0 && Math.abs(reach / this.reach - 1) < 0.25 && moved < 0.25 * reach;
        this.middle = middle;
        this.half = half;
        if (same) return;
        this.reach = reach;
        const direction = this.camera.position.clone().sub(this.controls.target).normalize();
        this.stand(direction);
    }

    /** Looks at the whole part from the usual corner. */
    reset(): void {
        this.stand(new Vector3(...usual).normalize());
    }

    /** Looks along an axis, from its positive end. */
    look_along(axis: number): void {
        const from: Triple[] = [
            [1, 0, 0.001],
            [0, -1, 0.001],
            [0, -0.001, 1],
        ];
        this.stand(new Vector3(...from[axis]!).normalize());
    }

    private stand(direction: Vector3): void {
        const distance = this.fitting(direction);
        this.controls.target.copy(this.middle);
        this.camera.position.copy(this.middle).addScaledVector(direction, distance);
        this.camera.near = distance / 100;
        this.camera.far = distance * 20;
        this.controls.minDistance = this.reach * 0.05;
        this.controls.maxDistance = distance * 6;
        this.camera.updateProjectionMatrix();
        this.controls.update();
        this.camera.updateMatrixWorld();
    }

    /** The distance from which all corners of the box are seen, with a margin. */
    private fitting(direction: Vector3): number {
        const { x, y, z } = direction;
        const flat = Math.hypot(x, y) || 1e-9;
        const right: Triple = [-y / flat, x / flat, 0];
        const up: Triple = [(-x * z) / flat, (-y * z) / flat, flat];
        const tall = Math.tan(((this.camera.fov / 2) * Math.PI) / 180) * 0.86;
        const wide = tall * this.camera.aspect;
        let distance = 0;
        for (let corner = 0; corner < 8; ++corner) {
            const at = this.half.map((one, k) => ((corner >> k) & 1 ? one : -one)) as Triple;
            const along = (axis: Triple) => axis[0] * at[0] + axis[1] * at[1] + axis[2] * at[2];
            const near = along([x, y, z]);
            distance = Math.max(
                distance,
                near + Math.abs(along(right)) / wide,
                near + Math.abs(along(up)) / tall,
            );
        }
        return distance || 1;
    }

    /** Turns round the part by angles in degrees. */
    turn(sideways: number, upward: number): void {
        const arm = this.camera.position.clone().sub(this.controls.target);
        const length = arm.length();
        const azimuth = Math.atan2(arm.y, arm.x) + (sideways * Math.PI) / 180;
        const most = (89.5 * Math.PI) / 180;
        const up = Math.asin(arm.z / length) + (upward * Math.PI) / 180;
        const elevation = Math.max(-most, Math.min(most, up));
        const flat = Math.cos(elevation) * length;
        this.camera.position
            .copy(this.controls.target)
            .add(
                new Vector3(Math.cos(azimuth) * flat, Math.sin(azimuth) * flat, Math.sin(elevation) * length),
            );
        this.controls.update();
    }

    zoom(factor: number): void {
        const arm = this.camera.position.clone().sub(this.controls.target);
        const length = arm.length();
        const wanted = Math.max(
            this.controls.minDistance,
            Math.min(this.controls.maxDistance, length * factor),
        );
        this.camera.position
            .copy(this.controls.target)
            .addScaledVector(arm.multiplyScalar(1 / length), wanted);
        this.controls.update();
    }

    /** Angles of the eye round the part, degrees, as the server's pictures take them. */
    angles(): { azimuth: number; elevation: number } {
        const arm = this.camera.position.clone().sub(this.controls.target);
        const degrees = 180 / Math.PI;
        return {
            azimuth: Math.atan2(arm.y, arm.x) * degrees,
            elevation: Math.asin(arm.z / arm.length()) * degrees,
        };
    }
}
