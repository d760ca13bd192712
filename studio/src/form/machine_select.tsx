// Chooses a machine; machines of a process stand together.
import { machines } from "../state/store";

interface Props {
    id: string;
    value: string;
    choose: (name: string) => void;
    /** What an empty choice means; absent: it cannot be made. */
    none?: string;
}

export function MachineSelect({ id, value, choose, none }: Props) {
    const processes = [...new Set(machines.value.map((one) => one.process))];
    const unknown = value !== "" && !machines.value.some((one) => one.name === value);
    return (
        <select id={id} value={value} onChange={(event) => choose(event.currentTarget.value)}>
            {(none || value === "") && <option value="">{none ?? "choose a machine"}</option>}
            {unknown && <option value={value}>{value}</option>}
            {processes.map((process) => (
                <optgroup key={process} label={process}>
                    {machines.value
                        .filter((one) => one.process === process)
                        .map((one) => (
                            <option key={one.name} value={one.name}>
                                {one.description || one.name}
                            </option>
                        ))}
                </optgroup>
            ))}
        </select>
    );
}
