// Nearest-neighbour tours, improved by 2-opt and by moving single points.
#include "printers/toolpath/bead_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "printers/polygons/nearest_points.h"

namespace lamella {
namespace {

double squared_distance(dvec2 a, dvec2 b) {
    const dvec2 d = a - b;
    return d.x * d.x + d.y * d.y;
}

/// Returns the left turn of the border at a loop's point, radians. Loops run counter-clockwise around solid.
double turn_at(const std::vector<dvec2>& points, std::size_t i) {
    const std::size_t n = points.size();
    const dvec2 in = points[i] - points[(i + n - 1) % n], out = points[(i + 1) % n] - points[i];
    return std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
}

/// Returns the index of the point at which a loop begins and ends.
std::size_t start_of(const std::vector<dvec2>& points, Seam seam, dvec2 from) {
    std::size_t best = 0;
    double least = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double cost = seam == Seam::nearest ? squared_distance(points[i], from)
                            : seam == Seam::rear  ? -points[i].y
                                                  : -turn_at(points, i);
        if (i == 0 || cost < least) {
            best = i;
            least = cost;
        }
    }
    return best;
}

/// Returns the nearest few neighbours of each point, by a grid with about two points per cell.
std::vector<std::vector<std::uint32_t>> neighbours_of(std::span<const dvec2> points) {
    constexpr std::size_t wanted = 8;
    Rect box;
    for (const dvec2& p : points) box = unite(box, Rect{p, p});
    const dvec2 size = box.hi - box.lo;
    const double area = std::max(size.x, 1e-3) * std::max(size.y, 1e-3);
    const double cell = std::sqrt(2 * area / static_cast<double>(points.size()));
    const auto columns = static_cast<std::size_t>(size.x / cell) + 1,
               rows = static_cast<std::size_t>(size.y / cell) + 1;
    const auto cell_of = [&](double v, double lo, std::size_t count) {
        return std::min(static_cast<std::size_t>((v - lo) / cell), count - 1);
    };
    std::vector<std::vector<std::uint32_t>> cells(columns * rows);
    for (std::uint32_t i = 0; i < points.size(); ++i)
        cells[cell_of(points[i].y, box.lo.y, rows) * columns + cell_of(points[i].x, box.lo.x, columns)]
            .push_back(i);
    std::vector<std::vector<std::uint32_t>> result(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::vector<std::uint32_t>& found = result[i];
        const std::size_t x = cell_of(points[i].x, box.lo.x, columns),
                          y = cell_of(points[i].y, box.lo.y, rows);
        for (std::size_t v = y > 1 ? y - 2 : 0; v < std::min(y + 3, rows); ++v) {
            for (std::size_t u = x > 1 ? x - 2 : 0; u < std::min(x + 3, columns); ++u) {
                for (const std::uint32_t j : cells[v * columns + u]) {
                    if (j != i) found.push_back(j);
                }
            }
        }
        std::ranges::sort(found, [&](std::uint32_t a, std::uint32_t b) {
            const double da = squared_distance(points[a], points[i]),
                         db = squared_distance(points[b], points[i]);
            return da != db ? da < db : a < b;
        });
        if (found.size() > wanted) found.resize(wanted);
    }
    return result;
}

/// A tour that is made shorter step by step. An edge costs what its points say, or else its length.
class ImprovedTour {
  public:
    ImprovedTour(std::span<const dvec2> points, dvec2 start, const TourCost& cost)
        : points_(points),
          start_(start),
          cost_(cost),
          place_(points.size()),
          // Reversal costs as much as the stretch is long, so large sets of points only get shorter
          // stretches.
          longest_(std::max<std::size_t>(1000, 1'000'000 / std::max<std::size_t>(points.size(), 1))) {
        go_to_nearest();
    }

    void improve() {
        if (tour_.size() < 3) return;
        const auto neighbours = neighbours_of(points_);
        constexpr int max_rounds = 20;
        for (int round = 0; round < max_rounds; ++round) {
            bool is_shorter = false;
            for (std::size_t p = 0; p < tour_.size(); ++p) is_shorter |= improve_at(p, neighbours[p]);
            if (!is_shorter) break;
        }
    }

    std::vector<std::size_t> take() { return std::move(tour_); }

  private:
    static constexpr double min_gain = 1e-6;  // mm

    void go_to_nearest() {
        tour_.reserve(points_.size());
        NearestPoints left(points_);
        for (dvec2 at = start_; !left.empty(); at = points_[tour_.back()]) {
            tour_.push_back(left.nearest(at));
            left.remove(tour_.back());
        }
        for (std::size_t i = 0; i < tour_.size(); ++i) place_[tour_[i]] = i;
    }

    double edge(std::size_t a, std::size_t b) const {
        if (cost_) return cost_(a, b);
        return std::sqrt(squared_distance(a == points_.size() ? start_ : points_[a], points_[b]));
    }
    std::size_t before(std::size_t place) const { return place == 0 ? points_.size() : tour_[place - 1]; }

    /// Tries the neighbours nearer than one of p's two on the tour: a gain needs a cheaper edge at one of its
    /// ends.
    bool improve_at(std::size_t p, std::span<const std::uint32_t> neighbours) {
        bool is_shorter = false;
        double to_beat = costlier_edge(p);
        for (const std::uint32_t q : neighbours) {
            if (!(edge(p, q) < to_beat) || !join(p, q)) continue;
            is_shorter = true;
            to_beat = costlier_edge(p);
        }
        return is_shorter;
    }

    double costlier_edge(std::size_t p) const {
        const std::size_t at = place_[p];
        return std::max(edge(before(at), p), at + 1 < tour_.size() ? edge(p, tour_[at + 1]) : 0.0);
    }

    /// Makes p and q adjacent if that gains something: by moving p, or by reversing the stretch between them,
    /// including the later or the earlier of both.
    bool join(std::size_t p, std::size_t q) {
        const std::size_t a = std::min(place_[p], place_[q]), b = std::max(place_[p], place_[q]);
        if (b - a > longest_) return false;
        if (move_behind(p, q)) return true;
        if (a + 1 <= b && gain(a + 1, b) > min_gain) {
            reverse(a + 1, b);
            return true;
        }
        if (b >= 1 && a <= b - 1 && gain(a, b - 1) > min_gain) {
            reverse(a, b - 1);
            return true;
        }
        return false;
    }

    /// Reversing [i, j] replaces the edges into i and out of j. The last point has no edge out.
    double gain(std::size_t i, std::size_t j) const {
        double saved = edge(before(i), tour_[i]) - edge(before(i), tour_[j]);
        if (j + 1 < tour_.size()) saved += edge(tour_[j], tour_[j + 1]) - edge(tour_[i], tour_[j + 1]);
        return saved;
    }

    void reverse(std::size_t i, std::size_t j) {
        std::reverse(at(i), at(j + 1));
        for (std::size_t k = i; k <= j; ++k) place_[tour_[k]] = k;
    }

    bool move_behind(std::size_t p, std::size_t q) {
        const std::size_t from = place_[p], behind = place_[q], after = behind + 1;
        if (after == from || behind == from) return false;
        if (!(detour(before(from), p, from + 1) - detour(q, p, after) > min_gain)) return false;
        if (from < behind) {
            std::rotate(at(from), at(from + 1), at(after));
        } else {
            std::rotate(at(after), at(from), at(from + 1));
        }
        for (std::size_t k = std::min(from, after); k <= std::max(from, behind); ++k) place_[tour_[k]] = k;
        return true;
    }

    /// Returns what it costs to pass `by` on the way from a point to the one at a place; to end there beyond
    /// the last.
    double detour(std::size_t from, std::size_t by, std::size_t place) const {
        if (place >= tour_.size()) return edge(from, by);
        return edge(from, by) + edge(by, tour_[place]) - edge(from, tour_[place]);
    }

    std::vector<std::size_t>::iterator at(std::size_t place) {
        return tour_.begin() + static_cast<std::ptrdiff_t>(place);
    }

    std::span<const dvec2> points_;
    dvec2 start_;
    const TourCost& cost_;
    std::vector<std::size_t> tour_, place_;  ///< points in order, and where each is
    std::size_t longest_;
};

}  // namespace

dvec2 end_of(const Bead& bead) { return bead.closed ? bead.points.front() : bead.points.back(); }

void begin_at(Bead& loop, std::size_t point) {
    const auto by = static_cast<std::ptrdiff_t>(point);
    std::rotate(loop.points.begin(), loop.points.begin() + by, loop.points.end());
    if (!loop.widths.empty()) std::rotate(loop.widths.begin(), loop.widths.begin() + by, loop.widths.end());
}

void append_nearest(std::span<Bead> beads, Seam seam, dvec2& at, std::vector<Bead>& out) {
    std::vector<dvec2> ends;  // two per bead; a loop may begin anywhere, its first point stands for it
    for (const Bead& bead : beads) {
        ends.push_back(bead.points.front());
        ends.push_back(bead.closed ? bead.points.front() : bead.points.back());
    }
    NearestPoints left(ends);
    while (!left.empty()) {
        const std::size_t end = left.nearest(at);
        Bead& bead = beads[end / 2];
        left.remove(end);
        left.remove(end ^ 1);
        if (bead.closed) {
            begin_at(bead, start_of(bead.points, seam, at));
        } else if (end % 2 == 1) {
            std::ranges::reverse(bead.points);
            std::ranges::reverse(bead.widths);
        }
        at = end_of(bead);
        out.push_back(std::move(bead));
    }
}

std::vector<std::size_t> short_tour(std::span<const dvec2> points, dvec2 start, const TourCost& cost) {
    ImprovedTour tour(points, start, cost);
    tour.improve();
    return tour.take();
}

}  // namespace lamella
