// SIMD versions of the primitives that transcendental-inl.h needs, and its functions. Included between
// Highway's HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE inside HWY_NAMESPACE, once per target: no include
// guard.

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors hold at most this many doubles, on any target.
using Doubles = hn::CappedTag<double, max_lanes>;
using Words = hn::RebindToUnsigned<Doubles>;
using Lanes = hn::Vec<Doubles>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double quiet_nan = std::numeric_limits<double>::quiet_NaN();

using hn::Abs;
using hn::Add;
using hn::Div;
using hn::Eq;
using hn::IfThenElse;
using hn::Lt;
using hn::Mul;
using hn::Neg;
using hn::Or;
using hn::Sqrt;
using hn::Sub;

template <class V>
HWY_INLINE V Constant(double c) {
    return hn::Set(hn::DFromV<V>(), c);
}

/// Keep the sign of zero, which targets without an instruction for rounding lose.
HWY_INLINE Lanes RoundDown(Lanes a) { return hn::CopySign(hn::Floor(a), a); }
HWY_INLINE Lanes RoundUp(Lanes a) { return hn::CopySign(hn::Ceil(a), a); }

/// 2^k for a whole k from -1022 to 1023: adding 1.5 * 2^52 brings k + 1023 to the low bits.
HWY_INLINE Lanes PowerOfTwo(Lanes k) {
    const Lanes shifted = Add(k, Constant<Lanes>(0x1.8p52 + 1023.0));
    return hn::BitCast(Doubles(), hn::ShiftLeft<52>(hn::BitCast(Words(), shifted)));
}
/// x = significand * 2^exponent, 1 <= significand < 2, for a normal positive x.
HWY_INLINE Lanes Exponent(Lanes x) {
    const auto e = hn::ShiftRight<52>(hn::BitCast(Words(), x));
    const auto biased = hn::Or(e, hn::Set(Words(), 0x4330000000000000ULL));
    return Sub(hn::BitCast(Doubles(), biased), Constant<Lanes>(0x1p52 + 1023.0));
}
HWY_INLINE Lanes Significand(Lanes x) {
    const auto fraction = hn::And(hn::BitCast(Words(), x), hn::Set(Words(), 0x000FFFFFFFFFFFFFULL));
    return hn::BitCast(Doubles(), hn::Or(fraction, hn::Set(Words(), 0x3FF0000000000000ULL)));
}

#include "engine/base/transcendental-inl.h"
