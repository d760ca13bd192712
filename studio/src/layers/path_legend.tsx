// Chooses what the colours of toolpaths show, and says what they mean.
import { Segments } from "../shell/segments";
import { scale_gradient } from "../shell/colour_scale";
import { travel_colours } from "./draw_paths";
import { path_colour, path_range, type PathColour, shows_travel } from "./path_look";
import { role_colour } from "./roles";
import { lines } from "./shown_layer";

const choices: { word: PathColour; label: string; title: string }[] = [
    { word: "role", label: "role", title: "Colours for walls, infill, supports and more" },
    { word: "speed", label: "speed", title: "Colours for the speed that the G-code states" },
    { word: "width", label: "width", title: "Colours for the width of the bead" },
];

export function PathChoice() {
    return (
        <div class="path-choice">
            <span class="soft" id="path-colours">
                Colours
            </span>
            <Segments
                labelled_by="path-colours"
                choices={choices}
                value={path_colour.value}
                choose={(word) => {
                    path_colour.value = word;
                }}
            />
            <label class="travel-choice" title="Moves between the paths: dashed where the filament is retracted">
                <input
                    type="checkbox"
                    checked={shows_travel.value}
                    onChange={(event) => {
                        shows_travel.value = event.currentTarget.checked;
                    }}
                />
                travel
            </label>
        </div>
    );
}

function Roles() {
    const roles = [...new Set(lines.value?.paths?.paths.map((one) => one.role) ?? [])];
    return (
        <>
            {roles.map((role) => (
                <li key={role}>
                    <i style={{ background: role_colour(role) }} />
                    {role}
                </li>
            ))}
        </>
    );
}

function Travels() {
    const travels = lines.value?.paths?.travels ?? [];
    const kinds = [
        { word: "stays", label: "travel", there: travels.some((one) => !one.retracts) },
        { word: "retracts", label: "travel, retracted", there: travels.some((one) => one.retracts) },
    ] as const;
    return (
        <>
            {kinds
                .filter((kind) => kind.there)
                .map(({ word, label }) => (
                    <li key={word}>
                        <i class={`dashes ${word}`} style={{ color: travel_colours[word] }} />
                        {label}
                    </li>
                ))}
        </>
    );
}

const in_speed = (value: number) => `${+value.toFixed(1)}`;
const in_width = (value: number) => value.toFixed(2);

function Scale() {
    const range = path_range.value;
    if (!range) return null;
    const { lo, hi } = range;
    const is_speed = path_colour.value === "speed";
    const number = is_speed ? in_speed : in_width;
    const ends = number(lo) === number(hi) ? [hi] : [lo, (lo + hi) / 2, hi];
    const unit = is_speed ? "mm/s" : "mm";
    return (
        <li class="path-scale">
            <span>{is_speed ? "speed" : "width"}</span>
            <div>
                <div class="path-colours" style={{ background: scale_gradient }} aria-hidden="true" />
                <div class="paint-ends">
                    {ends.map((value, i) => (
                        <span key={i}>
                            {number(value)}
                            {i === ends.length - 1 && ` ${unit}`}
                        </span>
                    ))}
                </div>
            </div>
            {is_speed && (
                <span class="soft" title="As the G-code states it, mm/min">
                    {[...new Set([lo, hi].map((value) => `F${Math.round(60 * value)}`))].join(" – ")}
                </span>
            )}
        </li>
    );
}

export function PathLegend() {
    if (!lines.value?.paths?.paths.length) return null;
    return (
        <ul class="legend" aria-label="Colours of the paths">
            {path_colour.value === "role" ? <Roles /> : <Scale />}
            {shows_travel.value && <Travels />}
        </ul>
    );
}
