// The transcendental functions, written once for a single number and for SIMD lanes. Included inside a
// namespace that defines the primitives (Constant, Add, Mul, ..., PowerOfTwo, Exponent, Significand) for the
// type V: double in deterministic_math.cpp, a vector of doubles in lane_math-inl.h. Both give the same bits,
// because both do the same IEEE operations in the same order. No include guard: it is included once per
// target.

/// c0 + c1 s + c2 s^2 + ...
template <class V>
V Polynomial(V /*s*/, double c0) {
    return Constant<V>(c0);
}
template <class V, class... Rest>
V Polynomial(V s, double c0, Rest... rest) {
    return Add(Mul(Polynomial(s, rest...), s), Constant<V>(c0));
}

/// An angle as a quarter turn (0 to 3) and a remainder, with sine and cosine of the remainder: Cody and
/// Waite's reduction by pi / 2 in three parts, then Taylor polynomials on [-pi / 4, pi / 4].
template <class V>
struct ReducedAngle {
    V quarter, sine, cosine;
};

template <class V>
ReducedAngle<V> ReduceAngle(V x) {
    // pi / 2 = part_a + part_b + part_c; the first two have trailing zero bits, so that n * part is exact for
    // |n| < 2^20.
    constexpr double part_a = 0x1.921fb54400000p+0;
    constexpr double part_b = 0x1.0b4611a600000p-34;
    constexpr double part_c = 0x1.3198a2e037073p-69;
    constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
    const V n = RoundDown(Add(Mul(x, Constant<V>(two_over_pi)), Constant<V>(0.5)));
    const V r = Sub(Sub(Sub(x, Mul(n, Constant<V>(part_a))), Mul(n, Constant<V>(part_b))),
                    Mul(n, Constant<V>(part_c)));
    const V s = Mul(r, r);
    const V p = Polynomial(s, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362880.0, -1.0 / 39916800.0,
                           1.0 / 6227020800.0, -1.0 / 1307674368000.0);
    const V q = Polynomial(s, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40320.0, -1.0 / 3628800.0, 1.0 / 479001600.0,
                           -1.0 / 87178291200.0, 1.0 / 20922789888000.0);
    const V sine = Add(r, Mul(r, Mul(s, p)));
    const V cosine = Add(Sub(Constant<V>(1.0), Mul(Constant<V>(0.5), s)), Mul(Mul(s, s), q));
    const V quarter = Sub(n, Mul(Constant<V>(4.0), RoundDown(Mul(n, Constant<V>(0.25)))));
    return {quarter, sine, cosine};
}

/// Returns the value if |x| is small enough for a meaningful reduction, else NaN.
template <class V>
V WithinReduction(V x, V value) {
    return IfThenElse(Lt(Abs(x), Constant<V>(1e15)), value, Constant<V>(quiet_nan));
}

template <class V>
V SineOf(const ReducedAngle<V>& a) {
    const auto odd = Or(Eq(a.quarter, Constant<V>(1.0)), Eq(a.quarter, Constant<V>(3.0)));
    const V v = IfThenElse(odd, a.cosine, a.sine);
    return IfThenElse(Lt(Constant<V>(1.5), a.quarter), Neg(v), v);
}

template <class V>
V CosineOf(const ReducedAngle<V>& a) {
    const auto first = Eq(a.quarter, Constant<V>(1.0));
    const V v = IfThenElse(Or(first, Eq(a.quarter, Constant<V>(3.0))), a.sine, a.cosine);
    return IfThenElse(Or(first, Eq(a.quarter, Constant<V>(2.0))), Neg(v), v);
}

template <class V>
V Sine(V x) {
    return WithinReduction(x, SineOf(ReduceAngle(x)));
}

template <class V>
V Cosine(V x) {
    return WithinReduction(x, CosineOf(ReduceAngle(x)));
}

template <class V>
V Tangent(V x) {
    const ReducedAngle<V> a = ReduceAngle(x);
    const auto odd = Or(Eq(a.quarter, Constant<V>(1.0)), Eq(a.quarter, Constant<V>(3.0)));
    const V v = Div(IfThenElse(odd, Neg(a.cosine), a.sine), IfThenElse(odd, a.sine, a.cosine));
    return WithinReduction(x, v);
}

/// exp: x = k ln 2 + r, |r| <= ln 2 / 2, a Taylor polynomial of degree 13, and 2^k in two steps so that
/// subnormal results are reached.
template <class V>
V Exponential(V x) {
    constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;
    constexpr double log2_e = 0x1.71547652b82fep+0;
    const auto above = Lt(Constant<V>(709.8), x), below = Lt(x, Constant<V>(-745.2));
    const V bounded = IfThenElse(Or(above, below), Constant<V>(0.0), x);
    const V k = RoundDown(Add(Mul(bounded, Constant<V>(log2_e)), Constant<V>(0.5)));
    const V r = Sub(Sub(bounded, Mul(k, Constant<V>(ln2_high))), Mul(k, Constant<V>(ln2_low)));
    const V p =
        Polynomial(r, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0, 1.0 / 40320.0,
                   1.0 / 362880.0, 1.0 / 3628800.0, 1.0 / 39916800.0, 1.0 / 479001600.0, 1.0 / 6227020800.0);
    const V power = Add(Constant<V>(1.0), Add(r, Mul(Mul(r, r), p)));
    const V half = RoundDown(Mul(k, Constant<V>(0.5)));
    const V scaled = Mul(Mul(power, PowerOfTwo(half)), PowerOfTwo(Sub(k, half)));
    const V capped = IfThenElse(above, Constant<V>(infinite), IfThenElse(below, Constant<V>(0.0), scaled));
    return IfThenElse(Eq(x, x), capped, x);
}

/// ln: x = 2^k m with m in [sqrt(1/2), sqrt(2)), s = (m - 1) / (m + 1), and the series of artanh s.
template <class V>
V Logarithm(V x) {
    constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;
    constexpr double sqrt2 = 0x1.6a09e667f3bcdp+0, smallest_normal = 0x1p-1022;
    const auto subnormal = Lt(x, Constant<V>(smallest_normal));
    const V normal = IfThenElse(subnormal, Mul(x, Constant<V>(0x1p54)), x);
    const V m0 = Significand(normal);
    const auto upper = Lt(Constant<V>(sqrt2), m0);
    const V k0 = Sub(Exponent(normal), IfThenElse(subnormal, Constant<V>(54.0), Constant<V>(0.0)));
    const V k = Add(k0, IfThenElse(upper, Constant<V>(1.0), Constant<V>(0.0)));
    const V f = Sub(IfThenElse(upper, Mul(m0, Constant<V>(0.5)), m0), Constant<V>(1.0));
    const V s = Div(f, Add(f, Constant<V>(2.0))), z = Mul(s, s);
    const V tail = Mul(z, Polynomial(z, 2.0 / 3.0, 2.0 / 5.0, 2.0 / 7.0, 2.0 / 9.0, 2.0 / 11.0, 2.0 / 13.0,
                                     2.0 / 15.0, 2.0 / 17.0, 2.0 / 19.0, 2.0 / 21.0));
    // 2 s = f - f^2 / 2 + s f^2 / 2, so that the leading term f is exact.
    const V half_square = Mul(Mul(Constant<V>(0.5), f), f);
    const V low = Add(Mul(s, Add(half_square, tail)), Mul(k, Constant<V>(ln2_low)));
    const V result = Sub(Mul(k, Constant<V>(ln2_high)), Sub(Sub(half_square, low), f));
    const V special = IfThenElse(Eq(x, Constant<V>(0.0)), Constant<V>(-infinite), Constant<V>(quiet_nan));
    const V finite = IfThenElse(Lt(Constant<V>(0.0), x), result, special);
    return IfThenElse(Eq(x, Constant<V>(infinite)), x, finite);
}

/// atan: |x| > 1 by pi / 2 - atan(1 / x), then atan(c) + atan((x - c) / (1 + c x)) with c = 0, 1/2 or 1. The
/// remaining argument is at most 1/4, where the Taylor polynomial is accurate.
template <class V>
V Arctangent(V x) {
    constexpr double atan_half = 0x1.dac670561bb4fp-2, atan_half_low = 0x1.a2b7f222f65e2p-56;
    constexpr double quarter_pi = 0x1.921fb54442d18p-1, quarter_pi_low = 0x1.1a62633145c07p-55;
    constexpr double half_pi = 0x1.921fb54442d18p+0, half_pi_low = 0x1.1a62633145c07p-54;
    const V zero = Constant<V>(0.0), one = Constant<V>(1.0);
    const V a = Abs(x);
    const auto inverted = Lt(one, a);
    const V u = IfThenElse(inverted, Div(one, a), a);
    const auto small = Lt(u, Constant<V>(0.25)), middle = Lt(u, Constant<V>(0.75));
    const V c = IfThenElse(small, zero, IfThenElse(middle, Constant<V>(0.5), one));
    const V high =
        IfThenElse(small, zero, IfThenElse(middle, Constant<V>(atan_half), Constant<V>(quarter_pi)));
    const V low =
        IfThenElse(small, zero, IfThenElse(middle, Constant<V>(atan_half_low), Constant<V>(quarter_pi_low)));
    const V t = Div(Sub(u, c), Add(one, Mul(c, u)));
    const V z = Mul(t, t);
    const V p =
        Polynomial(z, -1.0 / 3.0, 1.0 / 5.0, -1.0 / 7.0, 1.0 / 9.0, -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0,
                   1.0 / 17.0, -1.0 / 19.0, 1.0 / 21.0, -1.0 / 23.0, 1.0 / 25.0, -1.0 / 27.0);
    const V rest = Add(low, Mul(Mul(z, p), t));
    const V direct = Add(high, Add(t, rest));
    const V turned = Sub(Constant<V>(half_pi), Sub(direct, Constant<V>(half_pi_low)));
    const V positive = IfThenElse(inverted, turned, direct);
    return IfThenElse(Lt(x, zero), Neg(positive), IfThenElse(Eq(x, zero), x, positive));
}

template <class V>
V Arcsine(V x) {
    const V one = Constant<V>(1.0);
    return Arctangent(Div(x, Sqrt(Mul(Sub(one, x), Add(one, x)))));
}

template <class V>
V Arccosine(V x) {
    const V one = Constant<V>(1.0);
    return Mul(Constant<V>(2.0), Arctangent(Sqrt(Div(Sub(one, x), Add(one, x)))));
}

/// The angle of the point (x, y); 0 at the origin. The sign of a zero does not matter.
template <class V>
V Arctangent2(V y, V x) {
    constexpr double pi_high = 0x1.921fb54442d18p+1, pi_low = 0x1.1a62633145c07p-53;
    const V zero = Constant<V>(0.0), one = Constant<V>(1.0);
    const V ay = Abs(y), ax = Abs(x);
    const V ratio = IfThenElse(Eq(ay, ax), IfThenElse(Eq(ay, zero), zero, one), Div(ay, ax));
    const V first = Arctangent(ratio);
    const V second =
        IfThenElse(Lt(x, zero), Sub(Constant<V>(pi_high), Sub(first, Constant<V>(pi_low))), first);
    return IfThenElse(Lt(y, zero), Neg(second), second);
}
