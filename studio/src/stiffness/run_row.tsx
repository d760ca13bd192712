// The progress of an analysis, and its end.
import { type Run, stop } from "./analyses";

export function RunRow({ run, name }: { run: Run; name: string }) {
    const { state, share } = run.analysis;
    return (
        <div class="progress-row">
            <progress
                max="1"
                value={state === "waiting" ? undefined : share}
                aria-label={`Progress of the ${name}`}
            />
            <span class="soft">{state === "waiting" ? "waits" : `${Math.floor(100 * share)} %`}</span>
            <button class="quiet" onClick={() => void stop(run)}>
                stop
            </button>
        </div>
    );
}
