// ElementShape: a shape of which a part has many copies.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/field/field.h"
#include "engine/solids/beam.h"

namespace lamella {

/// A solid about the origin of a frame of its own, in mm. Immutable.
class ElementShape {
  public:
    virtual ~ElementShape() = default;
    /// Returns the signed distance from the surface, negative inside; it changes by at most 1 per mm.
    virtual double distance(dvec3 p) const = 0;
    /// Appends the intervals of t in which p + t * direction lies inside, sorted and disjoint. The direction
    /// need not have unit length.
    virtual void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const = 0;
    virtual Box bounds() const = 0;
    /// Returns the beam that the shape is, if it is one: its runs cost a tenth of what cuts do.
    virtual std::optional<Beam> beam() const { return std::nullopt; }
};
using ElementShapePtr = std::shared_ptr<const ElementShape>;

/// Returns a stick along x with round ends, `length` long in all and `width` thick. Throws InputError unless
/// the length exceeds the width.
ElementShapePtr make_stick(double length, double width);
/// Returns a ring in the xy plane: a torus, `diameter` wide in all, of a tube `width` thick. Throws
/// InputError unless it has a hole.
ElementShapePtr make_ring(double diameter, double width);
/// Returns the inside of closed polygons (where an odd number of them encloses a point) in the xy plane,
/// `thickness` thick, half of it on each side. Throws InputError for fewer than three corners or a thickness
/// that is not positive.
ElementShapePtr make_outline(std::vector<std::vector<dvec2>> polygons, double thickness);
/// Returns a field as a shape. Throws InputError for one that is unbounded, empty, or whose value tells no
/// distance.
ElementShapePtr make_field_shape(FieldPtr field);

}  // namespace lamella
