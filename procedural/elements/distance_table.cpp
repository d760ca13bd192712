// Samples of a shape, and the derivative of their interpolation.
#include "procedural/elements/distance_table.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"

namespace lamella {

DistanceTable::DistanceTable(const ElementShape& shape, double margin, int samples, bool is_flat)
    : is_flat_(is_flat) {
    Box box = shape.bounds();
    if (is_flat) box.lo.z = box.hi.z = 0;
    for (int k = 0; k < 8; ++k) {
        const dvec3 corner((k & 1) != 0 ? box.hi.x : box.lo.x, (k & 2) != 0 ? box.hi.y : box.lo.y,
                           (k & 4) != 0 ? box.hi.z : box.lo.z);
        reach_ = std::max(reach_, length(corner));
    }
    const dvec3 whole = box.size() + 2 * margin;
    step_ = std::max({whole.x, whole.y, is_flat ? 0 : whole.z}) / (samples - 1);
    corner_ = box.lo - margin;
    size_ = glm::ivec3(glm::ceil(whole / step_)) + 1;
    if (is_flat) {
        corner_.z = 0;
        size_.z = 1;
    }
    samples_.resize(number({0, 0, size_.z}));
    parallel_for(static_cast<std::size_t>(size_.z) * static_cast<std::size_t>(size_.y), [&](std::size_t row) {
        const auto y = static_cast<int>(row) % size_.y, z = static_cast<int>(row) / size_.y;
        for (int x = 0; x < size_.x; ++x)
            samples_[number({x, y, z})] = shape.distance(corner_ + step_ * dvec3(x, y, z));
    });
    // A sample stands for a cube, in which the surface is a plane, at most half a step away.
    for (const double distance : samples_) {
        content_ += std::clamp(0.5 - distance / step_, 0.0, 1.0);
        thickness_ = std::max(thickness_, -2 * distance);
    }
    content_ *= is_flat ? step_ * step_ : step_ * step_ * step_;
}

DistanceSample DistanceTable::at(dvec3 p) const {
    const dvec3 in_steps = (p - corner_) / step_;
    const glm::dvec3 floor = glm::floor(in_steps);
    const glm::ivec3 cell(floor);
    const dvec3 share = in_steps - floor;
    const int planes = is_flat_ ? 1 : 2;
    for (int axis = 0; axis < planes + 1; ++axis) {
        if (!(floor[axis] >= 0) || !(floor[axis] < size_[axis] - 1)) return {};
    }
    DistanceSample sample{0, dvec3(0)};
    for (int k = 0; k < 4 * planes; ++k) {
        const glm::ivec3 corner(k & 1, k >> 1 & 1, k >> 2);
        const double here =
            samples_[number({cell.x + corner.x, cell.y + corner.y, is_flat_ ? 0 : cell.z + corner.z})];
        dvec3 weight(corner.x != 0 ? share.x : 1 - share.x, corner.y != 0 ? share.y : 1 - share.y,
                     corner.z != 0 ? share.z : 1 - share.z);
        dvec3 slope(corner.x != 0 ? 1 : -1, corner.y != 0 ? 1 : -1, corner.z != 0 ? 1 : -1);
        if (is_flat_) {
            weight.z = 1;
            slope.z = 0;
        }
        sample.distance += here * weight.x * weight.y * weight.z;
        sample.gradient += here * dvec3(slope.x * weight.y * weight.z, weight.x * slope.y * weight.z,
                                        weight.x * weight.y * slope.z);
    }
    sample.gradient /= step_;
    return sample;
}

}  // namespace lamella
