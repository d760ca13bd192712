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
            return {root_3, 2, -root_2, 1.5, 1.4357};
        case TpmsKind::schwarz_p:
            return {root_3, 1, -1, 3, 2.6573};
        case TpmsKind::schwarz_d:
            return {root_3, 2, -1, root_2, 1.3316};
        case TpmsKind::neovius:
            break;
    }
    return {7, 7, -0.75, 13, 2.5457};
}

TpmsPoint tpms_point(dvec3 p) { return {sine_cosine(p.x), sine_cosine(p.y), sine_cosine(p.z)}; }

TpmsPoint tpms_point_beside(const TpmsPoint& point, dvec3 offset) {
    const auto turned = [](const SineCosine& from, double by) {
        const SineCosine turn = sine_cosine(by);
        return SineCosine{from.sine * turn.cosine + from.cosine * turn.sine,
                          from.cosine * turn.cosine - from.sine * turn.sine};
    };
    return {turned(point.x, offset.x), turned(point.y, offset.y), turned(point.z, offset.z)};
}

TpmsSample tpms_sample(TpmsKind kind, const TpmsPoint& point) {
    const auto& [sx, cx] = point.x;
    const auto& [sy, cy] = point.y;
    const auto& [sz, cz] = point.z;
    switch (kind) {
        case TpmsKind::gyroid:
            return {sx * cy + sy * cz + sz * cx, {cx * cy - sz * sx, cy * cz - sx * sy, cz * cx - sy * sz}};
        case TpmsKind::schwarz_p:
            return {cx + cy + cz, {-sx, -sy, -sz}};
        case TpmsKind::schwarz_d:
            return {sx * (sy * sz + cy * cz) + cx * (sy * cz + cy * sz),
                    {cx * (sy * sz + cy * cz) - sx * (sy * cz + cy * sz),
                     cy * (sx * sz + cx * cz) - sy * (sx * cz + cx * sz),
                     cz * (sx * sy + cx * cy) - sz * (sx * cy + cx * sy)}};
        case TpmsKind::neovius:
            break;
    }
    return {3 * (cx + cy + cz) + 4 * cx * cy * cz,
            {-sx * (3 + 4 * cy * cz), -sy * (3 + 4 * cz * cx), -sz * (3 + 4 * cx * cy)}};
}

glm::dmat3 tpms_hessian(TpmsKind kind, const TpmsPoint& point) {
    const auto& [sx, cx] = point.x;
    const auto& [sy, cy] = point.y;
    const auto& [sz, cz] = point.z;
    const auto symmetric = [](dvec3 diagonal, double xy, double yz, double zx) {
        return glm::dmat3({diagonal.x, xy, zx}, {xy, diagonal.y, yz}, {zx, yz, diagonal.z});
    };
    switch (kind) {
        case TpmsKind::gyroid:
            return symmetric({-sx * cy - sz * cx, -sy * cz - sx * cy, -sz * cx - sy * cz}, -cx * sy, -cy * sz,
                             -cz * sx);
        case TpmsKind::schwarz_p:
            return symmetric({-cx, -cy, -cz}, 0, 0, 0);
        case TpmsKind::schwarz_d: {
            const double g = tpms_sample(kind, point).g;
            return symmetric(dvec3(-g), cx * (cy * sz - sy * cz) - sx * (cy * cz - sy * sz),
                             cy * (cz * sx - sz * cx) - sy * (cz * cx - sz * sx),
                             cz * (cx * sy - sx * cy) - sz * (cx * cy - sx * sy));
        }
        case TpmsKind::neovius:
            break;
    }
    return symmetric({-cx * (3 + 4 * cy * cz), -cy * (3 + 4 * cz * cx), -cz * (3 + 4 * cx * cy)},
                     4 * sx * sy * cz, 4 * sy * sz * cx, 4 * sz * sx * cy);
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
