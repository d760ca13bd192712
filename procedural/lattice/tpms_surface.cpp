// Waves by collecting the terms in one angle; ranges by interval arithmetic and by the maximum gradient.
#include "procedural/lattice/tpms_surface.h"

namespace lamella {
namespace {

constexpr double root_2 = 1.4142135623730951;
constexpr double root_3 = 1.7320508075688772;
// Upper bound of the error of sines of angles up to some thousand turns.
constexpr double sine_error = 1e-11;

Interval operator+(Interval a, Interval b) { return {a.lo + b.lo, a.hi + b.hi}; }

Interval operator*(Interval a, Interval b) {
    const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}

Interval operator*(double k, Interval a) { return Interval{k, k} * a; }

/// Returns bounds of the cosine over an interval of angles.
Interval cosine_range(Interval angles) {
    if (!(angles.width() < 2 * pi)) return {-1, 1};
    const double first = sine_cosine(angles.lo).cosine, last = sine_cosine(angles.hi).cosine;
    Interval range{std::min(first, last), std::max(first, last)};
    // Maxima are at 2 pi n, minima at pi + 2 pi n. If rounding leaves it in doubt, the extremum is included.
    const auto holds_turn = [&](double at) {
        return std::floor((angles.hi - at) / (2 * pi) + sine_error) >=
               std::ceil((angles.lo - at) / (2 * pi) - sine_error);
    };
    if (holds_turn(0)) range.hi = 1;
    if (holds_turn(pi)) range.lo = -1;
    return {std::max(range.lo - sine_error, -1.0), std::min(range.hi + sine_error, 1.0)};
}

Interval sine_range(Interval angles) { return cosine_range({angles.lo - pi / 2, angles.hi - pi / 2}); }

Interval interval_range(TpmsKind kind, const Box& angles) {
    const Interval x{angles.lo.x, angles.hi.x}, y{angles.lo.y, angles.hi.y}, z{angles.lo.z, angles.hi.z};
    const Interval cx = cosine_range(x), cy = cosine_range(y), cz = cosine_range(z);
    if (kind == TpmsKind::schwarz_p) return cx + cy + cz;
    if (kind == TpmsKind::neovius) return 3.0 * (cx + cy + cz) + 4.0 * (cx * cy * cz);
    const Interval sx = sine_range(x), sy = sine_range(y), sz = sine_range(z);
    if (kind == TpmsKind::gyroid) return sx * cy + sy * cz + sz * cx;
    return sx * sy * sz + sx * cy * cz + cx * sy * cz + cx * cy * sz;
}

}  // namespace

TpmsConstants tpms_constants(TpmsKind kind) {
    switch (kind) {
        case TpmsKind::gyroid:
            return {root_3, root_2, root_3, -root_2, 1.5};
        case TpmsKind::schwarz_p:
            return {root_3, 1, root_3, -1, 3};
        case TpmsKind::schwarz_d:
            return {root_3, root_2, root_3, -1, root_2};
        case TpmsKind::neovius:
            break;
    }
    return {7, 7, 3 * root_3, -0.75, 13};
}

Wave tpms_wave(TpmsKind kind, Axis axis, const SineCosine& across, const SineCosine& z) {
    const double s = across.sine, c = across.cosine;
    switch (kind) {
        case TpmsKind::gyroid:
            if (axis == Axis::x) return {c, z.sine, s * z.cosine};
            return {z.cosine, s, z.sine * c};
        case TpmsKind::schwarz_p:
            return {0, 1, c + z.cosine};
        case TpmsKind::schwarz_d:
            return {s * z.sine + c * z.cosine, s * z.cosine + c * z.sine, 0};
        case TpmsKind::neovius:
            break;
    }
    return {0, 3 + 4 * (c * z.cosine), 3 * (c + z.cosine)};
}

Interval tpms_range(TpmsKind kind, const Box& angles) {
    Interval range = interval_range(kind, angles);
    const dvec3 half = angles.size() * 0.5;
    const double reach = std::sqrt(glm::dot(half, half));
    // Beyond a quarter turn, interval arithmetic is tighter.
    if (reach < pi / 2) {
        const dvec3 p = angles.center();
        const double g = tpms_wave(kind, Axis::x, sine_cosine(p.y), sine_cosine(p.z)).at(sine_cosine(p.x));
        const double change = tpms_constants(kind).steepest * reach + sine_error;
        range = {std::max(range.lo, g - change), std::min(range.hi, g + change)};
    }
    return range;
}

}  // namespace lamella
