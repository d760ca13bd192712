// Says that the view shows a design and not the part, or that the part waits for its search.
import { optimize, runs, searching } from "../stiffness/analyses";
import { job, tab } from "../state/store";
import { shown_design } from "./design";

export function DesignChip() {
    const design = shown_design.value;
    if (!design) return null;
    const running = runs(searching.value);
    return (
        <div class="view-chip design-chip">
            the design after step {design.step}
            {!running && job.value && (
                <button
                    class="link"
                    onClick={() => {
                        shown_design.value = null;
                    }}
                >
                    show the part
                </button>
            )}
        </div>
    );
}

/** A recipe with a search has no part before it. */
export function SearchCard() {
    if (runs(searching.value)) return null;
    return (
        <div class="search-card">
            <p>This part has to be optimised first.</p>
            <button
                class="primary"
                onClick={() => {
                    tab.value = "stiffness";
                    void optimize();
                }}
            >
                Optimise
            </button>
        </div>
    );
}
