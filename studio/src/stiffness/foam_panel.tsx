// The stiffness of the foam, by homogenisation of samples of it.
import { signal } from "@preact/signals";
import { add_section } from "../form/changes";
import type { Stiffness } from "../server/analysis";
import { job, values } from "../state/store";
import { homogenize, homogenizing, refused, runs } from "./analyses";
import { Facts, Missing } from "./facts";
import { LawChart } from "./law_chart";
import { deviation, figure, percent } from "./numbers";
import { RunRow } from "./run_row";
import { Surface } from "./surface";

/** Elements along a sample's side; 0: as many as the beams need. */
const elements = signal(0);
const samples = signal(1);

function Settings() {
    return (
        <div class="analysis-settings">
            <label>
                Elements along a side
                <select
                    value={elements.value}
                    onChange={(event) => {
                        elements.value = Number(event.currentTarget.value);
                    }}
                >
                    <option value="0">as the beams need</option>
                    {[32, 64, 96, 128, 192].map((count) => (
                        <option key={count} value={count}>
                            {count}
                        </option>
                    ))}
                </select>
            </label>
            <label>
                Samples
                <select
                    value={samples.value}
                    onChange={(event) => {
                        samples.value = Number(event.currentTarget.value);
                    }}
                >
                    {[1, 2, 4, 8].map((count) => (
                        <option key={count} value={count}>
                            {count}
                        </option>
                    ))}
                </select>
            </label>
        </div>
    );
}

function Result({ found }: { found: Stiffness }) {
    const is_known = values.value.given.some((name) => name.startsWith("material."));
    const unit = is_known ? "MPa" : "of the solid's";
    const spread = (of: (one: Stiffness["samples"][number]) => number) => {
        const about = deviation(found.samples.map(of));
        return about > 0 ? ` ± ${figure(about, 2)}` : "";
    };
    return (
        <>
            <Facts
                label="Stiffness of the foam"
                facts={[
                    {
                        name: "Young's modulus E",
                        value: `${figure(found.E, 4)}${spread((one) => one.E)} ${unit}`,
                        more: is_known ? `${percent(found.E / found.material.E)} of the solid's` : undefined,
                    },
                    {
                        name: "in all directions",
                        value: `${figure(found.E_least)} to ${figure(found.E_greatest)} ${unit}`,
                        more: `${percent(found.anisotropy)} from isotropic`,
                    },
                    {
                        name: "Poisson's ratio ν",
                        value: `${figure(found.nu)}${spread((one) => one.nu)}`,
                    },
                    { name: "shear, bulk modulus", value: `${figure(found.G)}, ${figure(found.K)} ${unit}` },
                    {
                        name: "density",
                        value: `${figure(100 * found.density)}${spread((one) => 100 * one.density)} %`,
                        more: "of the solid",
                    },
                    {
                        name: "at most",
                        value: `${figure(found.E_hashin_shtrikman)} ${unit}`,
                        more: "isotropic, at this density (Hashin and Shtrikman)",
                    },
                ]}
            />
            <Surface found={found} unit={unit} />
            <LawChart found={found} unit={unit} />
            <p class="soft">
                {found.samples.length > 1 ? `${found.samples.length} samples` : "One sample"} of{" "}
                {figure(found.period_mm)} mm, {found.elements} elements along a side.
            </p>
        </>
    );
}

export function FoamPanel() {
    const made = job.value;
    const run = homogenizing.value;
    const has_foam = values.value.given.some((name) => name.startsWith("foam."));
    const has_material = values.value.given.some((name) => name.startsWith("material."));
    const no = refused.value?.kind === "homogenize" && refused.value.of === made?.job ? refused.value.text : "";
    return (
        <>
            <h2>Stiffness of the foam</h2>
            <p class="soft">Computes how stiff the foam is as a material, from a periodic sample of it.</p>
            {!has_foam && (
                <Missing text="The recipe has no foam." action="Add foam" act={() => add_section("foam")} />
            )}
            {has_foam && !has_material && (
                <Missing
                    text="Without a material, figures are relative to the solid's modulus."
                    action="Add a material"
                    act={() => add_section("material")}
                />
            )}
            {has_foam && <Settings />}
            {runs(run) ? (
                <RunRow run={run!} name="homogenisation" />
            ) : (
                <button
                    class="primary"
                    disabled={!made || !has_foam}
                    onClick={() => void homogenize(elements.value, samples.value)}
                >
                    Homogenise
                </button>
            )}
            {no && (
                <p class="outcome fail" role="alert">
                    {no}
                </p>
            )}
            {run?.analysis.state === "failed" && (
                <p class="outcome fail" role="alert">
                    {run.analysis.message}
                </p>
            )}
            {run?.analysis.result && run.of !== made?.job && (
                <p class="hint">The recipe has changed since this was computed.</p>
            )}
            {run?.analysis.result && <Result found={run.analysis.result as Stiffness} />}
        </>
    );
}
