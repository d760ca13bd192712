// Parts of elements by cell; sums over elements in their order, so that threads change no bit.
#include "procedural/elements/element_raster.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace lamella {

namespace {

double eighth_power(double v) {
    const double square = v * v, fourth = square * square;
    return fourth * fourth;
}

double seventh_power(double v) {
    const double square = v * v;
    return square * square * square * v;
}

}  // namespace

ElementRaster::ElementRaster(const CellGrid& grid, std::span<const ElementUse> use,
                             std::span<const DistanceTable> shapes, double width, double thinner)
    : grid_(grid), use_(use), shapes_(shapes), width_(width), thinner_(thinner) {}

dvec3 ElementRaster::centre(std::uint32_t cell) const {
    const auto x = static_cast<std::uint32_t>(grid_.size.x), y = static_cast<std::uint32_t>(grid_.size.y);
    return grid_.centre(glm::ivec3(cell % x, cell / x % y, cell / x / y));
}

std::vector<ElementRaster::Part> ElementRaster::parts_of(const PlacedElement& element) const {
    const DistanceTable& shape = shapes_[element.shape];
    const double reach = shape.reach() * element.scale + (1 - thinner_) * width_;
    const dvec3 about = (element.at - grid_.corner) / grid_.edges, far = reach / grid_.edges;
    const dvec3 lo = glm::clamp(glm::floor(about - far), dvec3(0), dvec3(grid_.size));
    const dvec3 hi = glm::clamp(glm::ceil(about + far), dvec3(0), dvec3(grid_.size));
    const glm::ivec3 first = grid_.is_flat ? glm::ivec3(lo.x, lo.y, 0) : glm::ivec3(lo);
    const glm::ivec3 last = grid_.is_flat ? glm::ivec3(hi.x, hi.y, 1) : glm::ivec3(hi);
    std::vector<Part> parts;
    for (int z = first.z; z < last.z; ++z) {
        for (int y = first.y; y < last.y; ++y) {
            for (int x = first.x; x < last.x; ++x) {
                dvec3 local = element.local(grid_.centre({x, y, z}));
                if (grid_.is_flat) local.z = 0;
                const DistanceSample sample = shape.at(local);
                const double t = -(element.scale * sample.distance / width_ + thinner_);
                if (!(t > -1)) continue;
                Part part{.cell = static_cast<std::uint32_t>(grid_.number({x, y, z})),
                          .amount = 1,
                          .slope = 0,
                          .gradient = element.turn * sample.gradient,
                          .by_scale = sample.distance - dot(sample.gradient, local)};
                if (t < 1) {
                    part.amount = 0.5 + 0.75 * (t - t * t * t / 3);
                    part.slope = -0.75 * (1 - t * t) / width_;
                }
                parts.push_back(part);
            }
        }
    }
    return parts;
}

void ElementRaster::set(std::span<const PlacedElement> elements) {
    elements_.assign(elements.begin(), elements.end());
    parts_.resize(elements.size());
    parallel_for(elements.size(), [&](std::size_t k) { parts_[k] = parts_of(elements_[k]); });
    norms_.assign(grid_.cells(), 0.0);
    overlap_ = 0;
    for (const auto& parts : parts_) {
        for (const Part& part : parts) {
            norms_[part.cell] += eighth_power(part.amount);
            overlap_ += part.amount;
        }
    }
    densities_.assign(grid_.cells(), 0.0);
    for (std::size_t e = 0; e < densities_.size(); ++e) {
        norms_[e] = std::sqrt(std::sqrt(std::sqrt(norms_[e])));
        if (use_[e] == ElementUse::free) {
            densities_[e] = std::min(norms_[e], 1.0);
            overlap_ -= densities_[e];
        } else if (use_[e] == ElementUse::solid) {
            densities_[e] = 1;
        }
    }
}

/// Returns d density / d amount.
double ElementRaster::density_slope(const Part& part) const {
    const double norm = norms_[part.cell];
    if (use_[part.cell] != ElementUse::free || !(norm < 1) || !(norm > 0)) return 0;
    return seventh_power(part.amount / norm);
}

std::vector<ElementGradient> ElementRaster::gradients(std::span<const double> by_density,
                                                      double by_overlap) const {
    std::vector<ElementGradient> gradients(elements_.size());
    parallel_for(elements_.size(), [&](std::size_t k) {
        ElementGradient& sum = gradients[k];
        for (const Part& part : parts_[k]) {
            const double slope = density_slope(part);
            const double by_distance =
                (by_density[part.cell] * slope + by_overlap * (1 - slope)) * part.slope;
            if (by_distance == 0) continue;
            const dvec3 arm = centre(part.cell) - elements_[k].at;
            sum.at -= by_distance * part.gradient;
            sum.turn -= by_distance * glm::cross(arm, part.gradient);
            sum.scale += by_distance * part.by_scale;
        }
    });
    return gradients;
}

std::vector<double> ElementRaster::shares(std::span<const double> by_cell) const {
    std::vector<double> totals(grid_.cells(), 0.0), shares(elements_.size(), 0.0);
    for (const auto& parts : parts_) {
        for (const Part& part : parts) totals[part.cell] += part.amount;
    }
    for (std::size_t k = 0; k < elements_.size(); ++k) {
        for (const Part& part : parts_[k])
            shares[k] += by_cell[part.cell] * densities_[part.cell] * part.amount / totals[part.cell];
    }
    return shares;
}

}  // namespace lamella
