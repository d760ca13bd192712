// A path: typed, or a file that is sent to the studio's folder.
import { useSignal } from "@preact/signals";
import { useRef } from "preact/hooks";
import { send_file } from "../server/api";
import { report } from "../state/notices";
import { type ControlProps, TextControl } from "./controls";

export const mesh_endings = [".stl", ".obj", ".ply", ".3mf"];

export function PathControl(props: ControlProps) {
    const chooser = useRef<HTMLInputElement>(null);
    const sending = useSignal(false);
    const mesh = props.setting.key === "mesh";
    const take = async (file: File | undefined) => {
        if (!file) return;
        sending.value = true;
        try {
            props.send((await send_file(file)).path);
        } catch (error) {
            report(error);
        }
        sending.value = false;
    };
    return (
        <div class="path">
            <TextControl {...props} />
            <button
                title="Send a file to the folder of the studio"
                aria-label={`Choose a file for ${props.setting.key}`}
                disabled={sending.value}
                onClick={() => chooser.current?.click()}
            >
                {sending.value ? "sending" : "file…"}
            </button>
            <input
                ref={chooser}
                type="file"
                hidden
                accept={mesh ? mesh_endings.join(",") : undefined}
                onChange={(event) => {
                    void take(event.currentTarget.files?.[0]);
                    event.currentTarget.value = "";
                }}
            />
        </div>
    );
}
