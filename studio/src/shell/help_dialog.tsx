// The keys of the page.
import type { RefObject } from "preact";
import { version } from "../state/store";

const keys: [string, string][] = [
    ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
    ["Ctrl+S", "save the recipe"],
    ["/", "search the keys of the form"],
    ["Alt+1 to Alt+5", "Design, Check, Stiffness, Make, Print"],
    [", and .", "one layer down, up"],
    ["arrows on the layer slider", "one layer; Page up and down: many"],
    ["wheel on the layer slider", "a hundredth of all layers; with Shift one"],
    ["drag, right drag, wheel in the view", "turn, move, zoom"],
    ["click on the part", "go to that layer"],
    ["right click on the part or a layer", "put something there"],
    ["arrows, +, -, Home", "move and zoom the view or the layer that has the focus"],
];

export function HelpDialog({ dialog }: { dialog: RefObject<HTMLDialogElement | null> }) {
    return (
        <dialog ref={dialog} class="help-dialog" aria-labelledby="help-title">
            <h2 id="help-title">Keys</h2>
            <dl>
                {keys.map(([key, what]) => (
                    <div key={key}>
                        <dt>{key}</dt>
                        <dd>{what}</dd>
                    </div>
                ))}
            </dl>
            <p class="soft">
                Lamella {version.value?.version ?? ""}. Everything that this page shows comes from the
                server's HTTP interface.
            </p>
            <div class="help-end">
                <button class="primary" onClick={() => dialog.current?.close()}>
                    Close
                </button>
            </div>
        </dialog>
    );
}
