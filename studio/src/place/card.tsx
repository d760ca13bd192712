// The card of the handle that is chosen: its few most important keys, and a way to remove it.
import { Field } from "../form/field";
import { applies, chosen_kind, settings_of } from "../form/applies";
import { table, values } from "../state/store";
import { chosen, entry_of, type Handle, handles, remove } from "./handles";

const keys: Record<string, string[]> = {
    grading: ["at", "a", "b", "near", "far", "radius"],
    field: ["at", "radius", "size", "height"],
    region: ["make", "cell", "beam", "blend"],
    hole: ["at", "radius", "through"],
    load: ["at", "force", "pressure"],
    anchor: ["at", "fix"],
    cut: ["at", "normal"],
};

function Keys({ section, index }: { section: string; index: number }) {
    const entry = entry_of(section, index);
    const kind = chosen_kind(table.value, section, entry);
    const region = section === "region" && entry.make !== "foam" ? ["make", "blend"] : keys[section]!;
    return (
        <div class="fields">
            {settings_of(table.value, section)
                .filter(({ key }) => region.includes(key) && applies(table.value, section, key, kind))
                .filter(({ key }) => key !== "at" || key in entry || section === "field")
                .filter(({ key }) => key !== "pressure" || key in entry)
                .map((setting) => (
                    <Field key={setting.key} setting={setting} spot={{ section, index }} in_card />
                ))}
        </div>
    );
}

function Regions({ handle }: { handle: Handle }) {
    const name = entry_of("field", handle.index).name;
    const regions = values.value.lists.region ?? [];
    return (
        <>
            {regions.map(
                (one, index) => one.field === name && <Keys key={index} section="region" index={index} />,
            )}
        </>
    );
}

export function HandleCard() {
    const handle = handles.value.find((one) => one.id === chosen.value);
    if (!handle) return null;
    return (
        <section class="handle-card" aria-label={handle.title}>
            <header>
                <h3>{handle.title}</h3>
                <button class="quiet" onClick={() => remove(handle)}>
                    remove
                </button>
                <button
                    class="quiet"
                    aria-label="Close"
                    onClick={() => {
                        chosen.value = null;
                    }}
                >
                    ×
                </button>
            </header>
            <Keys section={handle.section} index={handle.index} />
            {handle.section === "field" && <Regions handle={handle} />}
        </section>
    );
}
