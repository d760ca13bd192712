// The form: all sections of the recipe that it has, and those that it may get.
import { MistakeList } from "../shell/mistake_list";
import { table, values } from "../state/store";
import { settings_of } from "./applies";
import { add_entry, add_section } from "./changes";
import { all_keys, matches, search, search_text } from "./filter";
import { HelpStrip } from "./help";
import { other_mistakes, present } from "./places";
import { ListSection, PlainSection } from "./section";
import { main_sections } from "./starters";

function Sections() {
    const { sections } = table.value;
    const rank = (name: string) => main_sections.indexOf(name) + 1 || 100;
    const ordered = [...sections].sort((a, b) => rank(a.name) - rank(b.name));
    const found = (name: string) => settings_of(table.value, name).some(matches);
    const here = (name: string) => present.value.has(name) || (values.value.lists[name]?.length ?? 0) > 0;
    const shown = ordered.filter(({ name, list }) => {
        if (search.value) return found(name) && (!list || here(name));
        return here(name) || main_sections.includes(name);
    });
    const others = ordered.filter(
        ({ name }) => !shown.some((one) => one.name === name) && !(search.value && !found(name)),
    );
    return (
        <>
            {shown.map((section) =>
                section.list ? (
                    <ListSection key={section.name} section={section} />
                ) : (
                    <PlainSection key={section.name} section={section} />
                ),
            )}
            {others.length > 0 && (
                <section class="form-section adders" aria-label="Other sections">
                    <header>
                        <h2>Add to the recipe</h2>
                    </header>
                    <div class="chips">
                        {others.map(({ name, help, list }) => (
                            <button
                                key={name}
                                title={help}
                                onClick={() => (list ? add_entry(name) : add_section(name))}
                            >
                                + {name}
                            </button>
                        ))}
                    </div>
                </section>
            )}
            {!shown.length && !others.length && <p class="empty">No key has these words.</p>}
        </>
    );
}

export function Form() {
    return (
        <div class="form">
            <div class="form-tools">
                <input
                    type="search"
                    id="search-keys"
                    placeholder="Search all keys"
                    aria-label="Search all keys"
                    value={search_text.value}
                    onInput={(event) => {
                        search_text.value = event.currentTarget.value;
                    }}
                />
                <label class="check">
                    <input
                        type="checkbox"
                        checked={all_keys.value}
                        onChange={(event) => {
                            all_keys.value = event.currentTarget.checked;
                        }}
                    />
                    all keys
                </label>
            </div>
            <div class="form-scroll" tabIndex={-1}>
                <MistakeList list={other_mistakes.value} />
                <Sections />
            </div>
            <HelpStrip />
        </div>
    );
}
