// What the layer pane shows at the moment.
import { signal } from "@preact/signals";
import type { Lines } from "./draw";
import type { Picture } from "./mask";

export const lines = signal<Lines | null>(null);
/** The picture that is shown; null when lines are. */
export const picture = signal<Picture | null>(null);
