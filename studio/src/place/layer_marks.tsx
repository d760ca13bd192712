// Handles in the picture of the layer: those near its plane are bright. Dragging leaves the height as it is.
import type { Job } from "../server/types";
import { plane_of } from "../state/heights";
import { job, layer } from "../state/store";
import { current, pane, place_of } from "../layers/window";
import { chosen, type Handle, handles, move } from "./handles";
import { Mark, move_by_key } from "./mark";
import { to_job, to_recipe } from "./space";

function drag_to(made: Job, handle: Handle, x: number, y: number): void {
    const here = to_job(made, handle.at);
    const to = here && to_recipe(made, [...place_of(made, x, y), here[2]]);
    if (to) move(made, handle, to);
}

export function LayerMarks() {
    const made = job.value;
    if (!made?.axes) return null;
    const { x, y, scale } = current(made);
    const plane = plane_of(made, layer.value);
    const near = 0.02 * (made.bounds.hi[2] - made.bounds.lo[2]);
    return (
        <div class="marks">
            {handles.value.map((handle) => {
                const at = to_job(made, handle.at)!;
                const off = Math.abs(at[2] - plane);
                const reach = Math.sqrt(Math.max(0, handle.reach ** 2 - off ** 2));
                const shift = `translate(${pane.value.width / 2 + (at[0] - x) * scale}px, ${pane.value.height / 2 - (at[1] - y) * scale}px)`;
                return (
                    <Mark
                        key={handle.id}
                        handle={handle}
                        held={chosen.value === handle.id}
                        take={(element) => {
                            element?.style.setProperty("transform", shift);
                            element?.style.setProperty("--reach", `${reach * scale}px`);
                            element?.style.setProperty("opacity", off < Math.max(near, handle.reach) ? "1" : "0.35");
                        }}
                        drag={(px, py) => drag_to(made, handle, px, py)}
                        on_key={(event) => move_by_key(made, handle, event)}
                    />
                );
            })}
        </div>
    );
}
