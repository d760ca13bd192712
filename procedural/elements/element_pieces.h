// Which elements hold together, and how loose ones are joined or dropped.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "procedural/elements/element_shape.h"
#include "procedural/elements/placed_element.h"

namespace lamella {

/// How deep two solids lie in each other, and where.
struct Overlap {
    double depth = -infinity;  ///< mm; negative: half of the gap between them
    dvec3 at{0};
};

/// Returns the largest of min(-a, -b) over space, of two elements' distances a and b: sampled in the boxes of
/// both, and refined to a thousandth of the smaller one. Elements that are farther than `reach` mm
/// apart may have a depth of -infinity. In the plane, at z = 0 of their frames. With a body, which cuts the
/// elements, its value counts like their distances, and much more outside of it; null: nothing is cut.
Overlap overlap_of(const PlacedElement& a, const PlacedElement& b, std::span<const ElementShapePtr> shapes,
                   double reach, bool is_flat, const Field* body = nullptr);

/// A rod between two elements, into each of which it reaches by half of its width.
struct ElementBridge {
    dvec3 from{0}, to{0};  ///< ends of its axis, mm
    friend bool operator==(const ElementBridge&, const ElementBridge&) = default;
};

/// Returns the length of the rod in all, with its round ends: more than its width.
double bridge_length(const ElementBridge& bridge, double width);
/// Returns where a stick along x has to be to become the bridge.
PlacedElement bridge_rod(const ElementBridge& bridge);

/// An element that touches one of several solids.
struct Touch {
    std::uint32_t element, solid;
};

struct JoinSettings {
    double hold = 0.1;   ///< depth from which two elements hold together, mm
    double reach = 2;    ///< widest gap that is closed, mm
    double bridge = 0;   ///< width of bridges that close gaps, mm; 0: pieces are moved
    double idle = 0.01;  ///< load below which an element carries nothing; the mean is 1
    bool is_flat = false;
    const Field* body = nullptr;  ///< as in overlap_of()
    std::uint32_t solids = 0;     ///< number of solids that are there anyway, such as those of regions
    std::vector<Touch> touches{};
    /// Puts an element that was moved back where elements may be, such as on a surface; may be empty.
    std::function<void(PlacedElement&)> settle{};
    /// Says whether two elements may hold together, or be joined, at a point; empty: everywhere.
    std::function<bool(const PlacedElement&, const PlacedElement&, dvec3)> may_hold{};
};

struct JoinedElements {
    std::vector<PlacedElement> elements;  ///< one piece
    std::vector<ElementBridge> bridges;
    std::size_t pieces = 0;              ///< before
    std::size_t moved = 0, dropped = 0;  ///< elements
    std::size_t apart = 0;               ///< solids that they do not touch, directly or by others
};

/// Makes elements one piece: that of the greatest load. Pieces all of whose elements are idle are dropped.
/// The others are joined by bridges over the narrowest gaps, or moved up to it, the nearest first; they are
/// dropped if they are out of reach, or would be torn off a solid that they touch. Loads are by element.
JoinedElements join_elements(std::vector<PlacedElement> elements, std::span<const double> loads,
                             std::span<const ElementShapePtr> shapes, const JoinSettings& settings);

}  // namespace lamella
