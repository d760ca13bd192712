// Half-spaces, cylinders and slabs.
#include "recipe/pieces/cut_part.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/field/solid_search.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace lamella {

namespace {

FieldPtr side_of(const CutPlane& plane, bool above) {
    return above ? make_half_space(-plane.normal, -plane.offset)
                 : make_half_space(plane.normal, plane.offset);
}

/// Returns the space on the piece's sides of all planes but one.
std::vector<FieldPtr> other_sides(std::span<const CutPlane> planes, const PieceSides& sides,
                                  std::size_t but) {
    std::vector<FieldPtr> spaces;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (i != but) spaces.push_back(side_of(planes[i], sides[i]));
    }
    return spaces;
}

}  // namespace

CutPlane plane_of(const CutRecipe& cut, const glm::dmat3& axes) {
    const dvec3 normal = glm::normalize(axes * cut.normal);
    return {normal, dot(normal, axes * cut.at)};
}

std::vector<PieceSides> pieces_of(const FieldPtr& solid, std::span<const CutRecipe> cuts,
                                  std::span<const CutPlane> planes) {
    std::vector<PieceSides> pieces{{}};
    for (std::size_t i = 0; i < planes.size(); ++i) {
        std::vector<PieceSides> divided;
        for (const PieceSides& piece : pieces) {
            for (const bool above : {false, true}) {
                PieceSides half = piece;
                half.push_back(above);
                std::vector<FieldPtr> spaces = other_sides(planes.first(i + 1), half, planes.size());
                spaces.push_back(solid);
                if (find_solid_point(*make_intersection(std::move(spaces)), solid->bounds()))
                    divided.push_back(std::move(half));
            }
        }
        if (divided.size() == pieces.size())
            throw InputError(cuts[i].where +
                             ": the plane does not divide the part; accepted: cut.at within it, in its own "
                             "coordinates");
        pieces = std::move(divided);
    }
    return pieces;
}

CutPiece::CutPiece(std::span<const CutRecipe> cuts, std::span<const CutPlane> planes,
                   std::span<const PieceSides> pieces, std::size_t piece, const FieldPtr& outer) {
    const PieceSides& sides = pieces[piece];
    space_ = make_intersection(other_sides(planes, sides, planes.size()));
    std::vector<FieldPtr> within;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const CutRecipe& cut = cuts[i];
        const CutPlane& plane = planes[i];
        PieceSides neighbour = sides;
        neighbour[i] = !neighbour[i];
        if (std::ranges::find(pieces, neighbour) == pieces.end()) continue;
        const dvec3 inward = sides[i] ? plane.normal : -plane.normal;
        if (cut.face > 0) {
            const FieldPtr deeper =
                make_half_space(inward, dot(inward, plane.normal) * plane.offset + cut.face);
            within.push_back(deeper);
        }
        if (cut.joint == CutJoint::none) continue;
        std::vector<FieldPtr> both = other_sides(planes, sides, i);
        both.push_back(outer);
        const double radius = cut.diameter / 2;
        for (const dvec3 place : joint_places(make_intersection(std::move(both)), plane, cut)) {
            if (cut.joint == CutJoint::pins && !sides[i]) {
                pins_.push_back(
                    make_cylinder(place + inward * cut.depth, place - inward * cut.depth, radius));
                continue;
            }
            const double hole = radius + cut.clearance, deep = cut.depth + cut.clearance;
            within.push_back(make_cylinder(place - inward * cut.wall, place + inward * (deep + cut.wall),
                                           hole + cut.wall));
            holes_.push_back(make_cylinder(place - inward * cut.wall, place + inward * deep, hole));
        }
    }
    if (!within.empty()) solids_.push_back(make_intersection({outer, make_union(std::move(within))}));
}

FieldPtr CutPiece::of(const FieldPtr& part) const {
    std::vector<FieldPtr> solids = solids_;
    solids.push_back(part);
    FieldPtr piece = make_intersection({space_, make_union(std::move(solids))});
    if (!pins_.empty()) {
        std::vector<FieldPtr> with_pins = pins_;
        with_pins.push_back(std::move(piece));
        piece = make_union(std::move(with_pins));
    }
    return holes_.empty() ? piece : make_difference(std::move(piece), make_union(holes_));
}

}  // namespace lamella
