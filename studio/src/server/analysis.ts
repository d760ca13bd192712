// Analyses: requests and replies about the stiffness of a part.
import { get_bytes, get_json } from "./http";
import { session } from "./token";
import type { Job, Triple } from "./types";

export interface Step {
    appearance: number;
    compliance: number;
    volume: number;
    greyness: number;
    change: number;
}

/** What events say of an analysis. */
export interface News {
    analysis: number;
    kind: "homogenize" | "optimize";
    state: "waiting" | "running" | "done" | "failed" | "cancelled";
    share: number;
    /** Steps so far, and at most. */
    count: number;
    most: number;
    step: Step | null;
    /** Designs so far that can be fetched. */
    designs: number;
    message: string;
}

export interface Sample {
    density: number;
    E: number;
    nu: number;
}

/** Moduli in MPa, or in the solid's where no material is given. */
export interface Stiffness {
    foam: string;
    period_mm: number;
    elements: number;
    material: { E: number; nu: number };
    density: number;
    E: number;
    nu: number;
    G: number;
    K: number;
    anisotropy: number;
    E_least: number;
    E_greatest: number;
    E_hashin_shtrikman: number;
    samples: Sample[];
    /** Rings from +z to -z; `young` has the moduli round z, from +x on, of one ring after the other. */
    directions: { polar: number; around: number; young: number[] };
    /** Moduli relative to the solid's. */
    law: { ratio: number; density: number; young: number; poisson: number; spread: number }[] | null;
}

export interface LoadCase {
    case: string;
    largest_displacement_mm: number;
    displacement_at_mm: Triple;
    peak_von_mises_mpa: number;
}

export interface Design {
    elements: number;
    grid: Triple;
    young_mpa: number;
    material_is_assumed: boolean;
    full_compliance_nmm: number;
    compliance_nmm: number;
    compliance_bound_of_full: number;
    volume: number;
    volume_bound: number;
    mass_g: number;
    stray_pieces: number;
    converged: boolean;
    cases: LoadCase[];
    notes: string[];
}

export interface Analysis extends News {
    steps: Step[];
    result: Stiffness | Design | null;
}

export const start_homogenize = (job: Job, rve: number, samples: number) =>
    get_json<Analysis>(`/api/jobs/${job.job}/homogenize`, { method: "POST", json: { rve, samples, session } });

export const start_optimize = (text: string, resume: boolean) =>
    get_json<Analysis>("/api/optimize", { method: "POST", json: { text, resume, session } });

export const get_analysis = (id: number) => get_json<Analysis>(`/api/analyses/${id}`);

export const stop_analysis = (id: number) =>
    get_json<Analysis>(`/api/analyses/${id}/stop`, { method: "POST", json: {} });

export const get_design = (id: number, signal: AbortSignal) =>
    get_bytes(`/api/analyses/${id}/volume`, { signal });

export const get_structure = (job: Job, voxels: number, signal: AbortSignal) =>
    get_bytes(`/api/jobs/${job.job}/structure?n=${voxels}&session=${session}`, { signal });

export const get_numbers = (job: Job, of: string, voxels: number, signal: AbortSignal) =>
    get_bytes(`/api/jobs/${job.job}/numbers?of=${encodeURIComponent(of)}&n=${voxels}&session=${session}`, { signal });

export const get_modulus = (job: Job, voxels: number, signal: AbortSignal) =>
    get_bytes(`/api/jobs/${job.job}/modulus?n=${voxels}&session=${session}`, { signal });
