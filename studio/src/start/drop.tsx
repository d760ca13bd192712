// Files may be dropped anywhere on the page.
import { signal } from "@preact/signals";
import { starting } from "../state/store";
import { take_files } from "./take_model";

const dragging = signal(false);

export function listen_to_drops(): void {
    let depth = 0;
    const has_files = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    addEventListener("dragenter", (event) => {
        if (!has_files(event)) return;
        ++depth;
        dragging.value = true;
    });
    addEventListener("dragleave", () => {
        depth = Math.max(0, depth - 1);
        if (!depth) dragging.value = false;
    });
    addEventListener("dragover", (event) => {
        if (has_files(event)) event.preventDefault();
    });
    addEventListener("drop", (event) => {
        if (!has_files(event)) return;
        event.preventDefault();
        depth = 0;
        dragging.value = false;
        void take_files(event.dataTransfer!.files);
    });
}

export function DropShade() {
    if (!dragging.value) return null;
    return (
        <div class="drop-shade">
            <p>
                {starting.value
                    ? "Drop the model to begin a recipe"
                    : "Drop a model to make it the part of this recipe, or a picture to make it the pattern of its skin"}
            </p>
        </div>
    );
}
