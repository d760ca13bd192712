// Handles in the 3D view: drag one to move its place, or use the arrow keys.
import { useEffect, useRef } from "preact/hooks";
import type { Job, Triple } from "../server/types";
import { job } from "../state/store";
import { add_follower, stage } from "../view/shown";
import { chosen, type Handle, handles } from "./handles";
import { Mark, move_by_key } from "./mark";
import { move } from "./handles";
import { to_job, to_recipe } from "./space";

/** Follows the pointer at the depth of the handle. */
function drag_to(made: Job, handle: Handle, x: number, y: number): void {
    const on = stage.value;
    const here = to_job(made, handle.at);
    const there = on && here && on.place_beside(here, x, y);
    const to = there && to_recipe(made, there);
    if (to) move(made, handle, to);
}

export function ViewMarks() {
    const marks = useRef(new Map<string, HTMLElement>());
    const on = stage.value;
    const made = job.value;
    const list = made?.axes ? handles.value : [];
    useEffect(() => {
        if (!on || !made || !list.length) return;
        const stop = add_follower(() => {
            for (const handle of list) {
                const mark = marks.current.get(handle.id);
                const place = to_job(made, handle.at) as Triple;
                const at = on.on_screen(place);
                mark?.style.setProperty("visibility", at ? "visible" : "hidden");
                if (!mark || !at) continue;
                mark.style.setProperty("transform", `translate(${at[0]}px, ${at[1]}px)`);
                mark.style.setProperty("--reach", `${handle.reach * on.pixels_a_mm(place)}px`);
            }
        });
        on.invalidate();
        return stop;
    }, [on, made, list]);
    if (!made) return null;
    return (
        <div class="marks">
            {list.map((handle) => (
                <Mark
                    key={handle.id}
                    handle={handle}
                    held={chosen.value === handle.id}
                    take={(element) => {
                        if (element) marks.current.set(handle.id, element);
                        else marks.current.delete(handle.id);
                    }}
                    drag={(x, y) => drag_to(made, handle, x, y)}
                    on_key={(event) => move_by_key(made, handle, event)}
                />
            ))}
        </div>
    );
}
