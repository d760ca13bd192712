// Make: the machine, the outputs and the recipe's file.
import { useSignal } from "@preact/signals";
import { MachineSelect } from "../form/machine_select";
import { with_token } from "../server/http";
import { edit, save } from "../state/recipe";
import { job, machines, path, unsaved, values } from "../state/store";
import { remove, type Row, rows, runs, start } from "./outputs";

function size(bytes: number): string {
    if (bytes < 1e6) return `${Math.max(1, Math.round(bytes / 1e3))} kB`;
    return `${(bytes / 1e6).toFixed(1)} MB`;
}

function state_of({ output, rate }: Row): string {
    const place = output.is_kept ? ", in the folder of the studio" : "";
    switch (output.state) {
        case "waiting":
            return "waits for the output before it";
        case "running":
            return `${output.done} of ${output.of} layers${rate ? `, ${Math.round(rate)} a second` : ""}`;
        case "done":
            return (output.bytes ? size(output.bytes) : `${output.of} layers`) + place;
        case "cancelled":
            return "cancelled";
        case "failed":
            return output.message || "failed";
    }
}

function OutputRow({ row }: { row: Row }) {
    const { output } = row;
    return (
        <li class={`output ${output.state}`}>
            <div class="output-head">
                <b>{output.file || `output ${output.output}`}</b>
                {output.state === "done" && output.bytes > 0 && (
                    <a
                        class="button"
                        download={output.file}
                        href={with_token(`/api/outputs/${output.output}/file`)}
                    >
                        Download
                    </a>
                )}
                <button
                    class="quiet"
                    aria-label={`${runs(output) ? "Cancel" : "Remove"} ${output.file}`}
                    onClick={() => void remove(row)}
                >
                    {runs(output) ? "cancel" : "remove"}
                </button>
            </div>
            {runs(output) && (
                <progress max={output.of} value={output.done} aria-label={`Progress of ${output.file}`} />
            )}
            <p class="soft">
                {row.machine} · {state_of(row)}
            </p>
        </li>
    );
}

/** What is made, and whether it stays. An output that is a folder can only stay. */
function StartOutput() {
    const made = job.value;
    const name = useSignal<string | null>(null);
    const keep = useSignal(false);
    const machine = machines.value.find((one) => one.name === made?.machine);
    const folder = machine?.extension === "";
    const kept = keep.value || folder;
    const usual = made ? `${made.name}${machine?.extension ?? ""}` : "";
    return (
        <form
            onSubmit={(event) => {
                event.preventDefault();
                void start(kept ? (name.value ?? usual).trim() : "");
                name.value = null;
            }}
        >
            {machine && (
                <p class="soft make-about">
                    {machine.name}: {machine.process}, {machine.backend} ({machine.extension || "a folder"})
                </p>
            )}
            <label class="check make-keep">
                <input
                    type="checkbox"
                    checked={kept}
                    disabled={folder}
                    onChange={(event) => {
                        keep.value = event.currentTarget.checked;
                    }}
                />
                keep in the folder of the studio
            </label>
            {kept && (
                <div class="make-row">
                    <label for="make-file">Name</label>
                    <input
                        id="make-file"
                        class="mono"
                        value={name.value ?? usual}
                        disabled={!made}
                        spellcheck={false}
                        onInput={(event) => {
                            name.value = event.currentTarget.value;
                        }}
                    />
                </div>
            )}
            <button class="primary" disabled={!made}>
                Make {made ? `${made.layers.count} layers` : ""}
            </button>
        </form>
    );
}

function SaveRecipe() {
    const name = useSignal<string | null>(null);
    const shown = name.value ?? path.value ?? `${job.value?.name ?? "part"}.toml`;
    return (
        <form
            class="save-row"
            onSubmit={(event) => {
                event.preventDefault();
                void save(shown.trim() || null);
                name.value = null;
            }}
        >
            <label for="recipe-path">File</label>
            <input
                id="recipe-path"
                class="mono"
                value={shown}
                spellcheck={false}
                onInput={(event) => {
                    name.value = event.currentTarget.value;
                }}
            />
            <button disabled={!unsaved.value && shown === path.value}>Save</button>
        </form>
    );
}

export function MakePanel() {
    return (
        <div class="panel">
            <div class="panel-scroll" tabIndex={-1}>
                <h2>Make</h2>
                <div class="make-row">
                    <label for="make-machine">Machine</label>
                    <MachineSelect
                        id="make-machine"
                        value={values.value.values["printer.profile"] ?? job.value?.machine ?? ""}
                        choose={(name) => edit([{ section: "printer", key: "profile", value: name }])}
                    />
                </div>
                <StartOutput />
                {rows.value.length > 0 && (
                    <ul class="outputs">
                        {rows.value.map((row) => (
                            <OutputRow key={row.output.output} row={row} />
                        ))}
                    </ul>
                )}
                <h2>Recipe</h2>
                <p class="soft">The recipe makes the same layers again, on any computer.</p>
                <SaveRecipe />
            </div>
        </div>
    );
}
