// Defaults of Field: what can be derived from the value at a point alone.
#include "engine/field.h"

#include "engine/range_about.h"
#include "engine/slice_context.h"
#include "engine/tile_walk.h"

namespace lamella {

Interval Field::range(const Box& box) const {
    if (metric() == Metric::sign || box.empty()) return {-infinity, infinity};
    return range_about(box, value(box.center()), metric());
}

bool Field::clear_of_surface(dvec3 p, double distance) const {
    return metric() != Metric::sign && std::abs(value_within(p, distance)) >= distance;
}

FieldPtr Field::offset(double /*d*/) const { return nullptr; }

const SliceField& Field::slice(SliceContext& context, double z) const {
    return context.make<SampledSlice>(*this, z);
}

}  // namespace lamella
