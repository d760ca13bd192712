// Counts, and compliances as multiples of others.
#include "app/reports/element_report.h"

#include <fmt/format.h>

#include "engine/base/text.h"

namespace lamella {

nlohmann::ordered_json elements_json(const ElementPlan& plan) {
    nlohmann::ordered_json json{
        {"count", plan.elements.size()},  {"pieces_before_joining", plan.pieces},
        {"bridges", plan.bridges.size()}, {"moved", plan.moved},
        {"dropped", plan.dropped},        {plan.thickness > 0 ? "skin_share" : "volume_share", plan.volume}};
    if (plan.full_compliance > 0) {
        json["compliance_N_mm"] = plan.compliance;
        json["full_compliance_N_mm"] = plan.full_compliance;
        json["optimum_compliance_N_mm"] = plan.optimum;
    } else {
        json["overlap"] = plan.overlap;
    }
    return json;
}

std::string elements_text(const ElementPlan& plan) {
    const bool is_loaded = plan.full_compliance > 0;
    std::string text =
        fmt::format("{} in one piece, {:.1f} % of the {}; ", counted(plan.elements.size(), "element"),
                    100 * plan.volume, plan.thickness > 0 ? "skin" : "part");
    if (is_loaded) {
        text += fmt::format(
            "{:.3g} times as soft as the solid part, {:.3g} times as the best shape of their volume",
            plan.compliance / plan.full_compliance, plan.compliance / plan.optimum);
    } else {
        text += fmt::format("{:.1f} % of them lies in others", 100 * plan.overlap);
    }
    if (!plan.bridges.empty()) text += "; " + counted(plan.bridges.size(), "bridge");
    if (plan.moved > 0) text += fmt::format("; {} moved to the others", grouped(plan.moved));
    if (plan.dropped > 0)
        text += fmt::format("; {} {} and left", grouped(plan.dropped),
                            is_loaded ? "carried nothing" : "touched no others");
    return text;
}

}  // namespace lamella
