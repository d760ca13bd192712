// The links of the chain, forward and backward.
#include "procedural/optimization/density_map.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "procedural/optimization/projection.h"

namespace lamella {

namespace {

constexpr double middle = 0.5;  // threshold of the projection

std::vector<std::uint8_t> inside(const std::vector<ElementUse>& use, bool with_kept) {
    std::vector<std::uint8_t> mask;
    mask.reserve(use.size());
    for (const ElementUse u : use)
        mask.push_back(u != ElementUse::outside && (with_kept || u != ElementUse::kept));
    return mask;
}

void check_limits(const std::vector<ElementUse>& use, const std::vector<Interval>& limits) {
    if (!limits.empty() && limits.size() != use.size())
        throw InputError("limits of the densities of " + std::to_string(limits.size()) +
                         " elements; the grid has " + std::to_string(use.size()));
    if (limits.empty() && std::ranges::count(use, ElementUse::kept) > 0)
        throw InputError("kept elements need a density; accepted: limits by element");
}

}  // namespace

DensityMap::DensityMap(glm::ivec3 size, std::vector<ElementUse> use, const DensitySettings& settings)
    : size_(size),
      use_(std::move(use)),
      domain_(inside(use_, true)),
      filtered_domain_(inside(use_, false)),
      settings_(settings) {
    check_limits(use_, settings.limits);
    if (settings.length_scale) {
        robust_.emplace(size, filtered_domain_, *settings.length_scale, settings.padding);
    } else {
        filter_.emplace(size, filtered_domain_, settings.radius, settings.padding);
    }
    if (!settings.open.empty() && robust_) robust_->open_border(settings.open);
    if (!settings.open.empty() && filter_) filter_->open_border(settings.open);
    fields_.resize(robust_ ? 3 : 1);
    if (settings.overhang) {
        for (DensityField& field : fields_) field.overhang.emplace(size, domain_, *settings.overhang);
    }
}

/// Returns the mean of each element and its mirror images that the filter sees. Its own transpose.
std::vector<double> DensityMap::symmetric(std::span<const double> values) const {
    std::vector<double> sum(values.begin(), values.end());
    for (int axis = 0; axis < 3; ++axis) {
        if (!settings_.mirrored[static_cast<std::size_t>(axis)]) continue;
        std::size_t element = 0;
        for (int z = 0; z < size_.z; ++z) {
            for (int y = 0; y < size_.y; ++y) {
                for (int x = 0; x < size_.x; ++x, ++element) {
                    glm::ivec3 at(x, y, z);
                    at[axis] = size_[axis] - 1 - at[axis];
                    const auto other =
                        static_cast<std::size_t>(at.x) +
                        static_cast<std::size_t>(size_.x) *
                            (static_cast<std::size_t>(at.y) +
                             static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(at.z));
                    if (other <= element || filtered_domain_[element] == 0 || filtered_domain_[other] == 0)
                        continue;
                    sum[element] = sum[other] = 0.5 * (sum[element] + sum[other]);
                }
            }
        }
    }
    return sum;
}

void DensityMap::prescribe(std::vector<double>& values) const {
    for (std::size_t i = 0; i < use_.size(); ++i) {
        if (use_[i] == ElementUse::free) continue;
        values[i] = use_[i] == ElementUse::solid  ? 1
                    : use_[i] == ElementUse::kept ? settings_.limits[i].lo
                                                  : 0;
    }
}

/// Returns where the variables lie between their limits, 0 to 1.
std::vector<double> DensityMap::shares(std::span<const double> design) const {
    std::vector<double> shares(design.size());
    for (std::size_t i = 0; i < use_.size(); ++i) {
        const Interval& limits = settings_.limits[i];
        if (use_[i] == ElementUse::solid) shares[i] = 1;
        if (use_[i] == ElementUse::free && limits.width() > 0)
            shares[i] = (design[i] - limits.lo) / limits.width();
    }
    return shares;
}

void DensityMap::to_densities(std::vector<double>& shares) const {
    if (settings_.limits.empty()) return;
    for (std::size_t i = 0; i < use_.size(); ++i) {
        const Interval& limits = settings_.limits[i];
        if (use_[i] == ElementUse::free)
            shares[i] = std::clamp(limits.lo + shares[i] * limits.width(), limits.lo, limits.hi);
    }
}

/// The derivatives of to_densities(), or those of shares().
void DensityMap::scale_by_limits(std::vector<double>& gradient, bool back_to_design) const {
    if (settings_.limits.empty()) return;
    for (std::size_t i = 0; i < use_.size(); ++i) {
        const double width = settings_.limits[i].width();
        if (use_[i] != ElementUse::free || !(width > 0)) {
            gradient[i] = 0;
        } else {
            gradient[i] = back_to_design ? gradient[i] / width : gradient[i] * width;
        }
    }
}

void DensityMap::clear_prescribed(std::vector<double>& gradient) const {
    for (std::size_t i = 0; i < use_.size(); ++i) {
        if (use_[i] != ElementUse::free) gradient[i] = 0;
    }
}

void DensityMap::forward(std::span<const double> design, double sharpness) {
    sharpness_ = sharpness;
    const std::vector<double> variables =
        settings_.limits.empty() ? symmetric(design) : symmetric(shares(design));
    if (robust_) {
        RobustFields::Fields three = robust_->forward(variables, sharpness);
        fields_[0].density = std::move(three.eroded);
        fields_[1].density = std::move(three.dilated);
        fields_[2].density = std::move(three.intermediate);
    } else {
        filtered_.resize(variables.size());
        filter_->forward(variables, filtered_);
        fields_[0].density.resize(variables.size());
        project(filtered_, {sharpness, middle}, fields_[0].density);
    }
    for (DensityField& field : fields_) {
        to_densities(field.density);
        prescribe(field.density);
        if (!field.overhang) continue;
        field.overhang->forward(field.density, field.density);
        prescribe(field.density);
    }
}

std::vector<double> DensityMap::smooth_density() const {
    std::vector<double> smooth = robust_ ? robust_->filtered() : filtered_;
    to_densities(smooth);
    prescribe(smooth);
    return smooth;
}

std::vector<double> DensityMap::backward(Role role, std::span<const double> gradient) const {
    std::vector<double> back(gradient.begin(), gradient.end());
    clear_prescribed(back);
    if (const auto& overhang = fields_[field_of(role)].overhang) {
        overhang->backward(back, back);
        clear_prescribed(back);
    }
    scale_by_limits(back, false);
    if (robust_) {
        RobustFields::Gradients gradients;
        (role == Role::stiffness ? gradients.eroded
         : role == Role::volume  ? gradients.dilated
                                 : gradients.intermediate) = back;
        std::vector<double> out(back.size());
        robust_->backward(gradients, out);
        back = symmetric(out);
    } else {
        project_backward(filtered_, {sharpness_, middle}, back, back);
        filter_->backward(back, back);
        back = symmetric(back);
    }
    scale_by_limits(back, true);
    return back;
}

}  // namespace lamella
