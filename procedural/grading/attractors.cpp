// A bounding-volume tree over points and segments, a list of planes, and falloffs as monotone functions of a
// distance.
#include "procedural/grading/attractors.h"

#include <cstdint>
#include <numeric>
#include <string>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"

namespace lamella {
namespace {

/// Relative rounding error of distances that ranges allow for.
constexpr double distance_rounding = 1e-14;

/// A segment, or a point if both ends are equal.
struct Segment {
    dvec3 a, b;

    double distance(dvec3 p) const {
        const dvec3 along = b - a;
        const double squared = glm::dot(along, along);
        if (!(squared > 0)) return length(p - a);
        const double t = std::min(std::max(glm::dot(p - a, along) / squared, 0.0), 1.0);
        return length(p - (a * (1 - t) + b * t));
    }

    Box box() const { return {glm::min(a, b), glm::max(a, b)}; }
};

struct Plane {
    dvec3 point, normal;  ///< the normal has length 1

    double height(dvec3 p) const { return glm::dot(p - point, normal); }

    Interval heights(const Box& box) const {
        const double middle = height(box.center());
        const double reach = glm::dot(glm::abs(normal), box.size()) / 2;
        return {middle - reach, middle + reach};
    }
};

/// A bounding-volume tree over segments, built by median splits along the longest side.
class SegmentTree {
  public:
    explicit SegmentTree(std::vector<Segment> segments) : segments_(std::move(segments)) {
        if (!segments_.empty()) build(0, static_cast<std::uint32_t>(segments_.size()));
    }

    bool empty() const { return segments_.empty(); }
    const Box& bounds() const { return nodes_[0].box; }

    struct Nearest {
        double distance = infinity;
        std::uint32_t segment = 0;
    };

    Nearest nearest(dvec3 p) const {
        Nearest best;
        search([&](const Box& box) { return lamella::distance(box, p); },
               [&](std::uint32_t i) {
                   const double d = segments_[i].distance(p);
                   if (d < best.distance) best = {d, i};
                   return best.distance;
               });
        return best;
    }

    /// Returns a lower bound of the distance from any point of a box; exact if the nearest segments are
    /// points.
    double least(const Box& box) const {
        const dvec3 centre = box.center();
        const double half = length(box.size()) / 2;
        double best = infinity;
        search([&](const Box& node) { return distance(box, node); },
               [&](std::uint32_t i) {
                   const Segment& s = segments_[i];
                   best = std::min(best, std::max(distance(box, s.box()), s.distance(centre) - half));
                   return best;
               });
        return best;
    }

    /// Returns the maximum distance of a box's points from one segment. It is at a corner, because distances
    /// are convex.
    double greatest(const Box& box, std::uint32_t segment) const {
        double most = 0;
        for (int i = 0; i < 8; ++i) {
            const dvec3 corner((i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                               (i & 4) != 0 ? box.hi.z : box.lo.z);
            most = std::max(most, segments_[segment].distance(corner));
        }
        return most;
    }

  private:
    static constexpr std::uint32_t leaf_size = 4;

    struct Node {
        Box box;
        std::uint32_t
            first;  ///< first segment of a leaf, or the second child; the first child follows its parent
        std::uint32_t count;  ///< segments of a leaf, 0 for an inner node
    };

    void build(std::uint32_t first, std::uint32_t last) {
        const std::size_t node = nodes_.size();
        Box box, centres;
        for (std::uint32_t i = first; i < last; ++i) {
            box = unite(box, segments_[i].box());
            centres.include(segments_[i].a + segments_[i].b);
        }
        nodes_.push_back({box, first, last - first});
        if (last - first <= leaf_size) return;
        const dvec3 size = centres.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = first + (last - first) / 2;
        std::nth_element(segments_.begin() + first, segments_.begin() + middle, segments_.begin() + last,
                         [axis](const Segment& s, const Segment& t) {
                             return s.a[axis] + s.b[axis] < t.a[axis] + t.b[axis];
                         });
        build(first, middle);
        nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
        nodes_[node].count = 0;
        build(middle, last);
    }

    /// Visits the segments of all leaves whose bound is below the last result of `visit`, nearer nodes first.
    template <class Bound, class Visit>
    void search(const Bound& bound, const Visit& visit) const {
        struct Entry {
            std::uint32_t node;
            double bound;
        };
        if (nodes_.empty()) return;
        Entry stack[64];  // median splits bound the depth
        int top = 0;
        double best = infinity;
        stack[top++] = {0, bound(nodes_[0].box)};
        while (top > 0) {
            const Entry entry = stack[--top];
            if (entry.bound >= best) continue;
            const Node& node = nodes_[entry.node];
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) best = visit(i);
            if (node.count > 0) continue;
            const Entry left{entry.node + 1, bound(nodes_[entry.node + 1].box)};
            const Entry right{node.first, bound(nodes_[node.first].box)};
            stack[top++] = left.bound < right.bound ? right : left;
            stack[top++] = left.bound < right.bound ? left : right;
        }
    }

    std::vector<Segment> segments_;
    std::vector<Node> nodes_;
};

class DistanceGrading : public Grading {
  public:
    DistanceGrading(std::vector<Segment> segments, std::vector<Plane> planes)
        : tree_(std::move(segments)), planes_(std::move(planes)) {}

    double at(dvec3 p) const override {
        if (is_signed()) return planes_[0].height(p);
        double best = tree_.nearest(p).distance;
        for (const Plane& plane : planes_) best = std::min(best, std::abs(plane.height(p)));
        return best;
    }

    Interval range(const Box& box) const override {
        const dvec3 centre = box.center();
        const double half = length(box.size()) / 2;
        if (!std::isfinite(half)) return {is_signed() ? -infinity : 0.0, infinity};
        const double error = distance_rounding * (half + farthest(box));
        Interval range;
        if (is_signed()) {
            range = planes_[0].heights(box);
            return {range.lo - error, range.hi + error};
        }
        const double middle = at(centre);
        range = {infinity, middle + half};
        if (!tree_.empty()) {
            range.lo = tree_.least(box);
            range.hi = std::min(range.hi, tree_.greatest(box, tree_.nearest(centre).segment));
        }
        for (const Plane& plane : planes_) {
            const Interval heights = plane.heights(box);
            range.lo = std::min(range.lo, std::max({heights.lo, -heights.hi, 0.0}));
            range.hi = std::min(range.hi, std::max(-heights.lo, heights.hi));
        }
        range.lo = std::max(range.lo, middle - half);
        return {std::max(range.lo - error, 0.0), range.hi + error};
    }

  private:
    bool is_signed() const { return tree_.empty() && planes_.size() == 1; }

    /// Returns a length that no relevant coordinate or distance exceeds by much.
    double farthest(const Box& box) const {
        double most = length(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
        if (!tree_.empty()) {
            most += length(glm::max(glm::abs(tree_.bounds().lo), glm::abs(tree_.bounds().hi)));
        }
        for (const Plane& plane : planes_) most = std::max(most, length(plane.point));
        return most;
    }

    SegmentTree tree_;
    std::vector<Plane> planes_;
};

class FalloffGrading : public Grading {
  public:
    FalloffGrading(GradingPtr distance, double near_value, double far_value, double radius, Falloff falloff)
        : distance_(std::move(distance)),
          near_(near_value),
          far_(far_value),
          radius_(radius),
          falloff_(falloff) {}

    double at(dvec3 p) const override { return number(distance_->at(p)); }

    Interval range(const Box& box) const override {
        const Interval distances = distance_->range(box);
        const double first = number(distances.lo), last = number(distances.hi);
        const Interval limits{std::min(near_, far_), std::max(near_, far_)};
        const double slack = distance_rounding * std::max(std::abs(near_), std::abs(far_));
        Interval range{std::max(std::min(first, last) - slack, limits.lo),
                       std::min(std::max(first, last) + slack, limits.hi)};
        if (distances.hi == infinity) range.hi = infinity;  // the value may be NaN there
        return range;
    }

  private:
    double number(double distance) const {
        if (std::isnan(distance)) return distance;
        const double w = distance <= 0 ? 1.0 : weight(distance / radius_);
        const double value = near_ * w + far_ * (1 - w);
        return std::min(std::max(value, std::min(near_, far_)), std::max(near_, far_));
    }

    /// Returns the weight of the near value at a distance of t radii, from 1 to 0.
    double weight(double t) const {
        switch (falloff_) {
            case Falloff::linear:
                return std::max(1 - t, 0.0);
            case Falloff::smooth:
                return t < 1 ? 1 - t * t * (3 - 2 * t) : 0.0;
            case Falloff::inverse:
                return 1 / (1 + t);
            case Falloff::gaussian:
                return exponential(-4.5 * t * t);
        }
        throw InputError("a falloff is linear, smooth, gaussian or inverse");
    }

    GradingPtr distance_;
    double near_, far_, radius_;
    Falloff falloff_;
};

void check(bool holds, std::size_t index, const char* what) {
    if (!holds) throw InputError("attractor " + std::to_string(index + 1) + ": " + what);
}

bool usable(dvec3 p) {
    constexpr double largest = 1e9;
    return std::abs(p.x) <= largest && std::abs(p.y) <= largest && std::abs(p.z) <= largest;
}

}  // namespace

GradingPtr make_distance_grading(std::vector<Attractor> attractors) {
    if (attractors.empty()) throw InputError("a distance needs at least one point, segment or plane");
    std::vector<Segment> segments;
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < attractors.size(); ++i) {
        const Attractor& attractor = attractors[i];
        check(usable(attractor.a), i, "coordinates must be finite and at most 1e9 mm");
        if (attractor.kind == Attractor::Kind::point) {
            segments.push_back({attractor.a, attractor.a});
            continue;
        }
        check(usable(attractor.b), i,
              attractor.kind == Attractor::Kind::plane ? "the normal must be finite and at most 1e9 long"
                                                       : "coordinates must be finite and at most 1e9 mm");
        if (attractor.kind == Attractor::Kind::segment) {
            segments.push_back({attractor.a, attractor.b});
        } else {
            const double size = length(attractor.b);
            check(size > 1e-150, i, "the normal of a plane must not be 0");
            planes.push_back({attractor.a, attractor.b / size});
        }
    }
    return std::make_shared<DistanceGrading>(std::move(segments), std::move(planes));
}

GradingPtr make_falloff_grading(GradingPtr distance, double near_value, double far_value, double radius,
                                Falloff falloff) {
    if (!std::isfinite(near_value) || !std::isfinite(far_value)) {
        throw InputError("the near and the far value of a falloff must be finite numbers");
    }
    if (!(radius > 0 && radius < infinity)) throw InputError("the radius of a falloff must be positive, mm");
    return std::make_shared<FalloffGrading>(std::move(distance), near_value, far_value, radius, falloff);
}

}  // namespace lamella
