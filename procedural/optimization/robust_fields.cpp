// Three projections of one filtered field, and the sum of their gradients through one transposed filter.
#include "procedural/optimization/robust_fields.h"

#include <string>

#include "engine/base/error.h"
#include "procedural/optimization/projection.h"

namespace lamella {

RobustFields::RobustFields(glm::ivec3 size, std::span<const std::uint8_t> domain, const LengthScale& scale,
                           FilterPadding padding)
    : filter_(size, domain, scale.radius, padding), scale_(scale) {
    if (!(scale.dilated >= 0 && scale.dilated <= scale.intermediate && scale.intermediate <= scale.eroded &&
          scale.eroded <= 1))
        throw InputError("thresholds of " + std::to_string(scale.dilated) + " (dilated), " +
                         std::to_string(scale.intermediate) + " (intermediate) and " +
                         std::to_string(scale.eroded) +
                         " (eroded): they must rise in this order from 0 to 1");
}

RobustFields::Fields RobustFields::forward(std::span<const double> design, double sharpness) {
    std::vector<double> filtered(filter_.grid().elements());
    filter_.forward(design, filtered);
    const auto at = [&](double threshold) {
        std::vector<double> field(filtered.size());
        project(filtered, {sharpness, threshold}, field);
        return field;
    };
    Fields fields{at(scale_.eroded), at(scale_.intermediate), at(scale_.dilated)};
    filtered_ = std::move(filtered);
    sharpness_ = sharpness;
    return fields;
}

void RobustFields::backward(const Gradients& gradients, std::span<double> out) const {
    if (filtered_.empty()) throw FaultError("robust fields: a gradient was asked for before the fields");
    std::vector<double> sum(filtered_.size(), 0.0), part(filtered_.size());
    const auto add = [&](std::span<const double> gradient, double threshold) {
        if (gradient.empty()) return;
        project_backward(filtered_, {sharpness_, threshold}, gradient, part);
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
    };
    add(gradients.eroded, scale_.eroded);
    add(gradients.intermediate, scale_.intermediate);
    add(gradients.dilated, scale_.dilated);
    filter_.backward(sum, out);
}

}  // namespace lamella
