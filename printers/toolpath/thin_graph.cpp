// Finds flat stretches of the axis, the junctions between them, and the branches off them.
#include "printers/toolpath/thin_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lamella {
namespace {

/// Largest change of the radius per length of a line: in the middle of a wall, and towards its ends.
constexpr double flat = 0.25, tapering = 0.7;
/// Largest radius, relative to the limit, of junctions that lines pass; where two walls cross it is sqrt(2).
constexpr double thickest_knot = 1.45;

}  // namespace

ThinGraph::ThinGraph(const MedialAxis& axis, double thinnest, double thickest, double tolerance)
    : axis_(axis), thinnest_(thinnest), limit_(thickest / 2), tolerance_(tolerance) {
    split_at_limit();
    join_nodes();
    choose_lines();
    cross_knots();
    absorb_ends();
    absorb_points();
}

std::array<dvec2, 6> ThinGraph::share(std::size_t e) const {
    const MedialEdge& edge = edges_[e];
    return {edge.right[0], edge.right[1], at(edge.node[1]), edge.left[1], edge.left[0], at(edge.node[0])};
}

double ThinGraph::share_area(std::size_t e) const {
    const std::array<dvec2, 6> points = share(e);
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const dvec2 p = points[i] - points[0], q = points[(i + 1) % points.size()] - points[0];
        twice += p.x * q.y - p.y * q.x;
    }
    return twice / 2;
}

double ThinGraph::length_of(std::size_t e) const { return length(at(link_[e][1]) - at(link_[e][0])); }

bool ThinGraph::thin(std::size_t e) const {
    return std::max(radius(link_[e][0]), radius(link_[e][1])) < limit_ + slack;
}

double ThinGraph::slope(std::size_t e) const {
    const double l = length_of(e), rise = std::abs(radius(link_[e][0]) - radius(link_[e][1]));
    return l > 0 ? rise / l : 0;
}

bool ThinGraph::on_line(std::uint32_t node) const {
    return std::ranges::any_of(at_node_[node], [&](std::uint32_t e) { return kind_[e] == Kind::line; });
}

bool ThinGraph::goes_with_line(std::uint32_t node) const {
    return std::ranges::any_of(at_node_[node], [&](std::uint32_t e) { return kind_[e] != Kind::rest; });
}

/// Splits edges where the radius exceeds the limit.
void ThinGraph::split_at_limit() {
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

/// Merges nodes that almost coincide, so that four branches that meet share one node.
void ThinGraph::join_nodes() {
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

/// Selects the lines: connected stretches that taper at most, with a sufficient flat part.
void ThinGraph::choose_lines() {
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

/// Junctions of lines are thicker than the lines. Lines continue through junctions that are not much thicker.
void ThinGraph::cross_knots() {
    std::vector<bool> seen(edges_.size());
    for (std::uint32_t start = 0; start < edges_.size(); ++start) {
        if (seen[start] || is_point(start) || kind_[start] != Kind::rest) continue;
        // The connected component of edges that are not lines.
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

/// Turns the paths through a junction from line to line into lines, and the rest into sides.
void ThinGraph::pass_lines(const std::vector<std::uint32_t>& knot) {
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
    // Dead ends become sides, edge by edge, as far as the round end of a line covers what they lead to.
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
            tail_[before] += tail_[node] + share_area(e);
            kind_[e] = Kind::side;
            if (--degree[before] == 1 && std::ranges::find(ends, before) == ends.end())
                loose.push_back(before);
            break;
        }
    }
}

/// A branch of a line becomes its side. If the branch leads to a thicker part, the path there becomes a line.
void ThinGraph::absorb_ends() {
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
                tail_[node] += share_area(e);
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
/// Edges of zero length join the lines around them.
void ThinGraph::absorb_points() {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        if (is_point(e) && goes_with_line(link_[e][0])) kind_[e] = Kind::side;
    }
}

}  // namespace lamella
