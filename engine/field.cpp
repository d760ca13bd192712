// Defaults of Field: what can be derived from the value at a point alone.
#include "engine/field.h"

#include "engine/slice_context.h"
#include "engine/tile_walk.h"

namespace lamella {

Interval Field::range(const Box& box) const {
    if (metric() == Metric::sign || box.empty()) return {-infinity, infinity};
    const dvec3 half = box.size() * 0.5;
    const double reach = std::sqrt(half.x * half.x + half.y * half.y + half.z * half.z);
    const double v = value(box.center());
    if (!(std::abs(v) > reach) || !std::isfinite(reach)) return {-infinity, infinity};
    // The value is a bound of the distance, so the sign holds within |v|; the far side is not bounded.
    if (metric() == Metric::exact) return {v - reach, v + reach};
    return v > 0 ? Interval{std::numeric_limits<double>::denorm_min(), infinity}
                 : Interval{-infinity, -std::numeric_limits<double>::denorm_min()};
}

bool Field::clear_of_surface(dvec3 p, double distance) const {
    return metric() != Metric::sign && std::abs(value_within(p, distance)) >= distance;
}

FieldPtr Field::offset(double /*d*/) const { return nullptr; }

const SliceField& Field::slice(SliceContext& context, double z) const {
    return context.make<SampledSlice>(*this, z);
}

}  // namespace lamella
