// A* with lazy visibility tests.
#include "printers/polygons/shortest_way.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <queue>

namespace lamella {
namespace {

using Point = PolygonSight::Point;
using Corner = PolygonSight::Corner;

double distance(Point a, Point b) {
    const auto x = static_cast<double>(a.X - b.X), y = static_cast<double>(a.Y - b.Y);
    return std::sqrt(x * x + y * y);
}

int sign(std::int64_t v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// Returns the side of the line from `from` through a corner on which both edges of the corner lie: 1 left,
/// -1 right. Returns 0 if the line passes between them; then no shortest path along the line bends there.
int edges_side(Point from, const Corner& c) {
    const int before = sign(PolygonSight::side(from, c.at, c.before)),
              after = sign(PolygonSight::side(from, c.at, c.after));
    if (before * after < 0) return 0;
    return before != 0 ? before : after;
}

/// The search among the corners within an ellipse.
class Search {
  public:
    Search(const PolygonSight& inside, Point from, Point to, double longest, std::int64_t max_steps)
        : inside_(inside), from_(from), to_(to), longest_(longest), max_steps_(max_steps) {
        const auto reach = static_cast<ClipperLib::cInt>(longest / 2) + 1;
        const ClipperLib::cInt middle = (from.X + to.X) / 2;
        const auto& bends = inside.bends();
        const auto x_of = [](const Corner& c) { return c.at.X; };
        const auto begin = std::ranges::lower_bound(bends, middle - reach, {}, x_of);
        const auto end = std::ranges::upper_bound(bends, middle + reach, {}, x_of);
        std::copy_if(begin, end, std::back_inserter(corners_),
                     [&](const Corner& c) { return distance(from, c.at) + distance(c.at, to) <= longest; });
        steps_ = end - begin;
        cut_short_ = corners_.size() < bends.size();
        parents_.assign(corners_.size() + 1, unseen);
    }

    std::optional<std::vector<Point>> run() {
        push_from(start, 0);
        while (!open_.empty() && steps_ < max_steps_) {
            const Step step = open_.top();
            open_.pop();
            if (parents_[index(step.to)] != unseen) continue;
            if (!inside_.sees(place(step.from), place(step.to), steps_)) continue;
            parents_[index(step.to)] = step.from;
            if (step.to == target()) return way();
            push_from(step.to, step.length);
        }
        return std::nullopt;
    }
    /// Returns true if the limits excluded paths, so that a longer one may exist.
    bool cut_short() const { return cut_short_; }
    std::int64_t steps() const { return steps_; }

  private:
    static constexpr int start = -1, unseen = -2;

    /// A straight piece whose visibility has not been tested yet.
    struct Step {
        double estimate;  ///< estimated length of the whole path
        double length;    ///< length up to the piece's end
        int from, to;
        bool operator<(const Step& other) const {  // the best step is the greatest
            if (estimate != other.estimate) return estimate > other.estimate;
            return to != other.to ? to > other.to : from > other.from;
        }
    };

    static std::size_t index(int node) { return static_cast<std::size_t>(node); }
    int target() const { return static_cast<int>(corners_.size()); }
    Point place(int node) const {
        return node == start ? from_ : node == target() ? to_ : corners_[index(node)].at;
    }

    /// Returns true if a path that has reached a node may continue to a point: it must bend around the
    /// corner, not away from it.
    bool bends_towards(int node, Point next) const {
        if (node == start) return true;
        const Corner& c = corners_[index(node)];
        const Point before = place(parents_[index(node)]);
        const int turn = sign(PolygonSight::side(before, c.at, next));
        return turn == 0 || turn == edges_side(before, c);
    }

    void push_from(int node, double length) {
        const Point at = place(node);
        for (int next = 0; next <= target(); ++next) {
            ++steps_;
            const Point to = place(next);
            if (parents_[index(next)] != unseen || to == at || !bends_towards(node, to)) continue;
            if (next != target() && edges_side(at, corners_[index(next)]) == 0) continue;
            const double there = length + distance(at, to), estimate = there + distance(to, to_);
            if (estimate <= longest_) {
                open_.push({estimate, there, node, next});
            } else {
                cut_short_ = true;
            }
        }
    }

    std::vector<Point> way() const {
        std::vector<Point> corners;
        for (int node = parents_[index(target())]; node != start; node = parents_[index(node)])
            corners.push_back(place(node));
        std::ranges::reverse(corners);
        return corners;
    }

    const PolygonSight& inside_;
    Point from_, to_;
    double longest_;
    std::int64_t max_steps_, steps_ = 0;
    bool cut_short_ = false;
    std::vector<Corner> corners_;
    std::vector<int> parents_;  // of each corner that has been reached, and of the target
    std::priority_queue<Step> open_;
};

}  // namespace

std::optional<std::vector<Point>> shortest_way(const PolygonSight& inside, Point from, Point to,
                                               double longest, std::int64_t max_steps) {
    std::int64_t steps = 0;
    if (inside.sees(from, to, steps)) return std::vector<Point>();
    constexpr double first_detour = 1.5, growth = 2;
    for (double reach = first_detour * distance(from, to); steps < max_steps; reach *= growth) {
        Search search(inside, from, to, std::min(reach, longest), max_steps - steps);
        if (auto way = search.run()) return way;
        if (!search.cut_short() || reach >= longest) break;
        steps += search.steps();
    }
    return std::nullopt;
}

}  // namespace lamella
