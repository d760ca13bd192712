// Clipping a convex cell in its dual form.
#include "procedural/voronoi/voronoi_cell.h"
#include "procedural/voronoi/rounding.h"

#include <cmath>

namespace lamella {
namespace {

constexpr double tie_tolerance = 1e-12;

}  // namespace

void VoronoiCell::start(double half_side) {
    // Planes 0 and 1 bound x, 2 and 3 y, 4 and 5 z; the even ones are the lower bounds.
    ids_.assign({-6, -5, -4, -3, -2, -1});
    border_at_.assign(6, -1);
    resize(8);
    for (std::int32_t v = 0; v < 8; ++v) {
        const std::int32_t bit_x = v & 1, bit_y = (v >> 1) & 1, bit_z = v >> 2;
        const auto at = static_cast<std::size_t>(v);
        x_[at] = bit_x ? half_side : -half_side;
        y_[at] = bit_y ? half_side : -half_side;
        z_[at] = bit_z ? half_side : -half_side;
        // The edge on planes x and y leads to the neighbour across z, and so on cyclically. The orientation
        // alternates with the parity of the corner.
        const bool odd = (bit_x + bit_y + bit_z) % 2 != 0;
        const std::int32_t px = bit_x, py = 2 + bit_y, pz = 4 + bit_z;
        links_[at] =
            odd ? Link{{px, py, pz}, {v ^ 4, v ^ 1, v ^ 2}} : Link{{px, pz, py}, {v ^ 2, v ^ 1, v ^ 4}};
    }
    measure();
}

bool VoronoiCell::clip(dvec3 offset, std::int32_t id) {
    const double half_square = 0.5 * (offset.x * offset.x + offset.y * offset.y + offset.z * offset.z);
    const std::size_t count = links_.size();
    double most = -infinity;
    const double* x = x_.data();
    const double* y = y_.data();
    const double* z = z_.data();
    double* excess = excess_.data();
    for (std::size_t v = 0; v < count; ++v) {
        const double beyond = (offset.x * x[v] + offset.y * y[v] + offset.z * z[v]) - half_square;
        excess[v] = beyond;
        most = most > beyond ? most : beyond;
    }
    if (!(most > 0)) return false;

    double tolerance = tie_tolerance * (std::abs(offset.x) + std::abs(offset.y) + std::abs(offset.z)) *
                       std::sqrt(reach_squared_);
    // Nearly tied seeds can leave a hole that is not a single loop, because of rounding. Moving the plane
    // outwards by the size of the rounding error cuts less, in the end nothing; the volume that is missed
    // then is negligible.
    while (most > tolerance) {
        if (border_of_cut(tolerance)) {
            const auto plane = static_cast<std::int32_t>(ids_.size());
            ids_.push_back(id);
            border_at_.push_back(-1);
            replace_cut_vertices(plane);
            measure();
            return true;
        }
        tolerance = std::max(tolerance * 16, most * 1e-12);
    }
    return false;
}

/// Finds the vertices beyond the plane and the loop of edges around them. Returns false if the border is not
/// a single loop or the whole cell would be cut off.
bool VoronoiCell::border_of_cut(double tolerance) {
    cut_.clear();
    border_.clear();
    const std::size_t count = links_.size();
    for (std::size_t v = 0; v < count; ++v) {
        if (excess_[v] > tolerance) cut_.push_back(static_cast<std::int32_t>(v));
    }
    for (const std::int32_t v : cut_) {
        const auto inner = static_cast<std::size_t>(v);
        const Link& link = links_[inner];
        for (std::size_t side = 0; side < 3; ++side) {
            const auto outer = static_cast<std::size_t>(link.across[side]);
            if (excess_[outer] > tolerance) continue;
            const double t =
                std::max(-excess_[outer], 0.0) / (std::max(-excess_[outer], 0.0) + excess_[inner]);
            const dvec3 from(x_[outer], y_[outer], z_[outer]);
            const dvec3 to(x_[inner], y_[inner], z_[inner]);
            border_.push_back(
                {link.plane[side], link.plane[(side + 1) % 3], link.across[side], from + (to - from) * t});
            border_at_[static_cast<std::size_t>(border_.back().from)] =
                static_cast<std::int32_t>(border_.size() - 1);
        }
    }
    if (border_.size() < 3) return false;
    const std::int32_t begin = border_.front().from;
    std::int32_t at = begin;
    for (std::size_t steps = 1; steps <= border_.size(); ++steps) {
        const std::int32_t edge = border_at_[static_cast<std::size_t>(at)];
        if (edge < 0 || static_cast<std::size_t>(edge) >= border_.size()) return false;
        if (border_[static_cast<std::size_t>(edge)].from != at) return false;
        at = border_[static_cast<std::size_t>(edge)].to;
        if (at == begin) return steps == border_.size();
    }
    return false;
}

/// Closes the hole with a fan of triangles around the new plane.
void VoronoiCell::replace_cut_vertices(std::int32_t plane) {
    const std::size_t old_count = links_.size();
    slots_ = cut_;
    while (slots_.size() < border_.size()) {
        slots_.push_back(static_cast<std::int32_t>(old_count + slots_.size() - cut_.size()));
    }
    if (border_.size() > cut_.size()) resize(old_count + border_.size() - cut_.size());

    for (std::size_t i = 0; i < border_.size(); ++i) {
        const BorderEdge& edge = border_[i];
        const std::int32_t slot = slots_[i];
        const auto at = static_cast<std::size_t>(slot);
        x_[at] = edge.vertex.x;
        y_[at] = edge.vertex.y;
        z_[at] = edge.vertex.z;
        const auto next_edge = static_cast<std::size_t>(border_at_[static_cast<std::size_t>(edge.to)]);
        const std::int32_t next = slots_[next_edge];
        links_[at].plane = {edge.from, edge.to, plane};
        links_[at].across[0] = edge.outside;
        links_[at].across[1] = next;
        links_[static_cast<std::size_t>(next)].across[2] = slot;
        relink(edge.outside, edge.to, edge.from, slot);
    }

    // Fill surplus vertices from the end. `cut_` is ascending, so the last holes go first.
    std::size_t count = links_.size();
    for (std::size_t i = cut_.size(); i > border_.size(); --i) {
        --count;
        const auto last = static_cast<std::int32_t>(count);
        if (cut_[i - 1] != last) move_vertex(last, cut_[i - 1]);
    }
    if (count < links_.size()) resize(count);
}

void VoronoiCell::relink(std::int32_t triangle, std::int32_t from, std::int32_t to, std::int32_t neighbour) {
    Link& link = links_[static_cast<std::size_t>(triangle)];
    for (std::size_t side = 0; side < 3; ++side) {
        if (link.plane[side] == from && link.plane[(side + 1) % 3] == to) link.across[side] = neighbour;
    }
}

void VoronoiCell::move_vertex(std::int32_t from, std::int32_t to) {
    const auto source = static_cast<std::size_t>(from);
    const auto target = static_cast<std::size_t>(to);
    x_[target] = x_[source];
    y_[target] = y_[source];
    z_[target] = z_[source];
    const Link link = links_[source];
    links_[target] = link;
    for (std::size_t side = 0; side < 3; ++side) {
        relink(link.across[side], link.plane[(side + 1) % 3], link.plane[side], to);
    }
}

void VoronoiCell::resize(std::size_t vertices) {
    links_.resize(vertices);
    x_.resize(vertices);
    y_.resize(vertices);
    z_.resize(vertices);
    excess_.resize(vertices);
}

void VoronoiCell::measure() {
    double most = 0;
    const std::size_t count = links_.size();
    const double* x = x_.data();
    const double* y = y_.data();
    const double* z = z_.data();
    for (std::size_t v = 0; v < count; ++v) {
        const double square = x[v] * x[v] + y[v] * y[v] + z[v] * z[v];
        most = most > square ? most : square;
    }
    reach_squared_ = most;
}

bool VoronoiCell::could_be_cut_from(const Box& box) const {
    const std::size_t count = links_.size();
    for (std::size_t v = 0; v < count; ++v) {
        const double dx = std::max(std::max(box.lo.x - x_[v], x_[v] - box.hi.x), 0.0);
        const double dy = std::max(std::max(box.lo.y - y_[v], y_[v] - box.hi.y), 0.0);
        const double dz = std::max(std::max(box.lo.z - z_[v], z_[v] - box.hi.z), 0.0);
        const double to_seed = x_[v] * x_[v] + y_[v] * y_[v] + z_[v] * z_[v];
        if (dx * dx + dy * dy + dz * dz < to_seed * rounding_margin) return true;
    }
    return false;
}

Box VoronoiCell::region_of_influence() const {
    Box region;
    for (std::size_t v = 0; v < links_.size(); ++v) {
        const dvec3 center = vertex(v);
        const double radius =
            std::sqrt(center.x * center.x + center.y * center.y + center.z * center.z) * rounding_margin;
        region.lo = glm::min(region.lo, center - radius);
        region.hi = glm::max(region.hi, center + radius);
    }
    return region;
}

VoronoiCell::Triple VoronoiCell::planes(std::size_t v) const { return {id(v, 0), id(v, 1), id(v, 2)}; }

}  // namespace lamella
