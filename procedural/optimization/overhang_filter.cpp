// The additive manufacturing filter: layers upward for densities, downward for gradients.
#include "procedural/optimization/overhang_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"

namespace lamella {

OverhangFilter::OverhangFilter(glm::ivec3 size, std::span<const std::uint8_t> domain,
                               const OverhangSettings& settings)
    : grid_(size, domain), settings_(settings) {
    if (settings.axis < 0 || settings.axis > 2)
        throw InputError("build direction " + std::to_string(settings.axis) + ": it must be axis 0, 1 or 2");
    if (!(settings.exponent >= 4 && settings.exponent <= 1000))
        throw InputError("an overhang exponent of " + std::to_string(settings.exponent) +
                         ": it must lie in 4 to 1000");
    if (!(settings.smoothing > 0 && settings.smoothing <= 1))
        throw InputError("an overhang smoothing of " + std::to_string(settings.smoothing) +
                         ": it must be above 0 and at most 1");
    if (!(settings.fixed_point > 0 && settings.fixed_point < 1))
        throw InputError("an overhang fixed point of " + std::to_string(settings.fixed_point) +
                         ": it must lie between 0 and 1");
    const std::array<std::size_t, 3> steps{1, grid_.place(0, 1, 0), grid_.place(0, 0, 1)};
    // The two other axes, the one with the shorter step in memory first.
    const int u = settings.axis == 0 ? 1 : 0, v = settings.axis == 2 ? 1 : 2;
    layers_ = size[settings.axis];
    width_ = size[u];
    depth_ = size[v];
    up_ = steps[static_cast<std::size_t>(settings.axis)];
    across_ = steps[static_cast<std::size_t>(u)];
    along_ = steps[static_cast<std::size_t>(v)];

    const int supports = width_ > 1 && depth_ > 1 ? 5 : 3;
    root_ = settings.exponent + logarithm(supports) / logarithm(settings.fixed_point);
    if (!(root_ >= 1))
        throw InputError("an overhang exponent of " + std::to_string(settings.exponent) +
                         " is too small for a fixed point of " + std::to_string(settings.fixed_point));
}

/// Calls work(u, v, element) for the elements of a layer, in parallel by blocks.
template <class Work>
void OverhangFilter::for_each_of_layer(int layer, const Work& work) const {
    constexpr std::size_t block = 256;
    const auto width = static_cast<std::size_t>(width_);
    const std::size_t count = width * static_cast<std::size_t>(depth_);
    const std::size_t first = up_ * static_cast<std::size_t>(layer);
    parallel_for((count + block - 1) / block, [&](std::size_t b) {
        for (std::size_t i = b * block; i < std::min(count, (b + 1) * block); ++i) {
            const std::size_t u = i % width, v = i / width;
            work(static_cast<int>(u), static_cast<int>(v), first + u * across_ + v * along_);
        }
    });
}

/// Calls work(element) for the element `centre` at (u, v) of its layer and its neighbours in the layer.
template <class Work>
void OverhangFilter::for_each_in_cross(int u, int v, std::size_t centre, const Work& work) const {
    work(centre);
    if (u > 0) work(centre - across_);
    if (u + 1 < width_) work(centre + across_);
    if (v > 0) work(centre - along_);
    if (v + 1 < depth_) work(centre + along_);
}

// Densities are divided by the largest before they are raised to P, so that small ones do not underflow.
OverhangFilter::Support OverhangFilter::support(int u, int v, std::size_t below) const {
    Support s;
    for_each_in_cross(u, v, below, [&](std::size_t k) { s.largest = std::max(s.largest, printed_[k]); });
    if (s.largest > 0)
        for_each_in_cross(
            u, v, below, [&](std::size_t k) { s.sum += power(printed_[k] / s.largest, settings_.exponent); });
    return s;
}

void OverhangFilter::forward(std::span<const double> blueprint, std::span<double> printed) {
    grid_.check(blueprint.size(), "the blueprint");
    grid_.check(printed.size(), "the printed field");
    const double exponent = settings_.exponent, epsilon = settings_.smoothing;
    const double lift = std::sqrt(epsilon);  // brings the minimum of two zeros to 0
    for (auto* field : {&printed_, &by_blueprint_, &by_support_, &largest_})
        field->assign(grid_.elements(), 0.0);
    for_each_of_layer(0, [&](int, int, std::size_t i) {
        if (!grid_.inside(i)) return;
        printed_[i] = blueprint[i];
        by_blueprint_[i] = 1;
    });
    for (int layer = 1; layer < layers_; ++layer)
        for_each_of_layer(layer, [&](int u, int v, std::size_t i) {
            if (!grid_.inside(i)) return;
            const Support s = support(u, v, i - up_);
            // (largest^P sum)^(1/Q); 0 for no support, where its derivatives are 0 as well, because P > Q.
            const double maximum =
                s.largest > 0 ? exponential((exponent * logarithm(s.largest) + logarithm(s.sum)) / root_) : 0;
            const double difference = blueprint[i] - maximum;
            const double distance = std::sqrt(difference * difference + epsilon);
            printed_[i] = std::max(0.0, 0.5 * (blueprint[i] + maximum - distance + lift));
            by_blueprint_[i] = 0.5 * (1 - difference / distance);
            largest_[i] = s.largest;
            if (s.largest > 0)
                by_support_[i] =
                    0.5 * (1 + difference / distance) * (exponent / root_) * maximum / (s.sum * s.largest);
        });
    std::copy(printed_.begin(), printed_.end(), printed.begin());
}

void OverhangFilter::backward(std::span<const double> gradient, std::span<double> out) const {
    if (printed_.empty()) throw FaultError("overhang filter: a gradient was asked for before the densities");
    grid_.check(gradient.size(), "the gradient");
    grid_.check(out.size(), "the gradient of the blueprint");
    // With respect to an element's printed density, what it lends to the layer above included.
    std::vector<double> total(grid_.elements(), 0.0);
    for (int layer = layers_ - 1; layer >= 0; --layer)
        for_each_of_layer(layer, [&](int u, int v, std::size_t k) {
            if (!grid_.inside(k)) return;
            double sum = gradient[k];
            if (layer + 1 < layers_)
                for_each_in_cross(u, v, k + up_, [&](std::size_t i) {
                    if (by_support_[i] != 0)
                        sum += total[i] * by_support_[i] *
                               power(printed_[k] / largest_[i], settings_.exponent - 1);
                });
            total[k] = sum;
        });
    for (std::size_t i = 0; i < total.size(); ++i) out[i] = total[i] * by_blueprint_[i];
}

}  // namespace lamella
