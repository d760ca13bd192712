// Sections parallel to the plane, all eroded by a hole with its wall, and what they have in common.
#include "recipe/pieces/joint_places.h"

#include <fmt/format.h>

#include <optional>

#include "engine/base/error.h"
#include "engine/contours/contours.h"
#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "printers/polygons/placed_polygons.h"
#include "printers/vector/dowel_places.h"

namespace lamella {

namespace {

constexpr double tolerance = 0.1;  // mm, of the sections' contours

/// Returns rows of unit vectors whose last one is the normal: they turn it to z.
glm::dmat3 upright(dvec3 normal) {
    if (normal == dvec3(0, 0, 1)) return glm::dmat3(1);
    const dvec3 other = std::abs(normal.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
    const dvec3 a = glm::normalize(cross(other, normal)), b = cross(normal, a);
    return glm::transpose(glm::dmat3(a, b, normal));
}

}  // namespace

std::vector<dvec3> joint_places(const FieldPtr& solid, const CutPlane& plane, const CutRecipe& cut) {
    // Sections of the solid as it stands are exact; others are sampled.
    const bool is_flipped = plane.normal == dvec3(0, 0, -1);
    const glm::dmat3 turn = upright(is_flipped ? -plane.normal : plane.normal);
    const double height = is_flipped ? -plane.offset : plane.offset;
    const FieldPtr turned = turn == glm::dmat3(1) ? solid : make_transform(solid, turn, dvec3(0));
    const double reach = cut.depth + cut.wall;
    const double radius = cut.diameter / 2 + cut.clearance + cut.wall + tolerance;
    constexpr int sections = 6;  // on either side of the plane
    std::optional<Polygons> clear;
    Rect middle;
    for (int i = -sections; i <= sections && !(clear && clear->empty()); ++i) {
        SliceContext context;
        Scratch scratch;
        const double z = height + reach * i / sections;
        const Polygons section = to_polygons(trace_contours(context.slice(*turned, z), tolerance, scratch));
        Polygons room = erode_polygons(section, radius);
        if (i == 0) middle = box_of(section);
        clear = clear ? intersect_polygons(*clear, room) : std::move(room);
    }
    std::vector<dvec2> places;
    const int fewest = cut.joints > 0 ? cut.joints : 2;
    for (int count = cut.joints > 0 ? cut.joints : 3; count >= fewest && !clear->empty(); --count) {
        places = dowel_places(*clear, middle.center(), count, cut.diameter);
        if (places.size() == static_cast<std::size_t>(count)) break;
    }
    if (places.size() < static_cast<std::size_t>(fewest)) {
        throw InputError(fmt::format(
            "{}: there is no room for {} joints of {} mm that reach {} mm into both pieces, with {} mm of "
            "material around them; accepted: a smaller cut.diameter, depth or wall, or joint = \"none\"",
            cut.where, fewest, cut.diameter, cut.depth, cut.wall));
    }
    std::vector<dvec3> middles;
    middles.reserve(places.size());
    for (const dvec2& place : places)
        middles.push_back(glm::transpose(turn) * dvec3(place.x, place.y, height));
    return middles;
}

}  // namespace lamella
