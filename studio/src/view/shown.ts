// The stage that is mounted, and what it shows.
import { signal } from "@preact/signals";
import type { Stage } from "./stage";

export const stage = signal<Stage | null>(null);
/** Voxels along the longest side of the volume that is shown; 0: none yet. */
export const shown_voxels = signal(0);

const followers = new Set<() => void>();

/** Calls after each frame of the stage that is mounted. */
export function add_follower(follow: () => void): () => void {
    followers.add(follow);
    if (stage.value) {
        stage.value.after_frame = () => {
            for (const one of followers) one();
        };
        stage.value.invalidate();
    }
    return () => {
        followers.delete(follow);
    };
}
