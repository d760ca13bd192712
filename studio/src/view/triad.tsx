// The axes in the corner of the view: they turn with it, and a click looks along one.
import { useEffect, useRef } from "preact/hooks";
import { add_follower, stage } from "./shown";

const names = ["x", "y", "z"] as const;
const radius = 26;
const middle = 36;

export function Triad() {
    const marks = useRef<(HTMLButtonElement | null)[]>([]);
    const lines = useRef<(SVGLineElement | null)[]>([]);
    const on = stage.value;
    useEffect(() => {
        if (!on) return;
        const follow = () => {
            const m = on.orbit.camera.matrixWorld.elements;
            names.forEach((_, k) => {
                // a row of the camera's matrix is an axis as the camera sees it
                const x = middle + radius * m[k]!,
                    y = middle - radius * m[4 + k]!;
                marks.current[k]?.style.setProperty("transform", `translate(${x - 9}px, ${y - 9}px)`);
                marks.current[k]?.style.setProperty("z-index", m[8 + k]! > 0 ? "2" : "1");
                lines.current[k]?.setAttribute("x2", String(x));
                lines.current[k]?.setAttribute("y2", String(y));
            });
        };
        return add_follower(follow);
    }, [on]);
    return (
        <div class="triad" role="group" aria-label="Look along an axis">
            <svg width="72" height="72" aria-hidden="true">
                {names.map((name, k) => (
                    <line
                        key={name}
                        class={`axis-${name}`}
                        x1={middle}
                        y1={middle}
                        x2={middle}
                        y2={middle}
                        ref={(line) => {
                            lines.current[k] = line;
                        }}
                    />
                ))}
            </svg>
            {names.map((name, k) => (
                <button
                    key={name}
                    class={`axis-${name}`}
                    title={`Look along ${name}`}
                    aria-label={`Look along ${name}`}
                    ref={(mark) => {
                        marks.current[k] = mark;
                    }}
                    onClick={() => stage.value?.orbit.look_along(k)}
                >
                    {name}
                </button>
            ))}
            <button
                class="fit quiet"
                title="Show the whole part (Home)"
                onClick={() => stage.value?.orbit.reset()}
            >
                fit
            </button>
        </div>
    );
}
