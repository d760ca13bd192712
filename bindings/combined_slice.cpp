// Runs are combined exactly; values are the minimum (union) or maximum (intersection).
#include "bindings/combined_slice.h"

#include <algorithm>
#include <vector>

#include "engine/field/slice_context.h"

namespace lamella {

void CombinedSlice::runs(const RowBand& band, Scratch& scratch, RunRows& out) const {
    const auto a = scratch.rows(), b = scratch.rows();
    a_.runs(band, scratch, *a);
    b_.runs(band, scratch, *b);
    out.clear();
    how_ == Combine::either ? unite(*a, *b, out) : intersect(*a, *b, out);
}

Interval CombinedSlice::range(const Rect& r) const {
    const Interval a = a_.range(r), b = b_.range(r);
    return how_ == Combine::either ? Interval{std::min(a.lo, b.lo), std::min(a.hi, b.hi)}
                                   : Interval{std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}

void CombinedSlice::sample(const Tile& tile, std::span<float> out) const {
    std::vector<float> other(out.size());
    a_.sample(tile, out);
    b_.sample(tile, other);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = how_ == Combine::either ? std::min(out[i], other[i]) : std::max(out[i], other[i]);
}

Rect CombinedSlice::bounds() const {
    return how_ == Combine::either ? unite(a_.bounds(), b_.bounds()) : intersect(a_.bounds(), b_.bounds());
}

}  // namespace lamella
