// The scrubber: a slider over all layers with marks where faults are. Shift is fine, the wheel nudges.
import { useEffect, useRef } from "preact/hooks";
import { faults } from "../check/faults";
import type { Job } from "../server/types";
import { clamp_layer, slab_of } from "../state/heights";
import { layer } from "../state/store";

function go(made: Job, to: number): void {
    layer.value = clamp_layer(made, to);
}

/** A coarse step: a hundredth of all layers. */
const leap = (made: Job) => Math.max(1, Math.round(made.layers.count / 100));

function on_key(made: Job, event: KeyboardEvent): void {
    const step = event.shiftKey ? 1 : leap(made);
    const to: Record<string, number> = {
        ArrowRight: layer.value + 1,
        ArrowUp: layer.value + 1,
        ArrowLeft: layer.value - 1,
        ArrowDown: layer.value - 1,
        PageUp: layer.value + 10 * step,
        PageDown: layer.value - 10 * step,
        Home: 0,
        End: made.layers.count - 1,
    };
    const wanted = to[event.key];
    if (wanted === undefined) return;
    event.preventDefault();
    go(made, wanted);
}

export function on_wheel(made: Job, event: WheelEvent): void {
    event.preventDefault();
    // With Shift some browsers turn the wheel sideways.
    const turned = event.deltaY || event.deltaX;
    go(made, layer.value - Math.sign(turned) * (event.shiftKey ? 1 : leap(made)));
}

export function Scrubber({ made }: { made: Job }) {
    const track = useRef<HTMLDivElement>(null);
    const held = useRef<{ x: number; layer: number } | null>(null);
    const last = made.layers.count - 1;
    const share = last ? layer.value / last : 0;
    const { begin, height } = slab_of(made, layer.value);

    useEffect(() => {
        const wheel = (event: WheelEvent) => on_wheel(made, event);
        track.current!.addEventListener("wheel", wheel, { passive: false });
        return () => track.current?.removeEventListener("wheel", wheel);
    }, [made]);

    const at_pointer = (event: PointerEvent) => {
        const box = track.current!.getBoundingClientRect();
        return Math.max(0, Math.min(1, (event.clientX - box.left) / box.width)) * last;
    };
    const press = (event: PointerEvent) => {
        track.current!.setPointerCapture(event.pointerId);
        if (!event.shiftKey) go(made, at_pointer(event));
        held.current = { x: event.clientX, layer: layer.value };
    };
    const drag = (event: PointerEvent) => {
        if (!held.current) return;
        if (!event.shiftKey) {
            go(made, at_pointer(event));
            held.current = { x: event.clientX, layer: layer.value };
        } else {
            // four pixels a layer, from where the fine movement began
            go(made, held.current.layer + Math.round((event.clientX - held.current.x) / 4));
        }
    };
    const release = () => {
        held.current = null;
    };

    return (
        <div
            class="scrubber"
            ref={track}
            role="slider"
            tabIndex={0}
            aria-label="Layer"
            aria-valuemin={1}
            aria-valuemax={last + 1}
            aria-valuenow={layer.value + 1}
            aria-valuetext={`layer ${layer.value + 1} of ${last + 1}, ${(begin + height).toFixed(2)} mm`}
            title="Drag, turn the wheel or use the arrow keys; Shift is fine"
            onKeyDown={(event) => on_key(made, event)}
            onPointerDown={press}
            onPointerMove={drag}
            onPointerUp={release}
            onPointerCancel={release}
        >
            <div class="scrubber-track">
                <div class="scrubber-fill" style={{ width: `${share * 100}%` }} />
                {faults.value.map((fault) => (
                    <div
                        key={fault.name}
                        class={`scrubber-mark ${fault.verdict}`}
                        style={{ left: `${last ? (fault.place.layer / last) * 100 : 0}%` }}
                    />
                ))}
                <div class="scrubber-thumb" style={{ left: `${share * 100}%` }} />
            </div>
        </div>
    );
}
