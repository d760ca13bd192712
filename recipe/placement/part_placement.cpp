// Axes from the recipe's angles and directions; surfaces and bounds where the recipe names a point or a box.
#include "recipe/placement/part_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/field/solid_search.h"
#include "procedural/skin/surface_walk.h"
#include "recipe/build/build_body.h"

namespace lamella {

namespace {

/// Returns the smallest rotation that brings a direction to -z.
glm::dmat3 laid_down(dvec3 direction) {
    const dvec3 from = direction / length(direction), to(0, 0, -1);
    const double cosine = dot(from, to);
    if (cosine == -1) return glm::dmat3({1, 0, 0}, {0, -1, 0}, {0, 0, -1});
    // I + [v] + [v]^2 / (1 + cosine), with v the cross product.
    const dvec3 v = cross(from, to);
    const glm::dmat3 skew({0, v.z, -v.y}, {-v.z, 0, v.x}, {v.y, -v.x, 0});
    return glm::dmat3(1) + skew + skew * skew * (1 / (1 + cosine));
}

FieldPtr body_of(const Recipe& recipe, const glm::dmat3& axes) {
    Gradings gradings(recipe);
    std::optional<MeshReport> mesh;
    return build_body(recipe, gradings, mesh, axes);
}

/// Returns the outward direction of the face at a point of the part.
dvec3 direction_at(const Recipe& recipe, dvec3 point) {
    const FieldPtr body = body_of(recipe, glm::dmat3(1));
    const Box box = body->bounds();
    const double size = length(box.size());
    const auto foot = foot_on_surface(*body, point, 1e-6 * size);
    if (!foot)
        throw InputError(fmt::format(
            "part.lay_on_at: no point of the surface can be told to be the nearest to ({}, {}, {}); "
            "accepted: a point on a face",
            point.x, point.y, point.z));
    return foot->normal;
}

}  // namespace

glm::dmat3 part_axes(const PartRecipe& part) {
    glm::dmat3 axes(1);
    for (int axis = 0; axis < 3; ++axis) {
        if (static_cast<int>(part.mirror) == axis + 1) axes[axis][axis] = -1;
    }
    if (part.lay_on != dvec3(0)) axes = laid_down(axes * part.lay_on) * axes;
    return part.turn == dvec3(0) ? axes : exact_axes(part.turn) * axes;
}

Recipe with_known_placement(const Recipe& recipe) {
    Recipe known = recipe;
    PartRecipe& part = known.part;
    if (!part.lay_on_at.empty()) {
        const std::vector<double>& at = part.lay_on_at.front();
        part.lay_on = direction_at(recipe, {at[0], at[1], at[2]});
        part.lay_on_at.clear();
    }
    if (part.fit != dvec3(0)) {
        const FieldPtr body = body_of(known, part_axes(part));
        const bool is_exact = part.field.empty() && part.shape != Shape::gyroid;
        const Box box = is_exact ? body->bounds() : tight_bounds(*body);
        if (box.empty()) throw InputError("part.fit: the part is empty; accepted: a part with a volume");
        double factor = infinity;
        for (int axis = 0; axis < 3; ++axis) {
            if (part.fit[axis] > 0) factor = std::min(factor, part.fit[axis] / box.size()[axis]);
        }
        part.scale *= factor;
        part.fit = dvec3(0);
    }
    return known;
}

Box tight_bounds(const Field& body) {
    constexpr int halvings = 20;
    Box box = body.bounds();
    if (box.empty() || !find_solid_point(body, box)) return box;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool is_low : {true, false}) {
            // Nothing lies between the side and `clear`; something does between the side and `met`.
            double clear = is_low ? box.lo[axis] : box.hi[axis], met = is_low ? box.hi[axis] : box.lo[axis];
            for (int k = 0; k < halvings; ++k) {
                const double middle = 0.5 * (clear + met);
                Box beyond = box;
                (is_low ? beyond.hi : beyond.lo)[axis] = middle;
                (find_solid_point(body, beyond) ? met : clear) = middle;
            }
            (is_low ? box.lo : box.hi)[axis] = clear;
        }
    }
    return box;
}

PartRecipe not_turned(PartRecipe part) {
    part.mirror = Mirror::no;
    part.lay_on = part.turn = dvec3(0);
    part.lay_on_at.clear();
    return part;
}

}  // namespace lamella
