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
    const std::size_t n = points.size();
    std::vector<std::size_t> tour;
    tour.reserve(n);
    NearestPoints left(points);
    for (dvec2 at = start; !left.empty(); at = points[tour.back()]) {
        tour.push_back(left.nearest(at));
        left.remove(tour.back());
    }
    if (n < 3) return tour;
    const auto neighbours = neighbours_of(points);
    std::vector<std::size_t> place(n);
    for (std::size_t i = 0; i < n; ++i) place[tour[i]] = i;
    constexpr double min_gain = 1e-6;  // mm
    const auto edge = [&](std::size_t a, std::size_t b) {
        return cost ? cost(a, b) : std::sqrt(squared_distance(a == n ? start : points[a], points[b]));
    };
    const auto before = [&](std::size_t i) { return i == 0 ? n : tour[i - 1]; };
    // Reversing [i, j] replaces the edges into i and out of j. The last point has no edge out.
    const auto gain = [&](std::size_t i, std::size_t j) {
        double saved = edge(before(i), tour[i]) - edge(before(i), tour[j]);
        if (j + 1 < n) saved += edge(tour[j], tour[j + 1]) - edge(tour[i], tour[j + 1]);
        return saved;
    };
    const auto turn = [&](std::size_t i, std::size_t j) {
        std::reverse(tour.begin() + static_cast<std::ptrdiff_t>(i),
                     tour.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        for (std::size_t k = i; k <= j; ++k) place[tour[k]] = k;
    };
    // Moving p behind q joins its neighbours, and breaks the edge out of q; nothing follows the last point.
    const auto detour = [&](std::size_t from, std::size_t by, std::size_t place_after) {
        if (place_after >= n) return edge(from, by);
        return edge(from, by) + edge(by, tour[place_after]) - edge(from, tour[place_after]);
    };
    const auto move_behind = [&](std::size_t p, std::size_t q) {
        const std::size_t from = place[p], behind = place[q];
        if (behind + 1 == from || behind == from) return false;
        const std::size_t after = behind + 1;
        if (!(detour(before(from), p, from + 1) - detour(q, p, after) > min_gain)) return false;
        const auto at = [&](std::size_t i) { return tour.begin() + static_cast<std::ptrdiff_t>(i); };
        if (from < behind)
            std::rotate(at(from), at(from + 1), at(behind + 1));
        else
            std::rotate(at(after), at(from), at(from + 1));
        for (std::size_t k = std::min(from, after); k <= std::max(from, behind); ++k) place[tour[k]] = k;
        return true;
    };
    // Only neighbours nearer than one of p's two on the tour are tried: a gain needs a cheaper edge at one of
    // its ends.
    const auto edge_to_beat = [&](std::size_t p) {
        const std::size_t at = place[p];
        return std::max(edge(before(at), p), at + 1 < n ? edge(p, tour[at + 1]) : 0.0);
    };
    // Reversal costs as much as the stretch is long, so large sets of points only get shorter stretches.
    const std::size_t longest = std::max<std::size_t>(1000, 1'000'000 / n);
    const auto join = [&](std::size_t p, std::size_t q) {
        const std::size_t a = std::min(place[p], place[q]), b = std::max(place[p], place[q]);
        if (b - a > longest) return false;
        if (move_behind(p, q)) return true;
        // To make p and q adjacent, reverse the stretch between them, including the later or the earlier of
        // both.
        if (a + 1 <= b && gain(a + 1, b) > min_gain) {
            turn(a + 1, b);
            return true;
        }
        if (b >= 1 && a <= b - 1 && gain(a, b - 1) > min_gain) {
            turn(a, b - 1);
            return true;
        }
        return false;
    };
    constexpr int max_rounds = 20;
    for (int round = 0; round < max_rounds; ++round) {
        bool shorter = false;
        for (std::size_t p = 0; p < n; ++p) {
            double to_beat = edge_to_beat(p);
            for (const std::uint32_t q : neighbours[p]) {
                if (!(edge(p, q) < to_beat) || !join(p, q)) continue;
                shorter = true;
                to_beat = edge_to_beat(p);
            }
        }
        if (!shorter) break;
    }
    return tour;
}

}  // namespace lamella
