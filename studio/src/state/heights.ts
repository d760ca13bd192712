// Heights of layers, from the runs of equal layers that a job names.
import type { Job } from "../server/types";

export interface Slab {
    /** Height of the layer's lower side over the bed, and its thickness, mm. */
    begin: number;
    height: number;
}

export function slab_of(job: Job, layer: number): Slab {
    let begin = 0;
    let left = layer;
    for (const [count, height] of job.layers.heights) {
        if (left < count) return { begin: begin + left * height, height };
        begin += count * height;
        left -= count;
    }
    return { begin, height: job.layers.heights.at(-1)?.[1] ?? 0 };
}

/** The plane in which a layer is cut, mm in the space of the job. */
export function plane_of(job: Job, layer: number): number {
    const { begin, height } = slab_of(job, layer);
    return job.z0 + begin + height / 2;
}

/** The layer at a height over the bed, mm. */
export function layer_at(job: Job, over_bed: number): number {
    let begin = 0;
    let first = 0;
    for (const [count, height] of job.layers.heights) {
        const end = begin + count * height;
        if (over_bed < end) return clamp_layer(job, first + Math.floor((over_bed - begin) / height));
        begin = end;
        first += count;
    }
    return job.layers.count - 1;
}

export function clamp_layer(job: Job, layer: number): number {
    return Math.max(0, Math.min(job.layers.count - 1, Math.round(layer)));
}
