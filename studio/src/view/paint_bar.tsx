// Chooses what colours show, and says what they mean.
import { Segments } from "../shell/segments";
import type { Structure } from "../server/types";
import {
    choose_number,
    choose_paint,
    type NumberPaint,
    paint_choice,
    paint_choices,
    paint_number,
    type PaintChoice,
    type Scale,
    shown_paint,
} from "./paint";
import { job } from "../state/store";

const choices: { word: PaintChoice; label: string; title: string }[] = [
    { word: "plain", label: "plain", title: "One colour for the part" },
    { word: "structure", label: "structure", title: "Colours for skin, frame, solid regions, foam and supports" },
    { word: "modulus", label: "modulus", title: "Colours for Young's modulus of the foam" },
    { word: "number", label: "number", title: "Colours for a number that varies, such as the size of the cells" },
];

const names: Record<Structure, string> = {
    skin: "skin",
    frame: "frame",
    solid: "solid region",
    foam: "foam",
    body: "body",
    supports: "supports",
};

const shown = (value: number) => String(Number(value.toPrecision(3)));

function Ends({ values, unit }: { values: number[]; unit: string }) {
    return (
        <>
            <div class="paint-scale" aria-hidden="true" />
            <div class="paint-ends">
                {values.map((value, i) => (
                    <span key={i}>
                        {shown(value)}
                        {i === values.length - 1 && unit && ` ${unit}`}
                    </span>
                ))}
            </div>
        </>
    );
}

function ModulusLegend({ scale }: { scale: Scale }) {
    const middle = Math.sqrt(scale.lo_mpa * scale.hi_mpa);
    return (
        <div class="paint-legend">
            <Ends values={[scale.lo_mpa, middle, scale.hi_mpa]} unit="MPa" />
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

function NumberChoice() {
    return (
        <select
            class="paint-number"
            aria-label="Number that is painted"
            value={paint_number.value}
            onChange={(event) => choose_number(event.currentTarget.value)}
        >
            {(job.value?.numbers ?? []).map(({ name }) => (
                <option key={name} value={name}>
                    {name}
                </option>
            ))}
        </select>
    );
}

function NumberLegend({ scale }: { scale: NumberPaint["scale"] }) {
    const { lo, hi, unit } = scale;
    return (
        <div class="paint-legend">
            <Ends values={lo === hi ? [hi] : [lo, (lo + hi) / 2, hi]} unit={unit} />
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
    if (paint.of === "structure") return <StructureLegend parts={paint.parts} />;
    return paint.of === "modulus" ? <ModulusLegend scale={paint.scale} /> : <NumberLegend scale={paint.scale} />;
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
            {paint_choice.value === "number" && <NumberChoice />}
            <Legend />
        </div>
    );
}
