// The few parts of three that the view uses: its camera and its orbit control.
declare module "three" {
    export class Vector3 {
        x: number;
        y: number;
        z: number;
        constructor(x?: number, y?: number, z?: number);
        set(x: number, y: number, z: number): this;
        copy(other: Vector3): this;
        clone(): Vector3;
        sub(other: Vector3): this;
        add(other: Vector3): this;
        addScaledVector(other: Vector3, scale: number): this;
        multiplyScalar(scale: number): this;
        normalize(): this;
        length(): number;
        dot(other: Vector3): number;
        toArray(): [number, number, number];
        project(camera: PerspectiveCamera): this;
        unproject(camera: PerspectiveCamera): this;
    }
    export class Matrix4 {
        elements: number[];
        copy(other: Matrix4): this;
        invert(): this;
        multiplyMatrices(a: Matrix4, b: Matrix4): this;
    }
    export class PerspectiveCamera {
        fov: number;
        aspect: number;
        near: number;
        far: number;
        position: Vector3;
        up: Vector3;
        matrixWorld: Matrix4;
        projectionMatrix: Matrix4;
        projectionMatrixInverse: Matrix4;
        constructor(fov?: number, aspect?: number, near?: number, far?: number);
        updateProjectionMatrix(): void;
        updateMatrixWorld(force?: boolean): void;
        getWorldDirection(into: Vector3): Vector3;
        lookAt(x: number, y: number, z: number): void;
    }
}

declare module "three/addons/controls/OrbitControls.js" {
    import type { PerspectiveCamera, Vector3 } from "three";
    export class OrbitControls {
        target: Vector3;
        minDistance: number;
        maxDistance: number;
        zoomToCursor: boolean;
        constructor(camera: PerspectiveCamera, element: HTMLElement);
        addEventListener(name: "change" | "start" | "end", listener: () => void): void;
        update(): boolean;
        dispose(): void;
    }
}

declare module "*.glsl" {
    const source: string;
    export default source;
}

declare module "*.css";
