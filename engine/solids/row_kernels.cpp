// The row kernels, compiled for every SIMD target. No fused operations and no approximations: each lane does
// exactly the same IEEE operations on every target, so every target gives the same bits.
#include "engine/solids/row_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/solids/row_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using FloatLanes = hn::Vec<Floats>;

/// Returns how many lines each lane is behind the first. Computed once, because it goes through memory.
HWY_INLINE hn::Vec<Ints> lane_lines(const LineFrame& frame) {
    return hn::Mul(hn::Iota(Ints(), 0), hn::Set(Ints(), frame.step));
}

/// Returns the positions across of the lines from the i-th on.
HWY_INLINE FloatLanes positions(const LineFrame& frame, hn::Vec<Ints> lane, int i) {
    const Floats d;
    const auto line = hn::ConvertTo(d, hn::Add(lane, hn::Set(Ints(), frame.first + i * frame.step)));
    return hn::Add(hn::Set(d, frame.line0), hn::Mul(line, hn::Set(d, frame.line_pitch)));
}

/// Rounds the interval from .. to (mm along) to run units, halves upward; lanes that miss get an empty run.
HWY_INLINE void store(const LineFrame& frame, FloatLanes from, FloatLanes to, hn::Mask<Floats> miss,
                      std::int32_t* begin, std::int32_t* end) {
    const Floats d;
    const Ints di;
    // Far outside any band, yet small enough for an integer.
    const auto least = hn::Set(d, -1e9F), most = hn::Set(d, 1e9F);
    const auto scale = hn::Set(d, frame.scale), shift = hn::Set(d, frame.shift), half = hn::Set(d, 0.5F);
    const auto unit0 = hn::Set(di, frame.unit0);
    const auto u = hn::Add(hn::Mul(from, scale), shift), v = hn::Add(hn::Mul(to, scale), shift);
    const auto rounded = [&](FloatLanes w) HWY_ATTR {
        return hn::ConvertTo(di, hn::Floor(hn::Add(hn::Min(hn::Max(w, least), most), half)));
    };
    const auto skip = hn::RebindMask(di, miss);
    hn::StoreU(hn::IfThenElse(skip, unit0, hn::Add(rounded(hn::Min(u, v)), unit0)), di, begin);
    hn::StoreU(hn::IfThenElse(skip, unit0, hn::Add(rounded(hn::Max(u, v)), unit0)), di, end);
}

/// A line crosses the side of the cone where a t^2 + 2 b t + c = 0; an end whose axial coordinate lies beyond
/// the side belongs to the ball there.
void cut_beam(const LineFrame& frame, const BeamInPlane& beam, int count, std::int32_t* begin,
              std::int32_t* end) {
    const Floats d;
    const auto set = [&](float v) HWY_ATTR { return hn::Set(d, v); };
    const auto zero = hn::Zero(d);
    const auto z2 = set(beam.z * beam.z), radius2 = set(beam.radius * beam.radius);
    const auto sine_radius = set(beam.radius * beam.sine),
               twice_sine_radius = set(2 * beam.radius * beam.sine);
    const auto ux = set(beam.ux), uy = set(beam.uy), qz = set(beam.qz), cos2 = set(beam.cos2);
    const auto a = set(beam.a), inverse_a = set(beam.inverse_a);
    const auto low = set(beam.low), high = set(beam.high);
    const auto ax = set(beam.ax), ay = set(beam.ay), ah = set(beam.ah);
    const auto bx = set(beam.bx), by = set(beam.by), bh = set(beam.bh);

    const auto lane = lane_lines(frame);
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int i = 0; i < count; i += lanes) {
        const auto y = positions(frame, lane, i);
        const auto q = hn::Add(hn::Mul(y, uy), qz);
        const auto b = hn::Mul(ux, hn::Sub(sine_radius, q));
        const auto off = hn::Sub(hn::Mul(hn::Add(hn::Mul(y, y), z2), cos2), hn::Mul(q, q));
        const auto c = hn::Add(hn::Sub(off, radius2), hn::Mul(twice_sine_radius, q));
        const auto disc = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
        const auto root = hn::Sqrt(hn::Max(disc, zero));
        const auto t0 = hn::Mul(hn::Sub(hn::Neg(b), root), inverse_a);
        const auto t1 = hn::Mul(hn::Sub(root, b), inverse_a);
        const auto axial0 = hn::Add(q, hn::Mul(t0, ux)), axial1 = hn::Add(q, hn::Mul(t1, ux));

        auto from = t0, to = t1;
        auto miss = hn::Lt(disc, zero);
        // Most lines leave most beams through the side only, and need no ball's root.
        const auto at_b0 = hn::Gt(axial0, high), at_b1 = hn::Gt(axial1, high), at_b = hn::Or(at_b0, at_b1);
        if (!hn::AllFalse(d, at_b)) {
            const auto yb = hn::Sub(y, by), hb = hn::Sub(bh, hn::Mul(yb, yb));
            const auto root_b = hn::Sqrt(hn::Max(hb, zero));
            from = hn::IfThenElse(at_b0, hn::Sub(bx, root_b), from);
            to = hn::IfThenElse(at_b1, hn::Add(bx, root_b), to);
            miss = hn::Or(miss, hn::And(at_b, hn::Lt(hb, zero)));
        }
        const auto at_a0 = hn::Lt(axial0, low), at_a1 = hn::Lt(axial1, low), at_a = hn::Or(at_a0, at_a1);
        if (!hn::AllFalse(d, at_a)) {
            const auto ya = hn::Sub(y, ay), ha = hn::Sub(ah, hn::Mul(ya, ya));
            const auto root_a = hn::Sqrt(hn::Max(ha, zero));
            from = hn::IfThenElse(at_a0, hn::Sub(ax, root_a), from);
            to = hn::IfThenElse(at_a1, hn::Add(ax, root_a), to);
            miss = hn::Or(miss, hn::And(at_a, hn::Lt(ha, zero)));
        }
        store(frame, from, to, miss, begin + i, end + i);
    }
}

void clip_prism(const LineFrame& frame, const PrismInPlane& prism, int count, std::int32_t* begin,
                std::int32_t* end) {
    const Floats d;
    const auto far = hn::Set(d, 1e6F);
    const auto lane = lane_lines(frame);
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int i = 0; i < count; i += lanes) {
        const auto y = positions(frame, lane, i);
        auto from = hn::Set(d, prism.low), to = hn::Set(d, prism.high);
        for (std::size_t k = 0; k < prism.nx.size(); ++k) {
            const float nx = prism.nx[k];
            const auto room = hn::Sub(hn::Set(d, prism.limit[k]), hn::Mul(hn::Set(d, prism.ny[k]), y));
            if (nx > 0) {
                to = hn::Min(to, hn::Div(room, hn::Set(d, nx)));
            } else if (nx < 0) {
                from = hn::Max(from, hn::Div(room, hn::Set(d, nx)));
            } else {
                to = hn::IfThenElse(hn::Lt(room, hn::Zero(d)), hn::Neg(far), to);
            }
        }
        store(frame, from, to, hn::Not(hn::Lt(from, to)), begin + i, end + i);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(cut_beam);
HWY_EXPORT(clip_prism);

void beam_rows(const LineFrame& frame, const BeamInPlane& beam, int count, std::int32_t* begin,
               std::int32_t* end) {
    HWY_DYNAMIC_DISPATCH(cut_beam)(frame, beam, count, begin, end);
}

void prism_rows(const LineFrame& frame, const PrismInPlane& prism, int count, std::int32_t* begin,
                std::int32_t* end) {
    HWY_DYNAMIC_DISPATCH(clip_prism)(frame, prism, count, begin, end);
}

}  // namespace lamella
#endif
