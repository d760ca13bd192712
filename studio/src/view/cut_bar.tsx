// Chooses the cut: its axis, its place and its side.
import { PlaceButton } from "../place/menu";
import { job } from "../state/store";
import { Segments } from "../shell/segments";
import { type CutAxis, cut, cut_axis, cut_below, cut_share } from "./cut";
import { stage } from "./shown";

const choices: { word: CutAxis; label: string; title: string }[] = [
    { word: "none", label: "whole", title: "Show the whole part" },
    { word: "x", label: "x", title: "Cut across x" },
    { word: "y", label: "y", title: "Cut across y" },
    { word: "z", label: "z", title: "Cut across z" },
    { word: "layer", label: "layer", title: "Cut at the layer that is looked at" },
];

/** The side towards the eye is taken away. */
function choose(axis: CutAxis): void {
    cut_axis.value = axis;
    const at = "xy".indexOf(axis);
    const camera = stage.value?.orbit;
    if (at < 0 || !camera) {
        cut_below.value = false;
        return;
    }
    const eye =
        at === 0
            ? camera.camera.position.x - camera.controls.target.x
            : camera.camera.position.y - camera.controls.target.y;
    cut_below.value = eye < 0;
}

export function CutBar() {
    const made = job.value;
    if (!made) return null;
    const sliding = cut_axis.value !== "none" && cut_axis.value !== "layer";
    return (
        <div class="cut-bar">
            <span class="cut-name" id="cut-name">
                Cut
            </span>
            <Segments labelled_by="cut-name" choices={choices} value={cut_axis.value} choose={choose} />
            {sliding && (
                <>
                    <input
                        type="range"
                        min="0"
                        max="1"
                        step="0.002"
                        value={cut_share.value}
                        aria-label="Place of the cut"
                        aria-valuetext={`${cut.value.at.toFixed(2)} mm`}
                        onInput={(event) => {
                            cut_share.value = event.currentTarget.valueAsNumber;
                        }}
                    />
                    <output class="cut-at">{cut.value.at.toFixed(1)} mm</output>
                    <button
                        class="quiet"
                        title="Take the other side away"
                        onClick={() => {
                            cut_below.value = !cut_below.value;
                        }}
                    >
                        flip
                    </button>
                </>
            )}
            <PlaceButton />
        </div>
    );
}
