// Erodes walls to a ribbon around their middle and walks its border once.
#include "printers/toolpath/center_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/runs/interval_index.h"
#include "printers/polygons/inscribed_disc.h"

namespace lamella {
namespace {

constexpr double ribbon_share = 0.125;  // half the ribbon's width, relative to the thickness
constexpr double pairing_share = 0.5;   // largest distance between opposite passes, relative to the thickness
constexpr double opposite_cosine = -0.5;  // cosine below which two directions count as opposite

struct Edge {
    dvec2 a;
    dvec2 b;
    dvec2 direction;
    double length;
    std::vector<Interval> kept;  ///< kept intervals, measured from a, mm
    Edge(dvec2 from, dvec2 to, double l) : a(from), b(to), direction((to - from) / l), length(l) {}
    dvec2 at(double s) const { return a + direction * s; }
};

double distance_to(dvec2 p, dvec2 a, dvec2 b) {
    const dvec2 way = b - a;
    const double square = dot(way, way);
    const double t = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0;
    return length(p - a - way * t);
}

/// Returns the complement of some intervals in [0, l].
std::vector<Interval> without(double l, std::vector<Interval> covered) {
    std::ranges::sort(covered, {}, &Interval::lo);
    std::vector<Interval> rest;
    double from = 0;
    for (const Interval& c : covered) {
        if (c.lo > from) rest.push_back({from, std::min(c.lo, l)});
        from = std::max(from, c.hi);
        if (from >= l) return rest;
    }
    rest.push_back({from, l});
    return rest;
}

/// The ribbon's border as edges, in walking order.
class Ribbon {
  public:
    Ribbon(const Polygons& border, double thickness) : thickness_(thickness) {
        for (const ClipperLib::Path& ring : border) add(to_points(ring));
        std::vector<Interval> intervals;
        std::vector<double> keys;
        for (const Edge& edge : edges_) {
            intervals.push_back({std::min(edge.a.y, edge.b.y), std::max(edge.a.y, edge.b.y)});
            keys.push_back(static_cast<double>(keys.size()));
        }
        index_ = IntervalIndex(intervals, keys);
    }

    /// Walks the border and omits the stretches that run back along a kept one.
    std::vector<CenterLine> walk() {
        std::vector<CenterLine> lines;
        for (std::size_t r = 0; r + 1 < rings_.size(); ++r) walk_ring(rings_[r], rings_[r + 1], lines);
        return lines;
    }

    /// Returns the midpoint between a point of the border and the opposite border; the point itself if there
    /// is no opposite border.
    dvec2 middle(dvec2 p, dvec2 direction) {
        double least = reach();
        std::optional<dvec2> across;
        near(p, p);
        for (const std::uint32_t j : found_) {
            const Edge& edge = edges_[j];
            if (dot(edge.direction, direction) > opposite_cosine) continue;
            const dvec2 q = edge.at(std::clamp(dot(p - edge.a, edge.direction), 0.0, edge.length));
            const double d = length(q - p);
            if (d >= least) continue;
            least = d;
            across = q;
        }
        return across ? (p + *across) * 0.5 : p;
    }

  private:
    double reach() const { return pairing_share * thickness_; }

    /// Appends a ring's edges, starting at the point farthest from its centre: that is the end of a wall if
    /// there is any.
    void add(std::vector<dvec2> points) {
        dvec2 sum(0);
        for (const dvec2& p : points) sum += p / static_cast<double>(points.size());
        const auto start = std::ranges::max_element(points, {}, [&](dvec2 p) { return length(p - sum); });
        std::rotate(points.begin(), start, points.end());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const dvec2 a = points[i];
            const dvec2 b = points[(i + 1) % points.size()];
            const double l = length(b - a);
            if (l > 0) edges_.emplace_back(a, b, l);
        }
        rings_.push_back(edges_.size());
    }

    void near(dvec2 a, dvec2 b) {
        index_.query({std::min(a.y, b.y) - reach(), std::max(a.y, b.y) + reach()}, found_);
    }

    /// Appends the intervals of `edge` that run back along kept stretches of `other`.
    void cover(const Edge& edge, const Edge& other, std::vector<Interval>& covered) const {
        const dvec2 normal(-edge.direction.y, edge.direction.x);
        for (const Interval& kept : other.kept) {
            dvec2 c = other.at(kept.hi) - edge.a;
            dvec2 d = other.at(kept.lo) - edge.a;
            double s0 = dot(c, edge.direction);
            double s1 = dot(d, edge.direction);
            const double h0 = dot(c, normal);
            const double h1 = dot(d, normal);
            Interval t{0, 1};  // part of the segment from c to d that is close enough
            if (h0 == h1) {
                if (std::abs(h0) > reach()) continue;
            } else {
                const double t0 = (-reach() - h0) / (h1 - h0);
                const double t1 = (reach() - h0) / (h1 - h0);
                t = {std::max(0.0, std::min(t0, t1)), std::min(1.0, std::max(t0, t1))};
                if (t.lo >= t.hi) continue;
            }
            const double from = s0 + (s1 - s0) * t.lo;
            const double to = s0 + (s1 - s0) * t.hi;
            // At bends the two passes cover intervals of unequal length on each other.
            const double more = ribbon_share * thickness_;
            covered.push_back({std::min(from, to) - more, std::max(from, to) + more});
        }
    }

    void walk_ring(std::size_t first, std::size_t last, std::vector<CenterLine>& lines) {
        const std::size_t before = lines.size();
        bool whole = true;
        bool joined = false;  // the stretch just before this point has been kept
        for (std::size_t i = first; i < last; ++i) {
            Edge& edge = edges_[i];
            std::vector<Interval> covered;
            near(edge.a, edge.b);
            for (const std::uint32_t j : found_) {
                if (j != i && dot(edges_[j].direction, edge.direction) < opposite_cosine)
                    cover(edge, edges_[j], covered);
            }
            edge.kept = without(edge.length, std::move(covered));
            for (const Interval& kept : edge.kept) {
                if (!(joined && kept.lo == 0)) lines.push_back({{edge.at(kept.lo)}, false});
                lines.back().points.push_back(kept.hi == edge.length ? edge.b : edge.at(kept.hi));
                joined = kept.hi == edge.length;
                whole = whole && kept.lo == 0 && joined;
            }
            if (edge.kept.empty()) joined = whole = false;
        }
        if (lines.size() == before) return;
        if (whole) {
            lines.back().points.pop_back();
            lines.back().closed = true;
        } else if (joined && lines.size() > before + 1 && !edges_[first].kept.empty() &&
                   edges_[first].kept.front().lo == 0) {
            std::vector<dvec2>& head = lines.back().points;
            const std::vector<dvec2>& tail = lines[before].points;
            head.insert(head.end(), tail.begin() + 1, tail.end());
            std::swap(lines[before], lines.back());
            lines.pop_back();
        }
    }

    double thickness_;
    std::vector<Edge> edges_;
    std::vector<std::size_t> rings_{0};  // index of each ring's first edge, and the number of edges
    IntervalIndex index_;
    std::vector<std::uint32_t> found_;
};

/// Removes the turn around the ribbon's end.
void trim_end(std::vector<dvec2>& points, double half_ribbon) {
    double taken = 0;
    while (points.size() > 2) {
        const double l = length(points.back() - points[points.size() - 2]);
        taken += l;
        if (l > 2.5 * half_ribbon || taken > 5 * half_ribbon) return;
        points.pop_back();
    }
}

void trim(CenterLine& line, double half_ribbon) {
    if (line.closed) return;
    trim_end(line.points, half_ribbon);
    std::ranges::reverse(line.points);
    trim_end(line.points, half_ribbon);
    std::ranges::reverse(line.points);
}

/// Moves a line from the ribbon's border to its middle.
void center(CenterLine& line, Ribbon& ribbon) {
    const std::vector<dvec2> from = line.points;
    const std::size_t n = from.size();
    for (std::size_t i = 0; i < n; ++i) {
        dvec2 tangent(0);
        const auto add = [&](dvec2 a, dvec2 b) { tangent += (b - a) / length(b - a); };
        if (i > 0 || line.closed) add(from[(i + n - 1) % n], from[i]);
        if (i + 1 < n || line.closed) add(from[i], from[(i + 1) % n]);
        if (const double l = length(tangent); l > 0) line.points[i] = ribbon.middle(from[i], tangent / l);
    }
    line.points.erase(std::unique(line.points.begin(), line.points.end()), line.points.end());
}

/// Joins lines whose ends are at most `gap` mm apart.
void join(std::vector<CenterLine>& lines, double gap) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        for (std::size_t j = i + 1; j < lines.size(); ++j) {
            if (lines[i].closed || lines[j].closed) continue;
            std::vector<dvec2>& a = lines[i].points;
            std::vector<dvec2>& b = lines[j].points;
            const auto meet = [&](dvec2 p, dvec2 q) { return length(p - q) <= gap; };
            const bool head = meet(a.front(), b.front()) || meet(a.front(), b.back());
            if (!head && !meet(a.back(), b.front()) && !meet(a.back(), b.back())) continue;
            if (head) std::ranges::reverse(a);
            if (!meet(a.back(), b.front())) std::ranges::reverse(b);
            a.insert(a.end(), b.begin(), b.end());
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(j));
            j = i;  // the joined line has a new end, so all others are compared again
        }
        if (!lines[i].closed && lines[i].points.size() > 3 &&
            length(lines[i].points.front() - lines[i].points.back()) <= gap) {
            lines[i].closed = true;
        }
    }
}

/// Returns true if a line's end lies within a thickness of another line, or of an earlier part of itself.
bool ends_at_line(std::size_t index, const std::vector<CenterLine>& lines, double thickness) {
    const std::vector<dvec2>& points = lines[index].points;
    const dvec2 end = points.back();
    std::size_t last = points.size() - 1;
    for (double way = 0; last > 0 && way <= 2 * thickness; --last)
        way += length(points[last] - points[last - 1]);
    for (std::size_t j = 0; j < lines.size(); ++j) {
        const std::vector<dvec2>& other = lines[j].points;
        const std::size_t n = j == index ? last + 1 : other.size();
        for (std::size_t i = 1; i < n; ++i) {
            const auto [lo, hi] = std::minmax(other[i - 1].y, other[i].y);
            const bool level = lo - thickness < end.y && end.y < hi + thickness;
            if (level && distance_to(end, other[i - 1], other[i]) < thickness) return true;
        }
        if (lines[j].closed && distance_to(end, other.back(), other.front()) < thickness) return true;
    }
    return false;
}

/// Extends a line at its end unless that end meets a line.
void extend_end(std::size_t index, std::vector<CenterLine>& lines, double by, double thickness) {
    if (ends_at_line(index, lines, thickness)) return;
    std::vector<dvec2>& points = lines[index].points;
    const dvec2 end = points.back();
    std::size_t back = points.size() - 1;  // a point far enough back to determine the direction
    while (back > 0 && length(end - points[back]) < thickness / 2) --back;
    const dvec2 way = end - points[back];
    if (const double l = length(way); l > 0) points.back() = end + way * (by / l);
}

/// Returns true if walls of this thickness around the ribbon make up the piece.
bool is_even(const Polygons& piece, const Polygons& ribbon, double thickness, double tolerance) {
    const double grow = (0.5 - ribbon_share) * thickness + tolerance;
    const Polygons rest = subtract_polygons(piece, offset_polygons(ribbon, grow));
    return std::ranges::all_of(
        split_pieces(rest), [&](const Polygons& left) { return area_of(left) < thickness * thickness / 4; });
}

}  // namespace

double length_of(const CenterLine& line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.points.size(); ++i) sum += length(line.points[i] - line.points[i - 1]);
    if (line.closed) sum += length(line.points.front() - line.points.back());
    return sum;
}

double wall_thickness(const Polygons& piece) {
    // Each end of a wall adds its thickness to half the perimeter; each branch and each loop subtracts it:
    // area = thickness (perimeter / 2 - thickness * Euler characteristic).
    const double half = perimeter_of(piece) / 2;
    const double euler = 2 - static_cast<double>(piece.size());
    const double area = area_of(piece);
    const double root = std::sqrt(std::max(0.0, half * half - 4 * euler * area));
    return half > 0 ? 2 * area / (half + root) : 0;
}

std::vector<CenterLine> center_lines(const Polygons& piece, double thickness, double tolerance) {
    // Radius of the largest disc, in thicknesses: 0.71 where walls cross at right angles.
    constexpr double widest_joint = 0.8;
    if (!(thickness > 0) || InscribedDisc(piece).fits(widest_joint * thickness)) return {};
    const double half_ribbon = ribbon_share * thickness;
    const Polygons border = simplified(offset_polygons(piece, half_ribbon - thickness / 2), half_ribbon / 4);
    if (border.empty() || !is_even(piece, border, thickness, tolerance)) return {};
    Ribbon ribbon(border, thickness);
    std::vector<CenterLine> lines = ribbon.walk();
    std::erase_if(lines, [&](const CenterLine& line) { return length_of(line) < thickness / 2; });
    for (CenterLine& line : lines) {
        trim(line, half_ribbon);
        center(line, ribbon);
    }
    std::erase_if(lines, [](const CenterLine& line) { return line.points.size() < 2; });
    join(lines, thickness / 2);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].closed) continue;
        for (int end = 0; end < 2; ++end) {
            extend_end(i, lines, thickness / 4 - half_ribbon, thickness);
            std::ranges::reverse(lines[i].points);
        }
    }
    // The lines must be able to carry the piece's volume at a flow that suits the thickness.
    double total = 0;
    for (const CenterLine& line : lines) total += length_of(line);
    constexpr double min_flow = 0.85;
    constexpr double max_flow = 1.35;
    const double flow = total > 0 ? area_of(piece) / (total * thickness) : infinity;
    if (!(flow >= min_flow && flow <= max_flow)) return {};
    return lines;
}

}  // namespace lamella
