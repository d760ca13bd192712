// Red rings at the places of faults; a click goes there.
import { useEffect, useRef } from "preact/hooks";
import { tab } from "../state/store";
import { type Fault, faults, go_to_fault, shown_fault } from "../check/faults";
import { add_follower, stage } from "./shown";

export function FaultMarkers() {
    const marks = useRef(new Map<Fault, HTMLButtonElement>());
    const on = stage.value;
    const list = tab.value === "check" ? faults.value : [];
    useEffect(() => {
        if (!on || !list.length) return;
        return add_follower(() => {
            for (const [fault, mark] of marks.current) {
                const at = on.on_screen(fault.place.at_mm);
                mark.style.setProperty("visibility", at ? "visible" : "hidden");
                if (at) mark.style.setProperty("transform", `translate(${at[0] - 8}px, ${at[1] - 8}px)`);
            }
        });
    }, [on, list]);
    return (
        <div class="fault-markers">
            {list.map((fault) => (
                <button
                    key={fault.name}
                    tabIndex={-1}
                    title={fault.name}
                    class={`fault-marker ${fault.verdict}${fault === shown_fault.value ? " chosen" : ""}`}
                    aria-label={`Go to ${fault.name}`}
                    onClick={() => go_to_fault(fault)}
                    ref={(mark) => {
                        if (mark) marks.current.set(fault, mark);
                        else marks.current.delete(fault);
                    }}
                />
            ))}
        </div>
    );
}
