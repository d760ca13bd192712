// Cuts in closed form for sticks, rings and outlines, by steps of the distance for fields.
#include "procedural/elements/element_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/error.h"

namespace lamella {

namespace {

/// Returns the interval of t in which a line lies inside a box; empty if it misses it.
Interval cut_box(const Box& box, dvec3 p, dvec3 direction) {
    Interval inside{-infinity, infinity};
    for (int axis = 0; axis < 3; ++axis) {
        const double step = direction[axis];
        if (step == 0) {
            if (p[axis] < box.lo[axis] || p[axis] > box.hi[axis]) return {};
            continue;
        }
        const double a = (box.lo[axis] - p[axis]) / step, b = (box.hi[axis] - p[axis]) / step;
        inside = {std::max(inside.lo, std::min(a, b)), std::min(inside.hi, std::max(a, b))};
    }
    return inside;
}

class Stick : public ElementShape {
  public:
    Stick(double length, double width)
        : beam_{{0.5 * (width - length), 0, 0}, 0.5 * width, {0.5 * (length - width), 0, 0}, 0.5 * width} {}
    double distance(dvec3 p) const override { return signed_distance(beam_, p); }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override {
        const double speed = length(direction);
        if (const auto found = lamella::cut(beam_, p, direction / speed))
            inside.push_back({found->lo / speed, found->hi / speed});
    }
    Box bounds() const override { return lamella::bounds(beam_); }
    std::optional<Beam> beam() const override { return beam_; }

  private:
    Beam beam_;
};

class Outline : public ElementShape {
  public:
    Outline(std::vector<std::vector<dvec2>> polygons, double thickness)
        : polygons_(std::move(polygons)), half_(0.5 * thickness) {
        for (const auto& polygon : polygons_) {
            for (const dvec2 corner : polygon)
                bounds_ = {glm::min(bounds_.lo, dvec3(corner, -half_)),
                           glm::max(bounds_.hi, dvec3(corner, half_))};
        }
    }
    double distance(dvec3 p) const override {
        const double in_plane = plane_distance(dvec2(p)), up = std::abs(p.z) - half_;
        if (in_plane <= 0 || up <= 0) return std::max(in_plane, up);
        return length(dvec2(in_plane, up));
    }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override;
    Box bounds() const override { return bounds_; }

  private:
    /// Calls visit(a, b) for each side.
    template <typename Visit>
    void for_sides(const Visit& visit) const {
        for (const auto& polygon : polygons_) {
            for (std::size_t i = 0; i < polygon.size(); ++i)
                visit(polygon[i], polygon[(i + 1) % polygon.size()]);
        }
    }
    double plane_distance(dvec2 p) const {
        double nearest = infinity;
        bool is_inside = false;
        for_sides([&](dvec2 a, dvec2 b) {
            const dvec2 way = b - a;
            const double square = dot(way, way);
            const double t = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0;
            nearest = std::min(nearest, squared_length(p - a - t * way));
            if ((a.y <= p.y) != (b.y <= p.y) && (cross(way, p - a) > 0) == (b.y > a.y))
                is_inside = !is_inside;
        });
        return is_inside ? -std::sqrt(nearest) : std::sqrt(nearest);
    }

    std::vector<std::vector<dvec2>> polygons_;
    double half_;
    Box bounds_;
};

/// Crossings with sides pair up along the line; a corner belongs to one of its sides.
void Outline::cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const {
    const Interval slab = cut_box(bounds_, p, direction);
    if (slab.empty()) return;
    const dvec2 at(p), way(direction);
    if (way == dvec2(0)) {
        if (plane_distance(at) < 0) inside.push_back(slab);
        return;
    }
    std::vector<double> crossings;
    for_sides([&](dvec2 a, dvec2 b) {
        const double from = cross(way, a - at), to = cross(way, b - at);
        if ((from <= 0) == (to <= 0)) return;
        const dvec2 on_side = a + (b - a) * (from / (from - to));
        crossings.push_back(dot(on_side - at, way) / dot(way, way));
    });
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const Interval part{std::max(crossings[i], slab.lo), std::min(crossings[i + 1], slab.hi)};
        if (part.lo < part.hi) inside.push_back(part);
    }
}

/// Returns where a function whose values at `a` and `b` have opposite signs is 0, to a billionth of their
/// distance: the Illinois variant of the false position (Dowell and Jarratt 1971).
template <typename Function>
double root_between(const Function& function, double a, double at_a, double b, double at_b) {
    constexpr int most = 60;
    const double enough = 1e-9 * std::abs(b - a);
    int last_side = 0;
    for (int k = 0; k < most && std::abs(b - a) > enough; ++k) {
        const double t = b + (a - b) * (at_b / (at_b - at_a)), value = function(t);
        if (value == 0) return t;
        const int side = (value < 0) == (at_b < 0) ? 1 : -1;
        if (side > 0) {
            b = t;
            at_b = value;
            if (last_side == side) at_a *= 0.5;
        } else {
            a = t;
            at_a = value;
            if (last_side == side) at_b *= 0.5;
        }
        last_side = side;
    }
    return b;
}

/// A torus. With t counted from the point of a line that is nearest to the middle, it lies inside where a
/// quartic without a cubic term is negative:
///     (|q|^2 + R^2 - r^2)^2 - 4 R^2 (q_x^2 + q_y^2) = t^4 + c2 t^2 + c1 t + c0.
class Ring : public ElementShape {
  public:
    Ring(double diameter, double width) : large_(0.5 * (diameter - width)), small_(0.5 * width) {}
    double distance(dvec3 p) const override { return length(dvec2(length(dvec2(p)) - large_, p.z)) - small_; }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override;
    Box bounds() const override {
        const dvec3 half(large_ + small_, large_ + small_, small_);
        return {-half, half};
    }

  private:
    /// Whether a part of a line is nearer to the axis than the tube: the distance is greatest at an end.
    bool in_hole(dvec3 p, dvec3 way, const Interval& part) const {
        const double hole = (large_ - small_) * (1 - 1e-6);
        const dvec2 a(p + part.lo * way), b(p + part.hi * way);
        return std::max(squared_length(a), squared_length(b)) < hole * hole;
    }

    double large_, small_;
};

void Ring::cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const {
    // A little more than the ball around it, which it touches along its equator.
    const double speed = length(direction), outside = (large_ + small_) * (1 + 1e-6);
    const dvec3 way = direction / speed;
    const double nearest = -dot(p, way);
    const dvec3 middle = p + nearest * way;
    const double square = squared_length(middle);
    if (!(square < outside * outside)) return;
    // The part of the line in the ball, and between the planes that touch the tube.
    const double reach = std::sqrt(outside * outside - square);
    Interval part{-reach, reach};
    const double thick = small_ * (1 + 1e-6);
    if (way.z != 0) {
        const double a = (-thick - middle.z) / way.z, b = (thick - middle.z) / way.z;
        part = {std::max(part.lo, std::min(a, b)), std::min(part.hi, std::max(a, b))};
    } else if (std::abs(middle.z) > thick) {
        return;
    }
    if (!(part.lo < part.hi) || in_hole(middle, way, part)) return;
    const double k = square + large_ * large_ - small_ * small_, four = 4 * large_ * large_;
    const double c2 = 2 * k - four * (1 - way.z * way.z), c1 = 2 * four * middle.z * way.z,
                 c0 = k * k - four * (square - middle.z * middle.z);
    const auto value = [&](double t) { return (t * t + c2) * t * t + c1 * t + c0; };
    const auto slope = [&](double t) { return (4 * t * t + 2 * c2) * t + c1; };
    // The slope is monotone between these, the value between the roots of the slope.
    const double bend = c2 < 0 ? std::sqrt(-c2 / 6) : 0;
    std::array<double, 5> turns{part.lo};
    std::size_t count = 1;
    double from = part.lo;
    for (double to : {-bend, bend, part.hi}) {
        to = std::min(to, part.hi);
        if (to > from && (slope(from) < 0) != (slope(to) < 0))
            turns[count++] = root_between(slope, from, slope(from), to, slope(to));
        from = std::max(from, to);
    }
    turns[count++] = part.hi;
    std::optional<double> begin;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double a = value(turns[i]), b = value(turns[i + 1]);
        if ((a < 0) == (b < 0)) continue;
        const double t = nearest + root_between(value, turns[i], a, turns[i + 1], b);
        if (b < 0) {
            begin = t;
        } else if (begin) {
            inside.push_back({*begin / speed, t / speed});
        }
    }
}

class FieldShape : public ElementShape {
    /// A place along a line, and the distance there.
    struct Crossing {
        double t, value;
    };

  public:
    explicit FieldShape(FieldPtr field)
        : field_(std::move(field)), bounds_(field_->bounds()), least_step_(1e-4 * length(bounds_.size())) {}
    double distance(dvec3 p) const override { return field_->value(p); }
    void cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const override;
    Box bounds() const override { return bounds_; }

  private:
    double border(dvec3 p, dvec3 way, const Crossing& a, const Crossing& b) const {
        return root_between([&](double t) { return field_->value(p + t * way); }, a.t, a.value, b.t, b.value);
    }

    FieldPtr field_;
    Box bounds_;
    double least_step_;
};

/// No surface is nearer than the distance tells: steps of its length miss nothing but what a least step does.
void FieldShape::cut(dvec3 p, dvec3 direction, std::vector<Interval>& inside) const {
    const double speed = length(direction);
    const dvec3 way = direction / speed;
    const Box about{bounds_.lo - least_step_, bounds_.hi + least_step_};
    const Interval whole = cut_box(about, p, way);
    if (whole.empty()) return;
    Crossing last{whole.lo, field_->value(p + whole.lo * way)};
    double begin = 0;
    bool was_inside = false;
    for (double t = whole.lo;;) {
        const double value = field_->value(p + t * way);
        const bool is_inside = value < 0 && t < whole.hi;
        const Crossing here{t, value};
        if (is_inside && !was_inside) begin = border(p, way, last, here);
        if (!is_inside && was_inside) inside.push_back({begin / speed, border(p, way, here, last) / speed});
        if (t >= whole.hi) return;
        was_inside = is_inside;
        last = here;
        t = std::min(t + std::max(std::abs(value), least_step_), whole.hi);
    }
}

void check_sizes(const char* name, double large, double small, const char* right) {
    if (small > 0 && large > small && std::isfinite(large)) return;
    throw InputError(std::string("an element's shape: ") + name + "; accepted: " + right);
}

}  // namespace

ElementShapePtr make_stick(double length, double width) {
    check_sizes("a stick that is not longer than it is wide", length, width,
                "a length above the width, both above 0");
    return std::make_shared<Stick>(length, width);
}

ElementShapePtr make_ring(double diameter, double width) {
    check_sizes("a ring without a hole", diameter, 2 * width,
                "a diameter above twice the width, both above 0");
    return std::make_shared<Ring>(diameter, width);
}

ElementShapePtr make_outline(std::vector<std::vector<dvec2>> polygons, double thickness) {
    const bool is_open = polygons.empty() || std::ranges::any_of(polygons, [](const auto& polygon) {
                             return polygon.size() < 3;
                         });
    if (is_open)
        throw InputError("an element's outline has fewer than three corners; accepted: closed polygons");
    if (!(thickness > 0) || !std::isfinite(thickness))
        throw InputError("an element's outline has no thickness; accepted: one above 0");
    return std::make_shared<Outline>(std::move(polygons), thickness);
}

ElementShapePtr make_field_shape(FieldPtr field) {
    const Box box = field->bounds();
    if (box.empty() || !is_finite(box.lo) || !is_finite(box.hi))
        throw InputError("an element's shape is empty or has no bounds; accepted: a solid of finite size");
    if (field->metric() == Metric::sign)
        throw InputError(
            "an element's shape tells no distance; accepted: a mesh, a shape or a formula whose "
            "value does");
    return std::make_shared<FieldShape>(std::move(field));
}

}  // namespace lamella
