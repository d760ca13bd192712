// The help of the field that is used or pointed at, in one place: the form does not jump.
import { signal } from "@preact/signals";
import type { Setting } from "../server/types";

export const helped = signal<Setting | null>(null);

const words: Record<string, string> = {
    boolean: "true or false",
    text: "a text",
    lines: "lines of text",
    path: "a file",
    formula: "a formula",
    rows: "rows of numbers",
};

/** What a setting accepts, in words. */
export function accepted(setting: Setting): string {
    if (setting.choices.length) return setting.choices.join(", ");
    const word = words[setting.type];
    const { lo, hi, unit } = setting;
    if (lo === null || hi === null) return word ?? "";
    const range = `${lo} to ${hi}${unit ? ` ${unit}` : ""}`;
    const formula = setting.type.startsWith("graded") ? ", or a formula" : "";
    return `${word ? `${word}, ` : ""}${range}${formula}`;
}

export function HelpStrip() {
    const setting = helped.value;
    return (
        <aside class="help-strip" aria-label="Help">
            {setting ? (
                <>
                    <p>
                        <code>
                            {setting.section}.{setting.key}
                        </code>{" "}
                        {setting.help}
                    </p>
                    <p class="soft">
                        Accepts {accepted(setting)}. Default: {setting.default}.
                    </p>
                </>
            ) : (
                <p class="soft">Point at a field for its help.</p>
            )}
        </aside>
    );
}
