// Beam-box intersection: quick tests first, then the minimum of a convex function.
#include "procedural/foam/beam_box.h"

namespace lamella {
namespace {

/// Returns whether the segment from a to b meets the box (slab method).
bool segment_meets(dvec3 a, dvec3 b, const Box& box) {
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const double step = b[axis] - a[axis];
        if (step == 0) {
            if (a[axis] < box.lo[axis] || a[axis] > box.hi[axis]) return false;
            continue;
        }
        const double s = (box.lo[axis] - a[axis]) / step, t = (box.hi[axis] - a[axis]) / step;
        enter = std::max(enter, std::min(s, t));
        leave = std::min(leave, std::max(s, t));
    }
    return enter <= leave;
}

}  // namespace

bool touches(const Beam& beam, const Box& box) {
    if (box.empty() || intersect(bounds(beam), box).empty()) return false;
    if (segment_meets(beam.a, beam.b, box)) return true;
    const auto gap = [&](double t) {
        return distance(box, beam.a + (beam.b - beam.a) * t) - (beam.ra + (beam.rb - beam.ra) * t);
    };
    double lo = 0, hi = 1;
    if (gap(lo) <= 0 || gap(hi) <= 0) return true;
    // Ternary search: the minimum of a convex function stays in the part that contains the lower of two inner
    // values.
    for (int step = 0; step < 100; ++step) {
        const double s = lo + (hi - lo) / 3, t = hi - (hi - lo) / 3;
        const double at_s = gap(s), at_t = gap(t);
        if (at_s <= 0 || at_t <= 0) return true;
        if (at_s < at_t) {
            hi = t;
        } else {
            lo = s;
        }
    }
    return false;
}

}  // namespace lamella
