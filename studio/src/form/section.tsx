// A section of the form, plain or as the entry of a list.
import { useSignal } from "@preact/signals";
import type { Section, Setting } from "../server/types";
import { table, values } from "../state/store";
import { applies, chosen_kind, fits_body, kind_key, needed, settings_of } from "./applies";
import { add_entry, add_section, given_at, remove, type Spot } from "./changes";
import { Field } from "./field";
import { all_keys, matches, search } from "./filter";
import { placed_mistakes, present } from "./places";
import { essentials, fixed_sections } from "./starters";

/** The settings to show, and how many more apply. */
function visible(spot: Spot, more: boolean): { shown: Setting[]; hidden: number } {
    const { section } = spot;
    const known = settings_of(table.value, section);
    if (search.value) return { shown: known.filter(matches), hidden: 0 };
    if (all_keys.value) return { shown: known, hidden: 0 };
    const given = given_at(spot);
    const kind = chosen_kind(table.value, section, given);
    const wrong = placed_mistakes.value.filter(
        (one) => one.section === section && one.index === (spot.index ?? 0),
    );
    const fitting = known.filter(
        ({ key }) =>
            applies(table.value, section, key, kind) && (section !== "part" || fits_body(key, given)),
    );
    const wanted = new Set([
        ...Object.keys(given),
        ...essentials(table.value, section),
        ...needed(table.value, section, kind, given),
        kind_key(table.value, section)?.key ?? "",
    ]);
    const short = fitting.filter(({ key }) => wanted.has(key));
    const stray = known.filter(
        (one) => !fitting.includes(one) && (one.key in given || wrong.some(({ key }) => key === one.key)),
    );
    const shown = [...(more ? fitting : short), ...stray];
    return { shown, hidden: fitting.length - short.length };
}

function Fields({ spot }: { spot: Spot }) {
    const more = useSignal(false);
    const { shown, hidden } = visible(spot, more.value);
    return (
        <div class="fields">
            {shown.map((setting) => (
                <Field key={setting.key} setting={setting} spot={spot} />
            ))}
            {hidden > 0 && (
                <button
                    class="more quiet"
                    aria-expanded={more.value}
                    onClick={() => {
                        more.value = !more.value;
                    }}
                >
                    {more.value ? "fewer keys" : `${hidden} more keys`}
                </button>
            )}
        </div>
    );
}

export function PlainSection({ section }: { section: Section }) {
    const { name } = section;
    const here = present.value.has(name) || fixed_sections.includes(name);
    const open = useSignal(true);
    const unfolded = here && (open.value || search.value !== "");
    return (
        <section class={`form-section${here ? "" : " absent"}`} aria-label={name}>
            <header>
                <h2>
                    <button
                        class="fold"
                        aria-expanded={unfolded}
                        disabled={!here}
                        title={section.help}
                        onClick={() => {
                            open.value = !open.value;
                        }}
                    >
                        {name}
                    </button>
                </h2>
                {fixed_sections.includes(name) ? null : here ? (
                    <button
                        class="quiet"
                        aria-label={`Remove ${name}`}
                        onClick={() => remove({ section: name })}
                    >
                        remove
                    </button>
                ) : (
                    <button
                        class="quiet"
                        aria-label={`Add ${name}`}
                        title={section.help}
                        onClick={() => add_section(name)}
                    >
                        add
                    </button>
                )}
            </header>
            {unfolded && <Fields spot={{ section: name }} />}
        </section>
    );
}

export function ListSection({ section }: { section: Section }) {
    const { name } = section;
    const entries = values.value.lists[name] ?? [];
    return (
        <section class="form-section list" aria-label={name}>
            <header>
                <h2 title={section.help}>
                    {name} <span class="count">{entries.length}</span>
                </h2>
                <button class="quiet" aria-label={`Add another ${name}`} onClick={() => add_entry(name)}>
                    add
                </button>
            </header>
            {entries.map((entry, index) => (
                <div class="card" key={index}>
                    <header>
                        <h3>{entry.name ?? entry.field ?? `${name} ${index + 1}`}</h3>
                        <button
                            class="quiet"
                            aria-label={`Remove ${name} ${index + 1}`}
                            onClick={() => remove({ section: name, index })}
                        >
                            remove
                        </button>
                    </header>
                    <Fields spot={{ section: name, index }} />
                </div>
            ))}
        </section>
    );
}
