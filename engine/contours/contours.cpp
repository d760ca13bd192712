// Draws a chord through every lattice cell, links the chords into polygons, and straightens these within
// their gates.
#include "engine/contours/contours.h"

#include "engine/base/error.h"
#include "engine/contours/lattice.h"
#include "engine/field/slice_context.h"

namespace lamella {
namespace {

/// Straightening moves a border by at most this share of the lattice pitch. The rest of the tolerance is left
/// for corners that a chord cuts off (at most 0.71 pitches at a right angle).
constexpr double straightening_share = 0.1;
/// Two borders that cross the same lattice edge keep at least a tenth of the gap between them.
constexpr double gap_share = 0.45;
constexpr std::uint32_t no_loop = 0xffffffffU;

/// A crossing, and the range along its lattice edge through which a straightened border may pass; run units.
struct Gate {
    dvec2 point;
    dvec2 low;
    dvec2 high;
};

class Tracer {
  public:
    explicit Tracer(const Lattice& lattice) : lattice_(lattice), crossings_(lattice.crossings()) {}

    std::vector<Contour> trace() {
        link();
        find_loops();
        std::vector<Contour> contours;
        for (std::size_t l = 0; l < loops_.size(); ++l) {
            contours.push_back(straightened(loops_[l]));
            contours.back().hole = loops_[l].hole;
            contours.back().parent = parent(l);
            parents_.push_back(contours.back().parent);
        }
        return contours;
    }

  private:
    struct Loop {
        std::uint32_t first;
        std::uint32_t length;
        bool hole;
    };

    void link() {
        next_.resize(crossings_.size());
        for (int j = 0; j < lattice_.grid().rows; ++j) {
            lattice_.visit_cells(j, [&](const Lattice::Cell& cell) {
                for (std::size_t k = 0; k < cell.border.size(); ++k) {
                    if (cell.leaves_solid(k)) next_[cell.border[k]] = cell.border[cell.chord_end(k)];
                }
            });
        }
    }

    void find_loops() {
        loop_.assign(crossings_.size(), no_loop);
        for (std::uint32_t first = 0; first < crossings_.size(); ++first) {
            if (loop_[first] != no_loop) continue;
            const auto number = static_cast<std::uint32_t>(loops_.size());
            std::int64_t twice_area = 0;
            std::uint32_t length = 0, c = first;
            do {
                loop_[c] = number;
                const Crossing &p = crossings_[c], &q = crossings_[next_[c]];
                twice_area += static_cast<std::int64_t>(p.x) * q.y - static_cast<std::int64_t>(p.y) * q.x;
                ++length;
                c = next_[c];
            } while (c != first);
            // A loop there and back along one lattice edge: a speck that only one line has seen, without
            // area.
            if (length < 3) {
                c = first;
                do {
                    loop_[c] = dropped;
                    c = next_[c];
                } while (c != first);
            } else {
                loops_.push_back({first, length, twice_area < 0});
            }
        }
    }

    /// Returns the contour that directly encloses a loop, from the crossing before the loop's first one.
    int parent(std::size_t l) const {
        std::int64_t before = previous(loops_[l].first);
        while (before >= 0 && loop_[static_cast<std::size_t>(before)] == dropped) {
            before = previous(static_cast<std::uint32_t>(before));
        }
        if (before < 0) return -1;
        const std::uint32_t other = loop_[static_cast<std::size_t>(before)];
        return loops_[other].hole != enters_solid(static_cast<std::uint32_t>(before))
                   ? static_cast<int>(other)
                   : parents_[other];
    }

    /// Returns the crossing next to this one with no other border in between: the one before it on its line,
    /// or the one before the node below.
    std::int64_t previous(std::uint32_t c) const {
        const std::int64_t before = static_cast<std::int64_t>(c) - 1;
        const Crossing& p = crossings_[c];
        if (is_row(c)) return before >= lattice_.row_start(p.y / run_unit) ? before : -1;
        return same_edge(c, before) ? before : lattice_.before_node(p.x / run_unit, p.y / run_unit);
    }

    /// Returns true if the solid begins at a crossing, going along its line.
    bool enters_solid(std::uint32_t c) const {
        const Crossing& p = crossings_[c];
        if (is_row(c)) return (c - lattice_.row_start(p.y / run_unit)) % 2 == 0;
        bool inside = lattice_.solid(p.x / run_unit, p.y / run_unit);
        for (std::int64_t k = static_cast<std::int64_t>(c) - 1; same_edge(c, k); --k) inside = !inside;
        return !inside;
    }

    bool is_row(std::uint32_t c) const { return c < lattice_.row_crossings(); }

    bool same_edge(std::uint32_t c, std::int64_t other) const {
        if (other < 0 || other >= static_cast<std::int64_t>(crossings_.size())) return false;
        const auto o = static_cast<std::uint32_t>(other);
        const Crossing &p = crossings_[c], &q = crossings_[o];
        return is_row(c) == is_row(o) && (p.x >> 8) == (q.x >> 8) && (p.y >> 8) == (q.y >> 8);
    }

    Gate gate(std::uint32_t c) const {
        const Crossing& p = crossings_[c];
        const bool row = is_row(c);
        const int u = row ? p.x : p.y;
        const int from = u & ~(run_unit - 1), to = from + run_unit;
        double low = std::min(straightening_share * run_unit, 2 * gap_share * (u - from));
        double high = std::min(straightening_share * run_unit, 2 * gap_share * (to - u));
        const auto room = [&](std::int64_t other, double most) {
            if (!same_edge(c, other)) return most;
            const Crossing& q = crossings_[static_cast<std::size_t>(other)];
            return std::min(most, gap_share * std::abs(u - (row ? q.x : q.y)));
        };
        low = room(static_cast<std::int64_t>(c) - 1, low);
        high = room(static_cast<std::int64_t>(c) + 1, high);
        const dvec2 point(p.x, p.y), along = row ? dvec2(1, 0) : dvec2(0, 1);
        return {point, point - along * low, point + along * high};
    }

    /// Drops crossings as long as the straight line between the kept ones passes through every gate in
    /// between. Every lattice edge is then crossed by the same borders in the same order as before, so no two
    /// borders can meet.
    Contour straightened(const Loop& loop) const {
        Contour contour;
        const auto& grid = lattice_.grid();
        const auto emit = [&](dvec2 p) {
            contour.points.push_back(grid.origin + p * (grid.pitch / double(run_unit)));
        };
        std::uint32_t anchor = loop.first, left = loop.length;
        do {
            const dvec2 from = gate(anchor).point;
            emit(from);
            std::uint32_t kept = next_[anchor], kept_steps = 1, c = kept, steps = 1;
            dvec2 right(0), leftmost(0);
            bool open = true;
            while (steps < left) {
                const Gate g = gate(c);
                if (!narrow(g, from, open, right, leftmost)) break;
                c = next_[c];
                ++steps;
                const dvec2 direction = dvec2(crossings_[c].x, crossings_[c].y) - from;
                if (cross(right, direction) < 0 || cross(direction, leftmost) < 0) break;
                kept = c;
                kept_steps = steps;
            }
            anchor = kept;
            left -= kept_steps;
        } while (left > 0);
        if (contour.points.size() < 3) {
            contour.points.clear();
            std::uint32_t c = loop.first;
            do {
                emit(dvec2(crossings_[c].x, crossings_[c].y));
                c = next_[c];
            } while (c != loop.first);
        }
        return contour;
    }

    static double cross(dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; }

    /// Narrows the window of directions to those that pass through the gate; returns false when none is left.
    static bool narrow(const Gate& gate, dvec2 from, bool& open, dvec2& right, dvec2& left) {
        dvec2 a = gate.low - from, b = gate.high - from;
        const double turn = cross(a, b);
        if (turn == 0) return false;
        if (turn < 0) std::swap(a, b);
        if (open) {
            right = a;
            left = b;
            open = false;
            return true;
        }
        if (cross(right, b) <= 0 || cross(a, left) <= 0) return false;
        if (cross(right, a) > 0) right = a;
        if (cross(b, left) > 0) left = b;
        return true;
    }

    static constexpr std::uint32_t dropped = 0xfffffffeU;

    const Lattice& lattice_;
    std::span<const Crossing> crossings_;
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> loop_;
    std::vector<Loop> loops_;
    std::vector<int> parents_;
};

}  // namespace

double contour_pitch(double tolerance) { return tolerance; }

double signed_area(const std::vector<dvec2>& points) {
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec2 p = points[i] - points[0], q = points[(i + 1) % points.size()] - points[0];
        twice += p.x * q.y - p.y * q.x;
    }
    return twice / 2;
}

std::vector<Contour> trace_contours(const SliceField& slice, double tolerance, Scratch& scratch) {
    const Rect bounds = slice.bounds();
    if (bounds.empty()) return {};
    const double pitch = contour_pitch(tolerance);
    // Lattice lines lie at multiples of the pitch less an odd fraction: contours of a part do not depend on
    // its neighbours, and faces at round coordinates do not coincide with lattice lines.
    constexpr double fraction = 0.382;
    const dvec2 from = glm::floor(bounds.lo / pitch) - 1.0 - fraction,
                to = glm::ceil(bounds.hi / pitch) + 2.0 - fraction;
    constexpr double max_cells = 1 << 22;
    if (!(to.x - from.x < max_cells && to.y - from.y < max_cells)) {
        throw InputError("the contour tolerance of " + std::to_string(tolerance) +
                         " mm is too fine for the size of this layer, or the layer is unbounded");
    }
    const Grid grid{from * pitch, dvec2(pitch), static_cast<int>(to.x - from.x),
                    static_cast<int>(to.y - from.y)};
    const Lattice lattice(slice, grid, scratch);
    return Tracer(lattice).trace();
}

}  // namespace lamella
