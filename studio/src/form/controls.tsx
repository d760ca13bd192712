// The controls of single values: number with slider, formula, three numbers, choice, switch, text.
import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import type { Setting } from "../server/types";
import { plain_default } from "./starters";
import { from_slider, inside, type Range, range_of, slider_steps, to_slider } from "./range";
import { use_typed } from "./typed";

export interface ControlProps {
    id: string;
    setting: Setting;
    /** Undefined: neither given nor known from the machine. */
    value: string | undefined;
    send: (value: string | null) => void;
    wrong: boolean;
    described_by: string | undefined;
}

const is_number = (text: string) => text.trim() !== "" && Number.isFinite(Number(text));

/** Attributes that all inputs of a field share. */
const common = ({ id, wrong, described_by }: ControlProps) => ({
    id,
    "aria-invalid": wrong || undefined,
    "aria-describedby": described_by,
});

/** The default for an empty field, when it is short enough. */
function hint(setting: Setting): string {
    const plain = plain_default(setting);
    return (
        plain ??
        (setting.default.length <= 12 && !setting.default.startsWith("required") ? setting.default : "")
    );
}

const send_text = (props: ControlProps) => (text: string) =>
    props.send(text.trim() === "" ? null : text.trim());

export function NumberControl(props: ControlProps) {
    const { setting, value, send } = props;
    const typed = use_typed(value ?? "", send_text(props));
    const range = useRef<Range | null>(null);
    const number = Number(value ?? plain_default(setting) ?? NaN);
    const allowed = number >= (setting.lo ?? -Infinity) && number <= (setting.hi ?? Infinity);
    if (!range.current || (allowed && !inside(range.current, number))) range.current = range_of(setting, number);
    const on = range.current;
    return (
        <div class="number">
            {on ? (
                <input
                    class="slider"
                    type="range"
                    min="0"
                    max={slider_steps}
                    step="1"
                    value={to_slider(on, number)}
                    aria-label={`${setting.key}, slider`}
                    aria-valuetext={`${number} ${setting.unit}`}
                    onInput={(event) => send(String(from_slider(on, event.currentTarget.valueAsNumber)))}
                />
            ) : (
                <span class="slider" />
            )}
            <input
                {...common(props)}
                class="number-text"
                inputMode="decimal"
                value={typed.shown}
                placeholder={hint(setting)}
                onInput={(event) => typed.input(event.currentTarget.value)}
                onBlur={typed.leave}
                onKeyDown={(event) => {
                    if (event.key === "Enter") typed.leave();
                    if (on && (event.key === "ArrowUp" || event.key === "ArrowDown")) {
                        event.preventDefault();
                        typed.leave();
                        const step = (event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 5 : 20);
                        send(
                            String(
                                from_slider(
                                    on,
                                    Math.max(0, Math.min(slider_steps, to_slider(on, number) + step)),
                                ),
                            ),
                        );
                    }
                }}
            />
            <span class="unit">{setting.unit}</span>
        </div>
    );
}

export function TextControl(props: ControlProps & { mono?: boolean }) {
    const typed = use_typed(props.value ?? "", send_text(props));
    return (
        <div class="text">
            <input
                {...common(props)}
                class={props.mono ? "mono" : ""}
                type="text"
                spellcheck={false}
                autocomplete="off"
                value={typed.shown}
                placeholder={hint(props.setting)}
                onInput={(event) => typed.input(event.currentTarget.value)}
                onBlur={typed.leave}
                onKeyDown={(event) => {
                    if (event.key === "Enter") typed.leave();
                }}
            />
            {props.setting.unit && <span class="unit">{props.setting.unit}</span>}
        </div>
    );
}

/** A number, or after `f` a formula. */
export function GradedControl(props: ControlProps) {
    const { value, setting } = props;
    const asked = useSignal(false);
    const formula = asked.value || (value !== undefined && !is_number(value));
    const toggle = () => {
        if (formula && value !== undefined && !is_number(value)) {
            const found = /-?[0-9]+(\.[0-9]+)?/.exec(value); // the number with which the formula begins
            props.send(found?.[0] ?? plain_default(setting));
        }
        asked.value = !formula;
    };
    return (
        <div class="graded">
            {formula ? <TextControl {...props} mono /> : <NumberControl {...props} />}
            <button
                class={`formula-button${formula ? " on" : ""}`}
                aria-pressed={formula}
                title={formula ? "Back to a number" : "Give a formula over x, y, z, d and gradings"}
                aria-label={`${setting.key} as a formula`}
                onClick={toggle}
            >
                f
            </button>
        </div>
    );
}

export function TripleControl(props: ControlProps) {
    const { setting, value, send } = props;
    const parts = (value ?? plain_default(setting) ?? "").split(",").map((one) => one.trim());
    const set = (k: number, text: string) => {
        const next = [0, 1, 2].map((i) => (i === k ? text.trim() : (parts[i] ?? "")));
        if (next.every((one) => one === "")) send(null);
        else send(next.map((one) => one || "0").join(","));
    };
    return (
        <div class="triple">
            {[0, 1, 2].map((k) => (
                <TripleInput key={k} props={props} k={k} value={parts[k] ?? ""} set={set} />
            ))}
            <span class="unit">{setting.unit}</span>
        </div>
    );
}

function TripleInput({
    props,
    k,
    value,
    set,
}: {
    props: ControlProps;
    k: number;
    value: string;
    set: (k: number, text: string) => void;
}) {
    const typed = use_typed(value, (text) => set(k, text));
    const shared = common(props);
    return (
        <input
            {...shared}
            id={k ? undefined : shared.id}
            inputMode="decimal"
            value={typed.shown}
            aria-label={`${props.setting.key} ${"xyz"[k]}`}
            placeholder={"xyz"[k]}
            onInput={(event) => typed.input(event.currentTarget.value)}
            onBlur={typed.leave}
            onKeyDown={(event) => {
                if (event.key === "Enter") typed.leave();
            }}
        />
    );
}

export function ChoiceControl(props: ControlProps) {
    const { setting, value, send } = props;
    const fallback = plain_default(setting);
    const unknown = value !== undefined && !setting.choices.includes(value);
    return (
        <select
            {...common(props)}
            value={value ?? fallback ?? ""}
            onChange={(event) => send(event.currentTarget.value)}
        >
            {value === undefined && !fallback && <option value="">{setting.default}</option>}
            {unknown && <option value={value}>{value}</option>}
            {setting.choices.map((word) => (
                <option key={word} value={word}>
                    {word}
                </option>
            ))}
        </select>
    );
}

export function BooleanControl(props: ControlProps) {
    const on = (props.value ?? plain_default(props.setting)) === "true";
    return (
        <div class="boolean">
            <input
                {...common(props)}
                type="checkbox"
                checked={on}
                onChange={(event) => props.send(String(event.currentTarget.checked))}
            />
        </div>
    );
}

export function LinesControl(props: ControlProps) {
    const typed = use_typed(props.value ?? "", send_text(props));
    return (
        <textarea
            {...common(props)}
            class="mono"
            rows={3}
            spellcheck={false}
            value={typed.shown}
            onInput={(event) => typed.input(event.currentTarget.value)}
            onBlur={typed.leave}
        />
    );
}
