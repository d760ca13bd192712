// Segments have lines as bisectors, and so have corners; a segment and a corner a parabola.
#include "printers/polygons/bisector.h"

#include <cmath>

namespace lamella {

double Quadratic::first_end(double s) const {
    const double value = at(s), slope = c1 + 2 * c2 * s;
    if (value <= 0) return slope < 0 || (slope == 0 && c2 < 0) ? s : infinity;
    const double root = slope * slope - 4 * c2 * value;
    if (root < 0) return infinity;
    if (slope < 0) return s + 2 * value / (-slope + std::sqrt(root));
    return c2 < 0 ? s + (slope + std::sqrt(root)) / (-2 * c2) : infinity;
}

Rect Bisector::reach(double from, double to) const {
    // A curve of degree two lies in the triangle of its ends and the point where their tangents meet.
    Rect box;
    for (const dvec2 p : {at(from), at(to), p0 + 0.5 * (from + to) * p1 + from * to * p2})
        box = unite(box, Rect{p, p});
    const double radius =
        std::max(length(at(from) - right->nearest(at(from))), length(at(to) - right->nearest(at(to)))) + 1;
    return {box.lo - radius, box.hi + radius};
}

Quadratic Bisector::farther(const BorderSite& site) const {
    if (site.corner && !of_segments()) {
        const dvec2 apart = site.a - corner().a;
        Quadratic result = component(corner().a, -2.0 * apart);
        result.c0 += dot(apart, apart);
        return result;
    }
    if (site.corner) {
        const dvec2 from = p0 - site.a;
        return {dot(from, from) - r0 * r0, 2 * (dot(from, p1) - r0 * r1), 1 - r1 * r1};
    }
    if (!of_corners()) {
        const Quadratic to = component(site.a, left_of(site.along)),
                        own = component(segment().a, left_of(segment().along));
        return {to.c0 - own.c0, to.c1 - own.c1, to.c2 - own.c2};
    }
    const Quadratic to = component(site.a, left_of(site.along));
    return {to.c0 * to.c0 - half * half, 2 * to.c0 * to.c1, to.c1 * to.c1 - 1};
}

std::optional<Bisector> bisector_of(const BorderSite& left, const BorderSite& right, dvec2 through) {
    Bisector result{.left = &left, .right = &right};
    if (result.of_segments()) {
        const dvec2 way = right.along - left.along;
        const double size = length(way);
        constexpr double straight = 1e-9;
        if (!(size > straight)) return {};
        result.p0 = through;
        result.p1 = way / size;
        result.r0 = right.height(through);
        result.r1 = dot(result.p1, left_of(right.along));
        return result;
    }
    if (result.of_corners()) {
        const dvec2 apart = right.a - left.a;
        const double size = length(apart);
        if (!(size > border_rounding)) return {};
        result.p0 = 0.5 * (left.a + right.a);
        result.p1 = left_of(apart) / size;
        result.half = 0.5 * size;
        return result;
    }
    // A parabola: with x along the segment, y = (x^2 + height^2) / (2 height).
    const BorderSite &segment = result.segment(), &corner = result.corner();
    const dvec2 up = left_of(segment.along);
    result.height = segment.height(corner.a);
    if (!(result.height > border_rounding)) return {};
    result.p0 = corner.a - 0.5 * result.height * up;
    result.p1 = right.corner ? -segment.along : segment.along;
    result.p2 = up / (2 * result.height);
    return result;
}

}  // namespace lamella
