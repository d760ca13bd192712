// The 3D view: the part, its cut, the layer that is looked at and the places of faults.
import { effect, untracked, useSignal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { faults, painted_box } from "../check/faults";
import { get_design } from "../server/analysis";
import { get_volume } from "../server/api";
import { after_layer } from "../layers/layer_first";
import { HandleCard } from "../place/card";
import { open_menu, PlaceMenu } from "../place/menu";
import { placing, put_thing } from "../place/things";
import { ViewMarks } from "../place/view_marks";
import { Latest } from "../server/latest";
import type { Job } from "../server/types";
import { layer_at, plane_of, slab_of } from "../state/heights";
import { building, job, layer, mistakes, needs_search, tab } from "../state/store";
import { dark } from "../shell/theme";
import { read_colours } from "./colours";
import { cut } from "./cut";
import { CutBar } from "./cut_bar";
import { DesignChip, SearchCard } from "./design_chip";
import { shown_design } from "./design";
import { FaultMarkers } from "./fault_markers";
import { Fallback } from "./fallback";
import { PaintBar } from "./paint_bar";
import { Stage } from "./stage";
import { shown_voxels, stage } from "./shown";
import { Triad } from "./triad";
import { read_volume } from "./volume";
import { watch_paint } from "./watch_paint";

/** Voxels along the longest side: first, and when nothing has changed for a while. */
const coarse = 64;
const fine = 160;
const idle = 400;

/** The first picture waits for nothing. */
const at_once: typeof after_layer = (_, act) => {
    act();
    return () => {};
};

function watch_volume(on: Stage): () => void {
    const latest = new Latest();
    let timer = 0;
    let call_off = () => {};
    const load = (made: Job, voxels: number) =>
        latest.run(async (signal) => {
            const volume = read_volume(await get_volume(made, voxels, signal));
            if (shown_design.value || (job.value?.job !== made.job && voxels === fine)) return;
            on.set_volume(volume);
            shown_voxels.value = on.voxels;
        });
    const load_design = (id: number) =>
        latest.run(async (signal) => {
            on.set_volume(read_volume(await get_design(id, signal)));
            shown_voxels.value = on.voxels;
        });
    const stop = effect(() => {
        const made = job.value;
        const design = shown_design.value;
        clearTimeout(timer);
        call_off();
        if (design) {
            load_design(design.id);
            return;
        }
        if (!made) return;
        call_off = untracked(() =>
            (on.voxels ? after_layer : at_once)(made, () => {
                load(made, coarse);
                timer = window.setTimeout(() => load(made, fine), idle);
            }),
        );
    });
    return () => {
        stop();
        call_off();
        latest.cancel();
        clearTimeout(timer);
    };
}

function watch_scene(on: Stage): () => void {
    return effect(() => {
        const made = job.value;
        void dark.value; // colours follow the theme
        const k = layer.value;
        if (shown_design.value) {
            on.set_scene({ cut: cut.value, layer_z: -1e9, layer_height: 0, colours: read_colours(), faults: [] });
        } else if (made) {
            on.set_scene({
                cut: cut.value,
                layer_z: plane_of(made, k),
                layer_height: slab_of(made, k).height,
                colours: read_colours(),
                faults: tab.value === "check" ? faults.value.map((one) => painted_box(made, one)) : [],
            });
        }
    });
}

/** A right click without a drag opens the menu of what can be put there. */
function watch_menu(on: Stage, frame: HTMLElement): () => void {
    let down: [number, number] | null = null;
    const press = (event: PointerEvent) => {
        down = event.button === 2 ? [event.clientX, event.clientY] : null;
    };
    const open = (event: MouseEvent) => {
        event.preventDefault();
        const still = !down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) <= 4;
        const box = frame.getBoundingClientRect();
        const by_key = event.button !== 2;
        const [x, y] = by_key
            ? [box.left + box.width / 2, box.top + box.height / 2]
            : [event.clientX, event.clientY];
        const place = still || by_key ? on.place_at(x - box.left, y - box.top) : null;
        if (place) open_menu(x, y, place);
    };
    frame.addEventListener("pointerdown", press);
    frame.addEventListener("contextmenu", open);
    return () => {
        frame.removeEventListener("pointerdown", press);
        frame.removeEventListener("contextmenu", open);
    };
}

/** A click, as opposed to a drag, goes to the layer of the place that was hit, or puts what waits there. */
function watch_clicks(on: Stage, frame: HTMLElement): () => void {
    let down: [number, number] | null = null;
    const press = (event: PointerEvent) => {
        down = event.button === 0 ? [event.clientX, event.clientY] : null;
    };
    const release = (event: PointerEvent) => {
        const made = job.value;
        if (!down || !made || shown_design.value || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
        const box = frame.getBoundingClientRect();
        const place = on.place_at(event.clientX - box.left, event.clientY - box.top);
        if (place && placing.value) put_thing(placing.value, place);
        else if (place) layer.value = layer_at(made, place[2] - made.z0);
    };
    frame.addEventListener("pointerdown", press);
    frame.addEventListener("pointerup", release);
    return () => {
        frame.removeEventListener("pointerdown", press);
        frame.removeEventListener("pointerup", release);
    };
}

/** What waits for its place goes to the middle of the view. */
function put_in_middle(on: Stage): void {
    const place = placing.value && on.place_at_middle();
    if (placing.value && place) put_thing(placing.value, place);
}

function on_key(on: Stage, event: KeyboardEvent): void {
    const fine_step = event.shiftKey ? 2 : 10;
    const moves: Record<string, () => void> = {
        ArrowLeft: () => on.orbit.turn(-fine_step, 0),
        ArrowRight: () => on.orbit.turn(fine_step, 0),
        ArrowUp: () => on.orbit.turn(0, fine_step),
        ArrowDown: () => on.orbit.turn(0, -fine_step),
        "+": () => on.orbit.zoom(0.85),
        "=": () => on.orbit.zoom(0.85),
        "-": () => on.orbit.zoom(1 / 0.85),
        Home: () => on.orbit.reset(),
        Escape: () => {
            placing.value = null;
        },
        Enter: () => put_in_middle(on),
    };
    const move = moves[event.key];
    if (!move || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move();
}

export function View() {
    const frame = useRef<HTMLDivElement>(null);
    const canvas = useRef<HTMLCanvasElement>(null);
    const webgl = useSignal(true);
    useEffect(() => {
        const on = new Stage(canvas.current!, frame.current!);
        stage.value = on;
        webgl.value = on.has_webgl;
        const stops = on.has_webgl
            ? [
                  watch_volume(on),
                  watch_scene(on),
                  watch_paint(on),
                  watch_clicks(on, frame.current!),
                  watch_menu(on, frame.current!),
              ]
            : [];
        return () => {
            for (const stop of stops) stop();
            on.dispose();
            stage.value = null;
        };
    }, []);
    return (
        <section class="view" aria-label="Part">
            <div
                class={`view-frame${placing.value ? " aiming" : ""}`}
                ref={frame}
                tabIndex={0}
                role="application"
                aria-label="3D view. Arrow keys turn the part, plus and minus zoom, Home shows all of it, Enter puts what waits for a place in the middle."
                onKeyDown={(event) => stage.value && on_key(stage.value, event)}
            >
                <canvas ref={canvas} aria-hidden="true" />
                {!webgl.value && <Fallback />}
            </div>
            {webgl.value && <ViewMarks />}
            {webgl.value && <FaultMarkers />}
            {webgl.value && <Triad />}
            {building.value && <div class="view-chip late">computing…</div>}
            {!building.value && mistakes.value.length > 0 && job.value && (
                <div class="view-chip">the recipe before its {mistakes.value.length > 1 ? "mistakes" : "mistake"}</div>
            )}
            <DesignChip />
            {needs_search.value && !shown_design.value && <SearchCard />}
            <PaintBar />
            <HandleCard />
            <CutBar />
            <PlaceMenu />
        </section>
    );
}
