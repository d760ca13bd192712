// Counts, and compliances as multiples of others.
#include "app/reports/element_report.h"

#include <fmt/format.h>

#include "engine/base/text.h"

namespace lamella {

nlohmann::ordered_json elements_json(const ElementPlan& plan) {
    return {{"count", plan.elements.size()},
            {"pieces_before_joining", plan.pieces},
            {"moved", plan.moved},
            {"dropped", plan.dropped},
            {"volume_share", plan.volume},
            {"compliance_N_mm", plan.compliance},
            {"full_compliance_N_mm", plan.full_compliance},
            {"optimum_compliance_N_mm", plan.optimum}};
}

std::string elements_text(const ElementPlan& plan) {
    std::string text = fmt::format(
        "{} in one piece, {:.1f} % of the part; {:.3g} times as soft as the solid part, "
        "{:.3g} times as the best shape of their volume",
        counted(plan.elements.size(), "element"), 100 * plan.volume, plan.compliance / plan.full_compliance,
        plan.compliance / plan.optimum);
    if (plan.moved > 0) text += fmt::format("; {} moved to the others", grouped(plan.moved));
    if (plan.dropped > 0) text += fmt::format("; {} carried nothing and left", grouped(plan.dropped));
    return text;
}

}  // namespace lamella
