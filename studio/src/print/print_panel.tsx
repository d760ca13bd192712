// Print: to a machine of G-code over a serial port, while later layers are computed; or to a printer on the network.
import { useEffect, useRef } from "preact/hooks";
import { MachineSelect } from "../form/machine_select";
import { edit } from "../state/recipe";
import { job, values } from "../state/store";
import { messages, print, running } from "./print";
import { NetworkPart } from "./network_part";
import { follow_outlook, outlook } from "./setup";
import { StartForm } from "./start_form";
import { StateCard } from "./state_card";

/** The job's machine takes no G-code: another one is to be chosen. */
function OtherMachine({ message }: { message: string }) {
    return (
        <>
            <p class="outcome fail print-refused">{message}</p>
            <div class="make-row">
                <label for="print-machine">Machine</label>
                <MachineSelect
                    id="print-machine"
                    value={values.value.values["printer.profile"] ?? job.value?.machine ?? ""}
                    choose={(name) => edit([{ section: "printer", key: "profile", value: name }])}
                />
            </div>
            <p class="soft">For other machines, Make writes the file that they read.</p>
        </>
    );
}

function Log() {
    const list = useRef<HTMLDivElement>(null);
    const shown = messages.value;
    useEffect(() => {
        if (list.current) list.current.scrollTop = list.current.scrollHeight;
    }, [shown]);
    if (shown.length === 0) return null;
    return (
        <>
            <h2>Messages</h2>
            <div class="print-log mono" role="log" aria-label="Messages of the print" tabIndex={0} ref={list}>
                {shown.map((one) => (
                    <p key={one.number}>{one.text}</p>
                ))}
            </div>
        </>
    );
}

function Start() {
    const made = job.value;
    const known = outlook.value;
    if (!made) return <p class="soft">There is no part yet.</p>;
    if (known?.job !== made.job) return <p class="soft">Asking what can be printed…</p>;
    if (!known.outlook.accepted) return <OtherMachine message={known.outlook.message} />;
    return <StartForm outlook={known.outlook} layers={made.layers.count} />;
}

export function PrintPanel() {
    useEffect(() => follow_outlook(), []);
    const shown = print.value;
    return (
        <div class="panel">
            <div class="panel-scroll print-panel" tabIndex={-1}>
                <h2>Print</h2>
                {shown && <StateCard shown={shown} />}
                {!running.value && <Start />}
                <NetworkPart />
                <Log />
            </div>
        </div>
    );
}
