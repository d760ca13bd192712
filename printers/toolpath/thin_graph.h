// ThinGraph: the medial axis as a graph whose edges are classified as thin or not.
#pragma once

#include <array>
#include <limits>

#include "printers/polygons/medial_axis.h"

namespace lamella {

/// Finds the edges of a medial axis that are centre lines of thin parts. Lengths in mm.
class ThinGraph {
  public:
    enum class Kind : std::uint8_t {
        rest,
        line,  ///< part of a line
        side   ///< covered by the line that it branches from
    };
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// See find_thin_parts.
    ThinGraph(const MedialAxis& axis, double thinnest, double thickest, double tolerance);

    std::size_t edges() const { return edges_.size(); }
    Kind kind(std::size_t e) const { return kind_[e]; }
    /// Returns the end nodes of an edge. Ends that almost coincide are one node.
    const std::array<std::uint32_t, 2>& link(std::size_t e) const { return link_[e]; }
    std::uint32_t other(std::uint32_t e, std::uint32_t node) const {
        return link_[e][0] == node ? link_[e][1] : link_[e][0];
    }
    const std::vector<std::uint32_t>& edges_at(std::uint32_t node) const { return at_node_[node]; }

    dvec2 at(std::uint32_t node) const { return axis_.nodes[node].at; }
    double radius(std::uint32_t node) const { return axis_.nodes[node].radius; }
    double limit() const { return limit_; }  ///< largest radius of a thin part
    bool at_limit(std::uint32_t node) const { return radius(node) > limit_ - slack; }
    /// Returns the area of the sides that hang on a node, mm^2.
    double tail(std::uint32_t node) const { return tail_[node]; }

    /// Returns the polygon of the island that belongs to an edge: from its contact points on the right to
    /// those on the left.
    std::array<dvec2, 6> share(std::size_t e) const;
    double share_area(std::size_t e) const;

  private:
    static constexpr double slack = 1e-6;

    void split_at_limit();
    void join_nodes();
    void choose_lines();
    void cross_knots();
    void pass_lines(const std::vector<std::uint32_t>& knot);
    void absorb_ends();
    void absorb_points();

    double length_of(std::size_t e) const;
    bool thin(std::size_t e) const;
    double slope(std::size_t e) const;
    bool is_point(std::size_t e) const { return link_[e][0] == link_[e][1]; }
    bool on_line(std::uint32_t node) const;
    bool goes_with_line(std::uint32_t node) const;

    MedialAxis axis_;
    double thinnest_, limit_, tolerance_;
    std::vector<MedialEdge> edges_;
    std::vector<std::array<std::uint32_t, 2>> link_;
    std::vector<Kind> kind_;
    std::vector<std::vector<std::uint32_t>> at_node_;
    std::vector<double> tail_;
};

}  // namespace lamella
