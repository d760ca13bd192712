// Matrices of a stretch, and bounding boxes of mapped boxes.
#include "procedural/voronoi/stretch.h"

#include <cmath>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"

namespace lamella {

Stretch::Stretch(const glm::dmat3& axes, dvec3 factors) {
    for (int i = 0; i < 3; ++i) {
        if (!(factors[i] > 0) || !std::isfinite(factors[i])) {
            throw InputError("a stretch needs three positive, finite factors");
        }
    }
    identity_ = factors == dvec3(1.0);
    const glm::dmat3 back = glm::transpose(axes);
    glm::dmat3 scale(1.0), unscale(1.0);
    for (int i = 0; i < 3; ++i) {
        scale[i][i] = factors[i];
        unscale[i][i] = 1 / factors[i];
    }
    forward_ = axes * scale * back;
    inverse_ = axes * unscale * back;
    seeds_per_part_ = 1 / std::min({factors.x, factors.y, factors.z});
    part_per_seeds_ = std::max({factors.x, factors.y, factors.z});
}

Stretch Stretch::turned(const glm::dmat3& axes) const {
    if (axes == glm::dmat3(1)) return *this;
    Stretch both = *this;
    both.identity_ = false;
    both.forward_ = axes * forward_;
    both.inverse_ = inverse_ * glm::transpose(axes);
    return both;
}

Box Stretch::image(const glm::dmat3& map, const Box& box) {
    const dvec3 center = map * box.center(), half = box.size() * 0.5;
    dvec3 reach(0.0);
    for (int i = 0; i < 3; ++i) reach += glm::abs(map[i]) * half[i];
    // Slightly more than the image, to cover the rounding of the map.
    const double slack = 1e-12 * std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z),
                                           reach.x, reach.y, reach.z});
    return {center - reach - slack, center + reach + slack};
}

glm::dmat3 turned_axes(dvec3 degrees) {
    constexpr double radian = 3.14159265358979323846 / 180;
    const SineCosine x = sine_cosine(degrees.x * radian), y = sine_cosine(degrees.y * radian),
                     z = sine_cosine(degrees.z * radian);
    const glm::dmat3 about_x({1, 0, 0}, {0, x.cosine, x.sine}, {0, -x.sine, x.cosine});
    const glm::dmat3 about_y({y.cosine, 0, -y.sine}, {0, 1, 0}, {y.sine, 0, y.cosine});
    const glm::dmat3 about_z({z.cosine, z.sine, 0}, {-z.sine, z.cosine, 0}, {0, 0, 1});
    return about_z * about_y * about_x;
}

}  // namespace lamella
