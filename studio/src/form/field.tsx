// One field of the form: its name, its control, a button that takes it away, and its mistakes.
import type { FunctionComponent } from "preact";
import type { Setting, SettingType } from "../server/types";
import { pending, place_of } from "../state/recipe";
import { machines, values } from "../state/store";
import {
    BooleanControl,
    ChoiceControl,
    type ControlProps,
    GradedControl,
    LinesControl,
    NumberControl,
    TextControl,
    TripleControl,
} from "./controls";
import { set_key, type Spot } from "./changes";
import { helped } from "./help";
import { PathControl } from "./path_control";
import { mistakes_at } from "./places";
import { RowsControl } from "./rows_curve";

const controls: Record<SettingType, FunctionComponent<ControlProps>> = {
    boolean: BooleanControl,
    integer: NumberControl,
    number: NumberControl,
    text: TextControl,
    lines: LinesControl,
    path: PathControl,
    choice: ChoiceControl,
    triple: TripleControl,
    graded: GradedControl,
    graded_triple: (props) => <TextControl {...props} mono />,
    formula: (props) => <TextControl {...props} mono />,
    rows: RowsControl,
};

/** The machine's name is a text that the server knows the words of. */
function control_of(setting: Setting): FunctionComponent<ControlProps> {
    return setting.section === "printer" && setting.key === "profile"
        ? ProfileControl
        : controls[setting.type];
}

function ProfileControl(props: ControlProps) {
    const choices = machines.value.map((one) => one.name);
    return <ChoiceControl {...props} setting={{ ...props.setting, type: "choice", choices }} />;
}

interface FieldProps {
    setting: Setting;
    spot: Spot;
    /** Beside the view, where the form may show the same field. */
    in_card?: boolean;
}

export function Field({ setting, spot, in_card }: FieldProps) {
    const index = spot.index ?? 0;
    const { section, key } = setting;
    const place = place_of(section, index, key);
    const name = `${section}.${key}`;
    const known =
        spot.index === undefined ? values.value.values[name] : values.value.lists[section]?.[index]?.[key];
    const guess = pending.value[place];
    const value = guess === undefined ? known : (guess ?? undefined);
    const in_text = spot.index === undefined ? values.value.given.includes(name) : known !== undefined;
    const given = guess === undefined ? in_text : guess !== null;
    const wrong = mistakes_at(section, index, key);
    const id = `${in_card ? "card" : "field"}-${place.replaceAll(".", "-")}`;
    const Control = control_of(setting);
    const show_help = () => {
        helped.value = setting;
    };
    return (
        <div
            class={`field type-${setting.type} key-${key}${given ? " given" : ""}${wrong.length ? " wrong" : ""}`}
            onFocusCapture={show_help}
            onPointerEnter={show_help}
        >
            <label for={id} title={setting.help}>
                {key}
            </label>
            <Control
                id={id}
                setting={setting}
                value={value}
                wrong={wrong.length > 0}
                described_by={wrong.length ? `${id}-wrong` : undefined}
                send={(next) => set_key(spot, setting, next)}
            />
            {given ? (
                <button
                    class="reset"
                    title={`Remove ${key}: ${setting.default}`}
                    aria-label={`Remove ${key}`}
                    onClick={() => set_key(spot, setting, null)}
                >
                    ×
                </button>
            ) : (
                <span class="reset" />
            )}
            {wrong.length > 0 && (
                <div class="field-mistakes" id={`${id}-wrong`} role="alert">
                    {wrong.map((one) => (
                        <p key={one.text}>{one.text.replace(`${name}: `, "")}</p>
                    ))}
                </div>
            )}
        </div>
    );
}
