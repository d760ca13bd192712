// The start: drop a model, or take an example.
import { useRef } from "preact/hooks";
import pictures from "gallery-pictures";
import { MachineSelect } from "../form/machine_select";
import { examples } from "../state/store";
import { choose_machine_for_new, machine_for_new, open_new, sending, take_files } from "./take_model";

export function Start() {
    const chooser = useRef<HTMLInputElement>(null);
    return (
        <main class="start">
            <div class="start-inside">
                <h2>Begin with a model</h2>
                <button
                    class="drop-zone"
                    disabled={sending.value !== ""}
                    onClick={() => chooser.current?.click()}
                >
                    <b>
                        {sending.value ? `Sending ${sending.value}…` : "Drop a model here, or choose a file"}
                    </b>
                    <span>STL, OBJ, PLY or 3MF; a recipe (TOML) opens as it is</span>
                </button>
                <input
                    ref={chooser}
                    type="file"
                    hidden
                    accept=".stl,.obj,.ply,.3mf,.toml"
                    aria-label="Model"
                    onChange={(event) => {
                        void take_files(event.currentTarget.files ?? []);
                        event.currentTarget.value = "";
                    }}
                />
                <div class="start-machine">
                    <label for="start-machine">Machine</label>
                    <MachineSelect
                        id="start-machine"
                        value={machine_for_new.value}
                        choose={choose_machine_for_new}
                        none="the recipe's own, or the usual one"
                    />
                </div>
                <h2>Or with an example</h2>
                <ul class="gallery">
                    {examples.value.map((example) => (
                        <li key={example.name}>
                            <button onClick={() => void open_new(example.text)}>
                                {pictures[example.name] && <img src={pictures[example.name]} alt="" />}
                                <b>{example.name.replaceAll("_", " ")}</b>
                                <span>{example.title}</span>
                            </button>
                        </li>
                    ))}
                </ul>
            </div>
        </main>
    );
}
