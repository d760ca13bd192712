// Chooses what colours show, and says what they mean.
import { Segments } from "../shell/segments";
import type { Structure } from "../server/types";
import { choose_paint, paint_choice, paint_choices, type PaintChoice, type Scale, shown_paint } from "./paint";

const choices: { word: PaintChoice; label: string; title: string }[] = [
    { word: "plain", label: "plain", title: "One colour for the part" },
    { word: "structure", label: "structure", title: "Colours for skin, frame, solid regions, foam and supports" },
    { word: "modulus", label: "modulus", title: "Colours for Young's modulus of the foam" },
];

const names: Record<Structure, string> = {
    skin: "skin",
    frame: "frame",
    solid: "solid region",
    foam: "foam",
    body: "body",
    supports: "supports",
};

const shown = (mpa: number) => String(Number(mpa.toPrecision(3)));

function ModulusLegend({ scale }: { scale: Scale }) {
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

function StructureLegend({ parts }: { parts: Structure[] }) {
    return (
        <ul class="paint-legend structure">
            {parts.map((part) => (
                <li class="paint-key" key={part}>
                    <i class={`of-${part}`} aria-hidden="true" /> {names[part]}
                </li>
            ))}
        </ul>
    );
}

function Legend() {
    const paint = shown_paint.value;
    if (!paint) return null;
    return paint.of === "modulus" ? <ModulusLegend scale={paint.scale} /> : <StructureLegend parts={paint.parts} />;
}

export function PaintBar() {
    const there = paint_choices.value;
    if (there.length < 2) return null;
    return (
        <div class="paint-bar">
            <div class="paint-row">
                <span class="cut-name" id="paint-name">
                    Paint
                </span>
                <Segments
                    labelled_by="paint-name"
                    choices={choices.filter(({ word }) => there.includes(word))}
                    value={paint_choice.value}
                    choose={choose_paint}
                />
            </div>
            <Legend />
        </div>
    );
}
