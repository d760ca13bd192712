// Asks what a dropped picture is for.
import { useEffect, useRef } from "preact/hooks";
import { dropped_picture, type Use, use_picture } from "./take_picture";

const uses: { use: Use; label: string; help: string }[] = [
    { use: "image", label: "Windows of its shape", help: "the skin is solid where the picture is dark" },
    {
        use: "by-example",
        label: "A pattern like it",
        help: "more of its kind all over the skin, in one sound piece; takes a while",
    },
];

export function PictureDialog() {
    const dialog = useRef<HTMLDialogElement>(null);
    const file = dropped_picture.value;
    useEffect(() => {
        if (file && !dialog.current!.open) dialog.current!.showModal();
        if (!file && dialog.current!.open) dialog.current!.close();
    }, [file]);
    return (
        <dialog
            ref={dialog}
            class="help-dialog"
            aria-labelledby="picture-title"
            onClose={() => {
                dropped_picture.value = null;
            }}
        >
            <h2 id="picture-title">What is {file?.name ?? "the picture"} for?</h2>
            <div class="picture-uses">
                {uses.map(({ use, label, help }) => (
                    <button key={use} onClick={() => void use_picture(use)}>
                        <b>{label}</b>
                        <span class="soft">{help}</span>
                    </button>
                ))}
            </div>
            <div class="help-end">
                <button onClick={() => dialog.current?.close()}>Cancel</button>
            </div>
        </dialog>
    );
}
