// Analyses a part under the recipe's loads without changing it.
#pragma once

#include "recipe/build/build_job.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

/// What stands for the part in an analysis.
enum class AnalysisModel : unsigned char {
    automatic,  ///< the law if the part's foam has one, else the elements
    elements,   ///< elements whose centre is in the finished part: struts need several across
    law,        ///< the body, with the modulus that the foam's law gives at every place
};

struct AnalysisOptions {
    AnalysisModel model = AnalysisModel::automatic;
    int elements =
        0;  ///< along the part's longest side; 0: those of [optimize], or as many as it has by default
    int threads = 0;                      ///< 0: one per core
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// Solves for the displacements of a built part. Throws InputError when the
/// law is asked for and there is none, when nothing is loaded or held (see structural_problem), Interrupted
/// when cancelled.
StructureReport analyse_part(const Recipe& recipe, const BuiltJob& built, const AnalysisOptions& options);

}  // namespace lamella
