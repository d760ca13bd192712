// Defaults of Field: what can be derived from the value at a point alone.
#include "engine/field/field.h"

#include "engine/field/range_about.h"
#include "engine/field/slice_context.h"
#include "engine/field/tile_walk.h"

namespace lamella {

Interval Field::range(const Box& box) const {
    if (metric() == Metric::sign || box.empty()) return {-infinity, infinity};
    return range_about(box, value(box.center()), metric());
}

double Field::deviation(const Box& /*box*/) const { return metric() == Metric::sign ? infinity : 0; }

bool Field::clear_of_surface(dvec3 p, double distance) const {
    return metric() != Metric::sign && std::abs(value_within(p, distance)) >= distance;
}

void Field::values(std::span<const dvec3> points, std::span<double> out) const {
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = value(points[i]);
}

void Field::ranges(std::span<const Box> boxes, std::span<Interval> out) const {
    for (std::size_t i = 0; i < boxes.size(); ++i) out[i] = range(boxes[i]);
}

FieldPtr Field::offset(double /*d*/) const { return nullptr; }

const SliceField& Field::slice(SliceContext& context, double z) const {
    return context.make<SampledSlice>(*this, z);
}

}  // namespace lamella
