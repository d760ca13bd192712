// The search of [optimize]: starts and stops it, shows its steps and its report.
import type { Design } from "../server/analysis";
import type { Change } from "../server/types";
import { edit } from "../state/recipe";
import { text, values } from "../state/store";
import { optimize, refused, type Run, runs, searching } from "./analyses";
import { type Fact, Facts, Missing } from "./facts";
import { HistoryChart } from "./history_chart";
import { figure, percent } from "./numbers";
import { RunRow } from "./run_row";

/** Keys to begin with: a load on top, held at the bottom. What the recipe has of them stays. */
function add_search(): void {
    const { given, lists } = values.value;
    const has = (section: string) => given.some((name) => name.startsWith(`${section}.`));
    const changes: Change[] = [
        { section: "optimize", key: "volume", value: "0.4" },
        { section: "optimize", key: "elements", value: "32" },
    ];
    if (!has("material")) changes.push({ section: "material", key: "name", value: "pla" });
    if (!lists.load?.length) {
        changes.push({ section: "load", index: 0, key: "face", value: "+z" });
        changes.push({ section: "load", index: 0, key: "force", value: "0,0,-10" });
    }
    if (!lists.anchor?.length) changes.push({ section: "anchor", index: 0, key: "face", value: "-z" });
    edit(changes, "add optimize");
}

function facts_of(found: Design): Fact[] {
    const facts: Fact[] = [
        {
            name: "compliance",
            value: `${figure(found.compliance_nmm, 4)} N mm`,
            more: `${figure(found.compliance_nmm / found.full_compliance_nmm)} times that of the full body`,
        },
        {
            name: "volume",
            value: percent(found.volume),
            more: found.volume_bound < 0.999 ? `of at most ${percent(found.volume_bound)}` : undefined,
        },
    ];
    if (found.mass_g > 0) facts.push({ name: "mass", value: `${figure(found.mass_g)} g` });
    for (const one of found.cases) {
        const case_name = found.cases.length > 1 ? `, case ${one.case}` : "";
        facts.push({
            name: `displacement${case_name}`,
            value: `at most ${figure(one.largest_displacement_mm)} mm`,
            more: `at ${one.displacement_at_mm.map((at) => at.toFixed(1)).join(", ")} mm`,
        });
        if (one.peak_von_mises_mpa > 0)
            facts.push({
                name: `stress${case_name}`,
                value: `at most ${figure(one.peak_von_mises_mpa)} MPa`,
                more: "von Mises",
            });
    }
    return facts;
}

function Report({ run }: { run: Run }) {
    const found = run.analysis.result as Design;
    const cut_short = run.analysis.state === "cancelled";
    return (
        <>
            <p class={`outcome ${cut_short ? "warn" : "passed"}`} role="status">
                {cut_short
                    ? "Stopped: this is the best design so far."
                    : found.converged
                      ? "The search has settled."
                      : "The search has done all its steps."}
            </p>
            <Facts label="Report of the search" facts={facts_of(found)} />
            {found.material_is_assumed && (
                <p class="hint">Without a material, displacements are those of E = 1 MPa.</p>
            )}
            {found.notes.map((note) => (
                <p key={note} class="soft">
                    {note}
                </p>
            ))}
        </>
    );
}

function Buttons({ run }: { run: Run | null }) {
    const fits = run?.of === text.value;
    return (
        <div class="analysis-buttons">
            <button class="primary" onClick={() => void optimize()}>
                {run && fits && run.analysis.state === "done" ? "Optimise again" : "Optimise"}
            </button>
            {fits && run?.analysis.state === "cancelled" && run.analysis.result && (
                <button onClick={() => void optimize(true)}>Go on</button>
            )}
        </div>
    );
}

export function SearchPanel() {
    const run = searching.value;
    const { values: given } = values.value;
    const has_search = values.value.given.some((name) => name.startsWith("optimize."));
    const drives_foam = ["cell", "beam"].includes(given["optimize.result"] ?? "");
    const no = refused.value?.kind === "optimize" && refused.value.of === text.value ? refused.value.text : "";
    const message = run?.analysis.state === "failed" ? run.analysis.message : "";
    return (
        <>
            <h2>Optimise</h2>
            <p class="soft">
                Looks for the {drives_foam ? "foam" : "shape"} that bears the loads best, and makes it the part.
            </p>
            {!has_search && (
                <Missing
                    text="The recipe has no [optimize] with loads and anchors."
                    action="Add a load on top, held at the bottom"
                    act={add_search}
                />
            )}
            {runs(run) ? <RunRow run={run!} name="search" /> : has_search && <Buttons run={run} />}
            {(no || message) && (
                <p class="outcome fail" role="alert">
                    {no || message}
                </p>
            )}
            {run && !runs(run) && run.of !== text.value && run.analysis.result && (
                <p class="hint">The recipe has changed since this search.</p>
            )}
            {run && run.analysis.steps.length > 0 && (
                <HistoryChart steps={run.analysis.steps} most={run.analysis.most} />
            )}
            {runs(run) && drives_foam && (
                <p class="soft">The view shows where the foam is denser than on average.</p>
            )}
            {run?.analysis.result && <Report run={run} />}
        </>
    );
}
