// Mistakes of the recipe, with buttons that go to their lines.
import type { Mistake } from "../server/types";
import { left_mode, wanted_line } from "../state/store";

export function MistakeList({ list }: { list: Mistake[] }) {
    if (!list.length) return null;
    const go = (line: number) => {
        left_mode.value = "text";
        wanted_line.value = { line };
    };
    return (
        <div class="mistakes" role="alert">
            {list.map((one) => (
                <p key={`${one.line} ${one.text}`}>
                    {one.line !== null && (
                        <>
                            <button class="link" onClick={() => go(one.line!)}>
                                line {one.line}
                            </button>
                            :{" "}
                        </>
                    )}
                    {one.text}
                </p>
            ))}
        </div>
    );
}
