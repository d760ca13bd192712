// Pictures drawn by the server, for browsers without WebGL2.
import { effect, useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { get_frame } from "../server/api";
import { Latest } from "../server/latest";
import { job } from "../state/store";
import { cut_axis, cut_share } from "./cut";
import { paint_choice } from "./paint";
import { stage } from "./shown";

const width = 640;

export function Fallback() {
    const picture = useSignal("");
    useEffect(() => {
        const latest = new Latest();
        const ask = () => {
            const made = job.value;
            const on = stage.value;
            const axis = cut_axis.value;
            const share = cut_share.value;
            const paint = paint_choice.value === "modulus" ? "modulus" : "none"; // the server paints by nothing else
            if (!made || !on) return;
            const rest = { cut: "xyz".includes(axis) ? axis : "-", cut_at: share };
            latest.run(async (signal) => {
                const { azimuth, elevation } = on.orbit.angles();
                const view = {
                    width,
                    azimuth: Math.round(azimuth),
                    elevation: Math.round(elevation),
                    ...rest,
                    paint,
                };
                const url = URL.createObjectURL(await get_frame(made, view, signal));
                if (picture.value) URL.revokeObjectURL(picture.value);
                picture.value = url;
            });
        };
        stage.value?.orbit.controls.addEventListener("end", ask);
        const stop = effect(ask);
        return () => {
            stop();
            latest.cancel();
            URL.revokeObjectURL(picture.value);
        };
    }, []);
    return picture.value ? (
        <img class="view-picture" src={picture.value} alt="The part, drawn by the server" />
    ) : null;
}
