// Chooses what colours show, and says what they mean.
import { Segments } from "../shell/segments";
import { can_paint, paint_choice, shown_scale, type PaintChoice } from "./paint";

const choices: { word: PaintChoice; label: string; title: string }[] = [
    { word: "plain", label: "plain", title: "One colour for the part" },
    { word: "modulus", label: "modulus", title: "Colours for Young's modulus of the foam" },
];

const shown = (mpa: number) => String(Number(mpa.toPrecision(3)));

function Legend() {
    const scale = shown_scale.value;
    if (!scale) return null;
    const middle = Math.sqrt(scale.lo_mpa * scale.hi_mpa);
    return (
        <div class="paint-legend">
            <div class="paint-scale" aria-hidden="true" />
            <div class="paint-ends">
                <span>{shown(scale.lo_mpa)}</span>
                <span>{shown(middle)}</span>
                <span>{shown(scale.hi_mpa)} MPa</span>
            </div>
            {scale.is_asked && (
                <>
                    <div class="paint-key">
                        <i class="softer" aria-hidden="true" /> softer than asked
                    </div>
                    <div class="paint-key">
                        <i class="stiffer" aria-hidden="true" /> stiffer than asked
                    </div>
                </>
            )}
        </div>
    );
}

export function PaintBar() {
    if (!can_paint.value) return null;
    return (
        <div class="paint-bar">
            <div class="paint-row">
                <span class="cut-name" id="paint-name">
                    Paint
                </span>
                <Segments
                    labelled_by="paint-name"
                    choices={choices}
                    value={paint_choice.value}
                    choose={(word) => {
                        paint_choice.value = word;
                    }}
                />
            </div>
            {paint_choice.value === "modulus" && <Legend />}
        </div>
    );
}
