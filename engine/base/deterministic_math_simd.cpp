// Sines and cosines of many angles, compiled for every SIMD target.
#include <cstddef>
#include <limits>

#include "engine/base/deterministic_math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/base/deterministic_math_simd.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {

constexpr std::size_t max_lanes = 8;
#include "engine/base/lane_math-inl.h"

void SinesCosines(const double* angles, std::size_t count, SineCosine* out) {
    static_assert(sizeof(SineCosine) == 2 * sizeof(double));
    const std::size_t lanes = hn::Lanes(Doubles());
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const Lanes x = hn::LoadU(Doubles(), angles + i);
        const ReducedAngle<Lanes> a = ReduceAngle(x);
        hn::StoreInterleaved2(WithinReduction(x, SineOf(a)), WithinReduction(x, CosineOf(a)), Doubles(),
                              reinterpret_cast<double*>(out + i));
    }
    for (; i < count; ++i) out[i] = sine_cosine(angles[i]);
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(SinesCosines);

void sines_cosines(std::span<const double> angles, std::span<SineCosine> out) {
    HWY_DYNAMIC_DISPATCH(SinesCosines)(angles.data(), angles.size(), out.data());
}

}  // namespace lamella
#endif
