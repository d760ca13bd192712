// The prism kernel: a line clipped by five half-planes. Plain loops over lanes; every operation is exact
// IEEE.
#include "engine/prism_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/prism_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void clip_rows(const PrismRowParameters& prism, int count, std::int32_t* begin, std::int32_t* end) {
    const hn::ScalableTag<float> d;
    const hn::RebindToSigned<decltype(d)> di;
    // Far outside any band, yet small enough to stay an exact integer once scaled.
    const auto far = hn::Set(d, 1e6F), least = hn::Set(d, -1e9F), most = hn::Set(d, 1e9F);
    const auto scale = hn::Set(d, prism.scale), shift = hn::Set(d, prism.shift), half = hn::Set(d, 0.5F);
    const auto unit0 = hn::Set(di, prism.unit0), iota = hn::Iota(di, prism.first);
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int i = 0; i < count; i += lanes) {
        const auto line = hn::ConvertTo(d, hn::Add(iota, hn::Set(di, i)));
        const auto y = hn::Add(hn::Set(d, prism.line0), hn::Mul(line, hn::Set(d, prism.line_pitch)));
        auto from = hn::Neg(far), to = far;
        for (std::size_t k = 0; k < 5; ++k) {
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
        const auto miss = hn::Not(hn::Lt(from, to));
        const auto u = hn::Add(hn::Mul(from, scale), shift), v = hn::Add(hn::Mul(to, scale), shift);
        const auto clamp = [&](auto w) { return hn::Min(hn::Max(w, least), most); };
        const auto lo = hn::ConvertTo(di, hn::Floor(hn::Add(clamp(hn::Min(u, v)), half)));
        const auto hi = hn::ConvertTo(di, hn::Floor(hn::Add(clamp(hn::Max(u, v)), half)));
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

HWY_EXPORT(clip_rows);

void prism_rows(const PrismRowParameters& prism, int count, std::int32_t* begin, std::int32_t* end) {
    HWY_DYNAMIC_DISPATCH(clip_rows)(prism, count, begin, end);
}

}  // namespace lamella
#endif
