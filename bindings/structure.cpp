// How a job's part bears its loads.
#include <algorithm>

#include "bindings/handles.h"
#include "recipe/structure/analyse_part.h"

using namespace lamella;

namespace {

AnalysisOptions analysis_options(const lamella_analysis_options& given) {
    AnalysisOptions options;
    switch (given.model) {
        case LAMELLA_MODEL_AUTOMATIC:
            break;
        case LAMELLA_MODEL_ELEMENTS:
            options.model = AnalysisModel::elements;
            break;
        case LAMELLA_MODEL_LAW:
            options.model = AnalysisModel::law;
            break;
        default:
            throw BadCall("options: model is none of LAMELLA_MODEL_...");
    }
    constexpr int fewest = 8, most = 2048;
    if (given.elements != 0 && (given.elements < fewest || given.elements > most))
        throw BadCall("options: elements is neither 0 nor from 8 to 2048");
    if (given.threads < 0) throw BadCall("options: threads is below 0");
    options.elements = given.elements;
    options.threads = given.threads;
    options.cancel = given.cancel ? &given.cancel->token : nullptr;
    return options;
}

lamella_structure structure_of(const StructureReport& report) {
    lamella_structure structure{};
    structure.dimensions = report.dimensions;
    structure.iterations = static_cast<std::int32_t>(report.history.size());
    structure.converged = report.is_converged ? 1 : 0;
    structure.element = report.element.x;
    structure.full_compliance = report.full_compliance;
    structure.compliance = report.compliance;
    structure.volume = report.volume;
    structure.mass = report.mass;
    for (const CaseReport& load : report.cases) {
        structure.largest_displacement = std::max(structure.largest_displacement, load.largest_displacement);
        structure.peak_stress = std::max(structure.peak_stress, load.peak_stress);
    }
    structure.appearance = report.appearance;
    structure.stiffest_appearance = report.stiffest_appearance;
    return structure;
}

}  // namespace

std::int32_t lamella_job_structure(lamella_context* context, const lamella_job* job,
                                   const lamella_analysis_options* options, lamella_structure* structure) {
    return guarded(context, [&] {
        const lamella_job& made = wanted(job, "job");
        wanted(structure, "structure");
        const AnalysisOptions with = analysis_options(taken_or_usual(options, "options"));
        const auto& optimized = made.built.optimized;
        if (options == nullptr && optimized && optimized->report) {
            hand_out(structure, structure_of(*optimized->report), "structure");
        } else {
            hand_out(structure, structure_of(analyse_part(made.recipe, made.built, with)), "structure");
        }
    });
}
