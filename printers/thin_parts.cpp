// The flat stretches of the medial axis, and what hangs off them.
#include "printers/thin_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lamella {
namespace {

/// How fast the radius may change along a line: in the middle of a wall, and towards its ends.
constexpr double flat = 0.25, tapering = 0.7;
/// How much thicker than the limit the knots may be that lines pass: where two walls cross, it is sqrt(2).
constexpr double thickest_knot = 1.45;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

double dot(dvec2 a, dvec2 b) { return a.x * b.x + a.y * b.y; }
double length(dvec2 v) { return std::sqrt(dot(v, v)); }

/// An edge's share of the island: from its contacts on the right to those on the left.
std::array<dvec2, 6> share_of(const MedialAxis& axis, const MedialEdge& e) {
    return {e.right[0], e.right[1], axis.nodes[e.node[1]].at, e.left[1], e.left[0], axis.nodes[e.node[0]].at};
}

double area_of(const std::array<dvec2, 6>& points) {
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec2 p = points[i] - points[0], q = points[(i + 1) % points.size()] - points[0];
        twice += p.x * q.y - p.y * q.x;
    }
    return twice / 2;
}

class ThinFinder {
  public:
    ThinFinder(const MedialAxis& axis, double thinnest, double thickest, double tolerance)
        : axis_(axis), thinnest_(thinnest), limit_(thickest / 2), tolerance_(tolerance) {}

    ThinParts find() {
        split_at_limit();
        join_nodes();
        choose_lines();
        cross_knots();
        absorb_ends();
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (is_point(e) && goes_with_line(link_[e][0])) kind_[e] = Kind::side;
        }
        ThinParts parts;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (kind_[e] == Kind::rest) {
                parts.whole = false;
            } else {
                parts.area += area_of(share_of(axis_, edges_[e]));
            }
        }
        if (!(parts.area > 0)) return {{}, 0, false, {}};
        trace(parts.lines);
        if (!parts.whole) {
            for (std::size_t e = 0; e < edges_.size(); ++e) {
                if (kind_[e] == Kind::rest) continue;
                const auto points = share_of(axis_, edges_[e]);
                parts.covered.push_back(to_polygon({points.begin(), points.end()}));
            }
        }
        return parts;
    }

  private:
    enum class Kind : std::uint8_t {
        rest,
        line,  ///< part of a line
        side   ///< covered by the line that it hangs on
    };
    static constexpr double slack = 1e-6;  // mm

    double radius(std::uint32_t node) const { return axis_.nodes[node].radius; }
    bool at_limit(std::uint32_t node) const { return radius(node) > limit_ - slack; }
    double length_of(std::size_t e) const {
        return length(axis_.nodes[link_[e][1]].at - axis_.nodes[link_[e][0]].at);
    }
    bool thin(std::size_t e) const {
        return std::max(radius(link_[e][0]), radius(link_[e][1])) < limit_ + slack;
    }
    double slope(std::size_t e) const {
        const double l = length_of(e), rise = std::abs(radius(link_[e][0]) - radius(link_[e][1]));
        return l > 0 ? rise / l : 0;
    }

    /// Cuts edges where the axis grows thicker than the limit.
    void split_at_limit() {
        for (const MedialEdge& e : axis_.edges) {
            const double r0 = radius(e.node[0]), r1 = radius(e.node[1]);
            if ((r0 - limit_) * (r1 - limit_) >= 0 ||
                std::min(std::abs(r0 - limit_), std::abs(r1 - limit_)) < slack) {
                edges_.push_back(e);
                continue;
            }
            const double t = (limit_ - r0) / (r1 - r0);
            const auto between = [&](dvec2 a, dvec2 b) { return a + (b - a) * t; };
            const auto middle = static_cast<std::uint32_t>(axis_.nodes.size());
            const dvec2 left = between(e.left[0], e.left[1]), right = between(e.right[0], e.right[1]);
            const dvec2 at = between(axis_.nodes[e.node[0]].at, axis_.nodes[e.node[1]].at);
            axis_.nodes.push_back({at, limit_});
            edges_.push_back({{e.node[0], middle}, {e.left[0], left}, {e.right[0], right}});
            edges_.push_back({{middle, e.node[1]}, {left, e.left[1]}, {right, e.right[1]}});
        }
        kind_.assign(edges_.size(), Kind::rest);
    }

    /// Joins nodes that are next to each other, so that four ways that meet do so in one place.
    void join_nodes() {
        std::vector<std::uint32_t> same(axis_.nodes.size());
        std::iota(same.begin(), same.end(), 0U);
        const auto root = [&](std::uint32_t node) {
            while (same[node] != node) node = same[node] = same[same[node]];
            return node;
        };
        for (const MedialEdge& e : edges_) {
            const dvec2 way = axis_.nodes[e.node[1]].at - axis_.nodes[e.node[0]].at;
            if (length(way) < tolerance_ / 2) same[root(e.node[1])] = root(e.node[0]);
        }
        tail_.resize(axis_.nodes.size());
        at_node_.resize(axis_.nodes.size());
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            link_.push_back({root(edges_[e].node[0]), root(edges_[e].node[1])});
            if (link_[e][0] == link_[e][1]) continue;
            for (const std::uint32_t node : link_[e]) at_node_[node].push_back(e);
        }
    }

    std::uint32_t other(std::uint32_t e, std::uint32_t node) const {
        return link_[e][0] == node ? link_[e][1] : link_[e][0];
    }
    bool is_point(std::size_t e) const { return link_[e][0] == link_[e][1]; }

    /// Lines are connected stretches that taper at most, of which enough is flat.
    void choose_lines() {
        std::vector<bool> seen(edges_.size());
        for (std::uint32_t start = 0; start < edges_.size(); ++start) {
            if (seen[start] || is_point(start) || !thin(start) || slope(start) > tapering) continue;
            std::vector<std::uint32_t> stretch{start};
            seen[start] = true;
            double flat_length = 0, widest = 0;
            for (std::size_t i = 0; i < stretch.size(); ++i) {
                const std::uint32_t e = stretch[i];
                if (slope(e) <= flat) flat_length += length_of(e);
                for (const std::uint32_t node : link_[e]) {
                    widest = std::max(widest, radius(node));
                    for (const std::uint32_t next : at_node_[node]) {
                        if (seen[next] || !thin(next) || slope(next) > tapering) continue;
                        seen[next] = true;
                        stretch.push_back(next);
                    }
                }
            }
            if (flat_length < widest / 2 || 2 * widest < thinnest_) continue;
            for (const std::uint32_t e : stretch) kind_[e] = Kind::line;
        }
    }

    bool on_line(std::uint32_t node) const {
        return std::ranges::any_of(at_node_[node], [&](std::uint32_t e) { return kind_[e] == Kind::line; });
    }

    bool goes_with_line(std::uint32_t node) const {
        return std::ranges::any_of(at_node_[node], [&](std::uint32_t e) { return kind_[e] != Kind::rest; });
    }

    /// Where lines meet it is thicker than along them; they go on through what is not much thicker.
    void cross_knots() {
        std::vector<bool> seen(edges_.size());
        for (std::uint32_t start = 0; start < edges_.size(); ++start) {
            if (seen[start] || is_point(start) || kind_[start] != Kind::rest) continue;
            // All that is connected with it and no line.
            std::vector<std::uint32_t> knot{start};
            seen[start] = true;
            double widest = 0;
            for (std::size_t i = 0; i < knot.size(); ++i) {
                for (const std::uint32_t node : link_[knot[i]]) {
                    widest = std::max(widest, radius(node));
                    if (on_line(node)) continue;
                    for (const std::uint32_t next : at_node_[node]) {
                        if (seen[next]) continue;
                        seen[next] = true;
                        knot.push_back(next);
                    }
                }
            }
            if (widest <= thickest_knot * limit_) pass_lines(knot);
        }
    }

    /// Makes lines of the ways through a knot from line to line, and sides of the rest.
    void pass_lines(const std::vector<std::uint32_t>& knot) {
        std::vector<std::uint32_t> degree(axis_.nodes.size()), ends, loose;
        for (const std::uint32_t e : knot) {
            for (const std::uint32_t node : link_[e]) {
                if (degree[node]++ == 0 && on_line(node)) ends.push_back(node);
            }
        }
        if (ends.size() < 2) return;
        for (const std::uint32_t e : knot) kind_[e] = Kind::line;
        for (const std::uint32_t e : knot) {
            for (const std::uint32_t node : link_[e]) {
                if (degree[node] == 1 && std::ranges::find(ends, node) == ends.end()) loose.push_back(node);
            }
        }
        // Dead ends go, edge by edge, as far as a line's round end covers what they lead to.
        constexpr double covers = 1.5;  // radii
        std::vector<double> reach(axis_.nodes.size());
        while (!loose.empty()) {
            const std::uint32_t node = loose.back();
            loose.pop_back();
            for (const std::uint32_t e : at_node_[node]) {
                if (kind_[e] != Kind::line) continue;
                const std::uint32_t before = other(e, node);
                const double far = reach[node] + length_of(e);
                if (far > covers * std::min(radius(before), limit_)) break;
                reach[before] = std::max(reach[before], far);
                tail_[before] += tail_[node] + area_of(share_of(axis_, edges_[e]));
                kind_[e] = Kind::side;
                if (--degree[before] == 1 && std::ranges::find(ends, before) == ends.end())
                    loose.push_back(before);
                break;
            }
        }
    }

    /// What hangs on a line goes with it; where that leads on to something thicker, the line does.
    void absorb_ends() {
        for (std::uint32_t node = 0; node < at_node_.size(); ++node) {
            if (!on_line(node) || at_limit(node)) continue;
            std::vector<std::uint32_t> nodes{node}, came_by{none};
            std::uint32_t leads_on = none;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                if (at_limit(nodes[i])) {
                    if (leads_on == none) leads_on = static_cast<std::uint32_t>(i);
                    continue;
                }
                for (const std::uint32_t e : at_node_[nodes[i]]) {
                    if (kind_[e] != Kind::rest || !thin(e)) continue;
                    kind_[e] = Kind::side;
                    tail_[node] += area_of(share_of(axis_, edges_[e]));
                    nodes.push_back(other(e, nodes[i]));
                    came_by.push_back(e);
                }
            }
            if (leads_on == none) continue;
            tail_[node] = 0;
            for (std::size_t i = leads_on; i > 0;) {
                const std::uint32_t e = came_by[i];
                kind_[e] = Kind::line;
                const std::uint32_t before = other(e, nodes[i]);
                i = static_cast<std::size_t>(std::ranges::find(nodes, before) - nodes.begin());
            }
        }
    }

    /// The edge on which a line that comes by `e` goes on behind `node`: of those that go straight on best.
    std::uint32_t next(std::uint32_t e, std::uint32_t node) const {
        constexpr double straight = -0.3;  // cosine between the two ways out of the node
        const auto out = [&](std::uint32_t edge) {
            const dvec2 w = axis_.nodes[other(edge, node)].at - axis_.nodes[node].at;
            const double l = length(w);
            return l > 0 ? w / l : dvec2(0);
        };
        const auto partner = [&](std::uint32_t edge) {
            std::uint32_t best = none;
            double least = std::numeric_limits<double>::infinity();
            std::size_t lines = 0;
            for (const std::uint32_t f : at_node_[node]) {
                if (kind_[f] != Kind::line) continue;
                ++lines;
                if (f == edge) continue;
                const double c = dot(out(edge), out(f));
                if (c < least || (c == least && f < best)) {
                    least = c;
                    best = f;
                }
            }
            return lines == 2 || least < straight ? best : none;
        };
        const std::uint32_t best = partner(e);
        return best != none && partner(best) == e ? best : none;
    }

    struct Chain {
        std::vector<std::uint32_t> nodes;
        bool closed = false;
    };

    Chain walk(std::uint32_t e, std::uint32_t from, std::vector<bool>& done) const {
        Chain chain{{from}, false};
        const std::uint32_t first = e;
        std::uint32_t node = from;
        while (true) {
            done[e] = true;
            node = other(e, node);
            chain.nodes.push_back(node);
            e = next(e, node);
            if (e == first) {
                chain.closed = true;
                chain.nodes.pop_back();
                return chain;
            }
            if (e == none || done[e]) return chain;
        }
    }

    void trace(std::vector<TaperedLine>& lines) const {
        std::vector<bool> done(edges_.size());
        for (const bool ends : {true, false}) {  // lines that end somewhere, then those that do not
            for (std::uint32_t e = 0; e < edges_.size(); ++e) {
                for (const std::uint32_t node : link_[e]) {
                    if (done[e] || kind_[e] != Kind::line || (ends && next(e, node) != none)) continue;
                    add(walk(e, node, done), lines);
                }
            }
        }
        // What remains of a branch between a line's flank and its own end may be too short to be worth a way.
        const auto is_speck = [](const TaperedLine& line) {
            const double widest = std::ranges::max(line.thickness);
            return area_of(line) < 0.25 * widest * widest;
        };
        if (!std::ranges::all_of(lines, is_speck)) std::erase_if(lines, is_speck);
    }

    void add(const Chain& chain, std::vector<TaperedLine>& lines) const {
        TaperedLine line;
        line.closed = chain.closed;
        for (const std::uint32_t node : chain.nodes) {
            const dvec2 at = axis_.nodes[node].at;
            if (!line.points.empty() && length(at - line.points.back()) == 0) continue;
            line.points.push_back(at);
            line.thickness.push_back(2 * std::min(radius(node), limit_));
        }
        if (!line.closed) {
            end_line(line, chain.nodes.back());
            std::ranges::reverse(line.points);
            std::ranges::reverse(line.thickness);
            end_line(line, chain.nodes.front());
        }
        if (line.points.size() >= 2) lines.push_back(simplified(line));
    }

    /// Brings the last end of a line to its place.
    void end_line(TaperedLine& line, std::uint32_t node) const {
        if (line.points.size() < 2) return;
        const auto lines =
            std::ranges::count_if(at_node_[node], [&](std::uint32_t e) { return kind_[e] == Kind::line; });
        if (lines > 1) {
            // It meets one that passes, and ends in that one's flank.
            shorten(line, radius(node) * 0.75);
            return;
        }
        while (line.points.size() > 1 && line.thickness.back() < thinnest_) {
            line.points.pop_back();
            line.thickness.pop_back();
        }
        if (line.points.size() < 2 || at_limit(node) || line.thickness.back() < 2 * radius(node)) return;
        const double r = radius(node);
        if (!(r > 0)) return;
        const dvec2 last = line.points.back() - line.points[line.points.size() - 2];
        const double l = length(last);
        if (l > 0) {
            line.points.push_back(line.points.back() + last * (std::min(tail_[node] / (2 * r), r / 2) / l));
            line.thickness.push_back(line.thickness.back());
        }
    }

    static void shorten(TaperedLine& line, double by) {
        while (line.points.size() > 2) {
            const double l = length(line.points.back() - line.points[line.points.size() - 2]);
            if (l > by) break;
            by -= l;
            line.points.pop_back();
            line.thickness.pop_back();
        }
        const std::size_t n = line.points.size();
        const dvec2 last = line.points[n - 1] - line.points[n - 2];
        const double l = length(last), t = l > 0 ? std::min(by / l, 0.75) : 0;
        line.points[n - 1] -= last * t;
        line.thickness[n - 1] += (line.thickness[n - 2] - line.thickness[n - 1]) * t;
    }

    /// With fewer points (Douglas and Peucker 1973), thickness taken as a third coordinate.
    TaperedLine simplified(const TaperedLine& line) const {
        const std::size_t n = line.points.size();
        std::vector<bool> kept(n);
        kept[0] = kept[n - 1] = true;
        std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
        while (!open.empty()) {
            const auto [a, b] = open.back();
            open.pop_back();
            double worst = tolerance_;
            std::size_t at = a;
            const dvec2 across = line.points[b] - line.points[a];
            const double square = dot(across, across);
            for (std::size_t i = a + 1; i < b; ++i) {
                const dvec2 p = line.points[i] - line.points[a];
                const double t = square > 0 ? std::clamp(dot(p, across) / square, 0.0, 1.0) : 0;
                const double thickness = line.thickness[a] + (line.thickness[b] - line.thickness[a]) * t;
                const double off = std::max(length(p - across * t), std::abs(line.thickness[i] - thickness));
                if (off > worst) {
                    worst = off;
                    at = i;
                }
            }
            if (at == a) continue;
            kept[at] = true;
            open.push_back({a, at});
            open.push_back({at, b});
        }
        TaperedLine result;
        result.closed = line.closed;
        for (std::size_t i = 0; i < n; ++i) {
            if (!kept[i]) continue;
            result.points.push_back(line.points[i]);
            result.thickness.push_back(line.thickness[i]);
        }
        return result;
    }

    MedialAxis axis_;
    double thinnest_, limit_, tolerance_;  // mm
    std::vector<MedialEdge> edges_;
    std::vector<std::array<std::uint32_t, 2>> link_;  ///< nodes of each edge, those next to each other as one
    std::vector<Kind> kind_;
    std::vector<std::vector<std::uint32_t>> at_node_;  ///< edges
    std::vector<double> tail_;                         ///< area of the sides that hang on a node, mm^2
};

}  // namespace

double area_of(const TaperedLine& line) {
    double area = 0;
    const std::size_t n = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
        const std::size_t j = (i + 1) % n;
        area += length(line.points[j] - line.points[i]) * (line.thickness[i] + line.thickness[j]) / 2;
    }
    return area;
}

ThinParts find_thin_parts(const MedialAxis& axis, double thinnest, double thickest, double tolerance) {
    return ThinFinder(axis, thinnest, thickest, tolerance).find();
}

}  // namespace lamella
