// Traces lines along the thin edges of a graph from end to end.
#include "printers/toolpath/thin_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

#include "printers/toolpath/thin_graph.h"

namespace lamella {
namespace {

using EndKind = ThinGraph::Kind;

/// Removes `by` mm from the end of a line.
void shorten(TaperedLine& line, double by) {
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

/// Simplifies a line by Douglas and Peucker (1973), with the thickness as a third coordinate.
TaperedLine simplified(const TaperedLine& line, double tolerance) {
    const std::size_t n = line.points.size();
    std::vector<bool> kept(n);
    kept[0] = kept[n - 1] = true;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        double worst = tolerance;
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

class LineTracer {
  public:
    LineTracer(const ThinGraph& graph, double thinnest, double tolerance)
        : graph_(graph), thinnest_(thinnest), tolerance_(tolerance) {}

    std::vector<TaperedLine> trace() const {
        std::vector<TaperedLine> lines;
        std::vector<bool> done(graph_.edges());
        for (const bool ends : {true, false}) {  // lines with an end, then closed ones
            for (std::uint32_t e = 0; e < graph_.edges(); ++e) {
                for (const std::uint32_t node : graph_.link(e)) {
                    if (done[e] || graph_.kind(e) != EndKind::line ||
                        (ends && next(e, node) != ThinGraph::none))
                        continue;
                    add(walk(e, node, done), lines);
                }
            }
        }
        // The rest of a branch outside the flank of the line it joins may be too short to be worth a travel.
        const auto is_speck = [](const TaperedLine& line) {
            const double widest = std::ranges::max(line.thickness);
            return area_of(line) < 0.25 * widest * widest;
        };
        if (!std::ranges::all_of(lines, is_speck)) std::erase_if(lines, is_speck);
        return lines;
    }

  private:
    /// Returns the edge on which a line that arrives by `e` continues after `node`: the one that is most
    /// nearly straight on.
    std::uint32_t next(std::uint32_t e, std::uint32_t node) const {
        constexpr double straight = -0.3;  // cosine between the directions of two edges away from the node
        const auto out = [&](std::uint32_t edge) {
            const dvec2 w = graph_.at(graph_.other(edge, node)) - graph_.at(node);
            const double l = length(w);
            return l > 0 ? w / l : dvec2(0);
        };
        const auto partner = [&](std::uint32_t edge) {
            std::uint32_t best = ThinGraph::none;
            double least = std::numeric_limits<double>::infinity();
            std::size_t lines = 0;
            for (const std::uint32_t f : graph_.edges_at(node)) {
                if (graph_.kind(f) != EndKind::line) continue;
                ++lines;
                if (f == edge) continue;
                const double c = dot(out(edge), out(f));
                if (c < least || (c == least && f < best)) {
                    least = c;
                    best = f;
                }
            }
            return lines == 2 || least < straight ? best : ThinGraph::none;
        };
        const std::uint32_t best = partner(e);
        return best != ThinGraph::none && partner(best) == e ? best : ThinGraph::none;
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
            node = graph_.other(e, node);
            chain.nodes.push_back(node);
            e = next(e, node);
            if (e == first) {
                chain.closed = true;
                chain.nodes.pop_back();
                return chain;
            }
            if (e == ThinGraph::none || done[e]) return chain;
        }
    }

    void add(const Chain& chain, std::vector<TaperedLine>& lines) const {
        TaperedLine line;
        line.closed = chain.closed;
        for (const std::uint32_t node : chain.nodes) {
            const dvec2 at = graph_.at(node);
            if (!line.points.empty() && length(at - line.points.back()) == 0) continue;
            line.points.push_back(at);
            line.thickness.push_back(2 * std::min(graph_.radius(node), graph_.limit()));
        }
        if (!line.closed) {
            end_line(line, chain.nodes.back());
            std::ranges::reverse(line.points);
            std::ranges::reverse(line.thickness);
            end_line(line, chain.nodes.front());
        }
        if (line.points.size() >= 2) lines.push_back(simplified(line, tolerance_));
    }

    /// Moves the last end of a line to its final position.
    void end_line(TaperedLine& line, std::uint32_t node) const {
        if (line.points.size() < 2) return;
        const auto lines = std::ranges::count_if(
            graph_.edges_at(node), [&](std::uint32_t e) { return graph_.kind(e) == EndKind::line; });
        if (lines > 1) {
            // The line ends in the flank of another line that passes.
            shorten(line, graph_.radius(node) * 0.75);
            return;
        }
        while (line.points.size() > 1 && line.thickness.back() < thinnest_) {
            line.points.pop_back();
            line.thickness.pop_back();
        }
        if (line.points.size() < 2 || graph_.at_limit(node) ||
            line.thickness.back() < 2 * graph_.radius(node))
            return;
        const double r = graph_.radius(node);
        if (!(r > 0)) return;
        const dvec2 last = line.points.back() - line.points[line.points.size() - 2];
        const double l = length(last);
        if (l > 0) {
            line.points.push_back(line.points.back() +
                                  last * (std::min(graph_.tail(node) / (2 * r), r / 2) / l));
            line.thickness.push_back(line.thickness.back());
        }
    }

    const ThinGraph& graph_;
    double thinnest_, tolerance_;  // mm
};

/// Returns a share whose contact points lie `beyond` mm outside of the border, so that its sides do not run
/// along it.
ClipperLib::Path beyond_border(std::array<dvec2, 6> share, double beyond) {
    const auto push = [&](dvec2& contact, dvec2 centre) {
        const dvec2 out = contact - centre;
        if (const double l = length(out); l > 0) contact += out * (beyond / l);
    };
    push(share[0], share[5]);
    push(share[4], share[5]);
    push(share[1], share[2]);
    push(share[3], share[2]);
    return to_polygon({share.begin(), share.end()});
}

/// Joins polygons along the sides that two of them have in common. The sides that are left make rings.
Polygons joined_along_sides(const Polygons& polygons) {
    using Point = std::pair<ClipperLib::cInt, ClipperLib::cInt>;
    struct Side {
        Point from, to;
        bool operator<(const Side& other) const {
            return std::tie(from, to) < std::tie(other.from, other.to);
        }
    };
    // Sides in both directions are neighbours in an order that knows no direction.
    std::vector<Side> all;
    for (const ClipperLib::Path& polygon : polygons) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const ClipperLib::IntPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
            if (p != q) all.push_back({{p.X, p.Y}, {q.X, q.Y}});
        }
    }
    const auto undirected = [](const Side& side) { return std::minmax(side.from, side.to); };
    std::ranges::sort(all, [&](const Side& a, const Side& b) {
        return std::pair(undirected(a), a.from) < std::pair(undirected(b), b.from);
    });
    std::vector<Side> sides;
    for (const Side& side : all) {
        if (!sides.empty() && sides.back().from == side.to && sides.back().to == side.from) {
            sides.pop_back();
        } else {
            sides.push_back(side);
        }
    }
    std::ranges::sort(sides, std::less<>());
    std::vector<bool> used(sides.size());
    // Returns the first unused side from a point; where rings touch there are several.
    const auto side_from = [&](const Point& point) {
        auto i =
            static_cast<std::size_t>(std::ranges::lower_bound(sides, point, {}, &Side::from) - sides.begin());
        while (used[i]) ++i;
        return i;
    };
    Polygons rings;
    for (std::size_t first = 0; first < sides.size(); ++first) {
        if (used[first]) continue;
        ClipperLib::Path ring;
        std::size_t i = first;
        for (;;) {
            used[i] = true;
            ring.emplace_back(sides[i].from.first, sides[i].from.second);
            if (sides[i].to == sides[first].from) break;
            i = side_from(sides[i].to);
        }
        rings.push_back(std::move(ring));
    }
    return rings;
}

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
    const ThinGraph graph(axis, thinnest, thickest, tolerance);
    ThinParts parts;
    for (std::size_t e = 0; e < graph.edges(); ++e) {
        if (graph.kind(e) == EndKind::rest) {
            parts.whole = false;
        } else {
            parts.area += graph.share_area(e);
        }
    }
    if (!(parts.area > 0)) return {{}, 0, false, {}};
    parts.lines = LineTracer(graph, thinnest, tolerance).trace();
    if (parts.whole) return parts;
    Polygons shares;
    for (std::size_t e = 0; e < graph.edges(); ++e) {
        if (graph.kind(e) != EndKind::rest) shares.push_back(beyond_border(graph.share(e), 2 * tolerance));
    }
    parts.covered = joined_along_sides(shares);
    return parts;
}

}  // namespace lamella
