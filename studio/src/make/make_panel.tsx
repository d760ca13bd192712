// Make: the machine, the outputs and the recipe's file.
import { useSignal } from "@preact/signals";
import { MachineSelect } from "../form/machine_select";
import { with_token } from "../server/http";
import { edit, save } from "../state/recipe";
import { job, machines, path, unsaved, values } from "../state/store";
import { remove, type Row, rows, start } from "./outputs";

function size(bytes: number): string {
    if (bytes < 1e6) return `${Math.max(1, Math.round(bytes / 1e3))} kB`;
    return `${(bytes / 1e6).toFixed(1)} MB`;
}

function state_of({ output, rate }: Row): string {
    switch (output.state) {
        case "running": return `${output.done} of ${output.of} layers${rate ? `, ${Math.round(rate)} a second` : ""}`;
        case "done": return size(output.bytes);
        case "cancelled": return "cancelled";
        case "failed": return output.message || "failed";
    }
}

function OutputRow({ row }: { row: Row }) {
    const { output } = row;
    return (
        <li class={`output ${output.state}`}>
            <div class="output-head">
                <b>{output.file || `output ${output.output}`}</b>
                {output.state === "done" && <a class="button" download={output.file}
                    href={with_token(`/api/outputs/${output.output}/file`)}>Download</a>}
                <button class="quiet" aria-label={`${output.state === "running" ? "Cancel" : "Remove"} ${output.file}`}
                    onClick={() => void remove(row)}>{output.state === "running" ? "cancel" : "remove"}</button>
            </div>
            {output.state === "running" && <progress max={output.of} value={output.done} aria-label={`Progress of ${output.file}`} />}
            <p class="soft">{row.machine} · {state_of(row)}</p>
        </li>
    );
}

function SaveRecipe() {
    const name = useSignal<string | null>(null);
    const shown = name.value ?? path.value ?? "part.toml";
    return (
        <form class="save-row" onSubmit={(event) => {
            event.preventDefault();
            void save(shown.trim() || null);
            name.value = null;
        }}>
            <label for="recipe-path">File</label>
            <input id="recipe-path" class="mono" value={shown} spellcheck={false}
                onInput={(event) => { name.value = event.currentTarget.value; }} />
            <button disabled={!unsaved.value && shown === path.value}>Save</button>
        </form>
    );
}

export function MakePanel() {
    const made = job.value;
    const file = useSignal<string | null>(null);
    const machine = machines.value.find((one) => one.name === made?.machine);
    const usual = made ? `${made.name}${machine?.extension ?? ""}` : "";
    return (
        <div class="panel">
            <div class="panel-scroll" tabIndex={-1}>
                <h2>Make</h2>
                <div class="make-row">
                    <label for="make-machine">Machine</label>
                    <MachineSelect id="make-machine" value={values.value.values["printer.profile"] ?? made?.machine ?? ""}
                        choose={(name) => edit([{ section: "printer", key: "profile", value: name }])} />
                </div>
                {machine && <p class="soft make-about">{machine.name}: {machine.process}, {machine.backend}
                    {machine.extension ? ` (${machine.extension})` : ""}</p>}
                <form onSubmit={(event) => {
                    event.preventDefault();
                    void start((file.value ?? usual).trim());
                    file.value = null;
                }}>
                    <div class="make-row">
                        <label for="make-file">Output</label>
                        <input id="make-file" class="mono" value={file.value ?? usual} disabled={!made} spellcheck={false}
                            onInput={(event) => { file.value = event.currentTarget.value; }} />
                    </div>
                    <button class="primary" disabled={!made}>Make {made ? `${made.layers.count} layers` : ""}</button>
                </form>
                {rows.value.length > 0 && <ul class="outputs">
                    {rows.value.map((row) => <OutputRow key={row.output.output} row={row} />)}
                </ul>}
                <h2>Recipe</h2>
                <p class="soft">The recipe makes the same layers again, on any computer.</p>
                <SaveRecipe />
            </div>
        </div>
    );
}
