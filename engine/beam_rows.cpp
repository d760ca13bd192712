// The beam kernel, compiled for every SIMD target. No fused operations and no approximations: each lane does
// exactly the same IEEE operations on every target, so every target gives the same bits.
#include "engine/beam_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/beam_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void rows(const BeamRowParameters& beam, int count, std::int32_t* begin, std::int32_t* end) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto set = [&](float v) { return hn::Set(d, v); };
    const auto zero = hn::Zero(d);
    const auto z2 = set(beam.z * beam.z), cone_c = set(beam.radius * beam.radius);
    const auto sine_radius = set(beam.radius * beam.sine),
               twice_sine_radius = set(2 * beam.radius * beam.sine);
    const auto ux = set(beam.ux), uy = set(beam.uy), qz = set(beam.qz), cos2 = set(beam.cos2);
    const auto a = set(beam.a), inverse_a = set(beam.inverse_a);
    const auto low = set(beam.low), high = set(beam.high);
    const auto ax = set(beam.ax), ay = set(beam.ay), ah = set(beam.ah);
    const auto bx = set(beam.bx), by = set(beam.by), bh = set(beam.bh);
    const auto scale = set(beam.scale), shift = set(beam.shift), half = set(0.5F);
    const auto unit0 = hn::Set(di, beam.unit0);
    const auto iota = hn::Iota(di, beam.first);

    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int i = 0; i < count; i += lanes) {
        const auto line = hn::ConvertTo(d, hn::Add(iota, hn::Set(di, i)));
        const auto y = hn::Add(set(beam.line0), hn::Mul(line, set(beam.line_pitch)));
        const auto q = hn::Add(hn::Mul(y, uy), qz);
        const auto b = hn::Mul(ux, hn::Sub(sine_radius, q));
        const auto off = hn::Sub(hn::Mul(hn::Add(hn::Mul(y, y), z2), cos2), hn::Mul(q, q));
        const auto c = hn::Add(hn::Sub(off, cone_c), hn::Mul(twice_sine_radius, q));
        const auto disc = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
        const auto root = hn::Sqrt(hn::Max(disc, zero));
        const auto t0 = hn::Mul(hn::Sub(hn::Neg(b), root), inverse_a);
        const auto t1 = hn::Mul(hn::Sub(root, b), inverse_a);
        const auto axial0 = hn::Add(q, hn::Mul(t0, ux)), axial1 = hn::Add(q, hn::Mul(t1, ux));

        const auto ya = hn::Sub(y, ay), yb = hn::Sub(y, by);
        const auto ha = hn::Sub(ah, hn::Mul(ya, ya)), hb = hn::Sub(bh, hn::Mul(yb, yb));
        const auto root_a = hn::Sqrt(hn::Max(ha, zero)), root_b = hn::Sqrt(hn::Max(hb, zero));
        const auto at_a0 = hn::Lt(axial0, low), at_b0 = hn::Gt(axial0, high);
        const auto at_a1 = hn::Lt(axial1, low), at_b1 = hn::Gt(axial1, high);
        const auto from =
            hn::IfThenElse(at_a0, hn::Sub(ax, root_a), hn::IfThenElse(at_b0, hn::Sub(bx, root_b), t0));
        const auto to =
            hn::IfThenElse(at_a1, hn::Add(ax, root_a), hn::IfThenElse(at_b1, hn::Add(bx, root_b), t1));
        const auto miss_a = hn::And(hn::Or(at_a0, at_a1), hn::Lt(ha, zero));
        const auto miss_b = hn::And(hn::Or(at_b0, at_b1), hn::Lt(hb, zero));
        const auto miss = hn::Or(hn::Lt(disc, zero), hn::Or(miss_a, miss_b));

        const auto u = hn::Add(hn::Mul(from, scale), shift), v = hn::Add(hn::Mul(to, scale), shift);
        const auto lo = hn::ConvertTo(di, hn::Floor(hn::Add(hn::Min(u, v), half)));
        const auto hi = hn::ConvertTo(di, hn::Floor(hn::Add(hn::Max(u, v), half)));
        const auto skip = hn::RebindMask(di, miss);
        hn::StoreU(hn::IfThenElse(skip, unit0, hn::Add(lo, unit0)), di, begin + i);
        hn::StoreU(hn::IfThenElse(skip, unit0, hn::Add(hi, unit0)), di, end + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(rows);

void beam_rows(const BeamRowParameters& beam, int count, std::int32_t* begin, std::int32_t* end) {
    HWY_DYNAMIC_DISPATCH(rows)(beam, count, begin, end);
}

}  // namespace lamella
#endif
