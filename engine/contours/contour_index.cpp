// Cuts the border into pieces, counts them, and files each into the cells that its box meets.
#include "engine/contours/contour_index.h"

namespace lamella {
namespace {

constexpr double max_cells = 1 << 20;

}  // namespace

ContourIndex::ContourIndex(const std::vector<Contour>& contours, double cell) : cell_(cell) {
    Rect bounds;
    for (const Contour& contour : contours) {
        for (const dvec2 p : contour.points) bounds = unite(bounds, Rect{p, p});
    }
    if (bounds.empty()) return;
    const dvec2 size = bounds.size();
    cell_ = std::max(cell, std::sqrt(size.x * size.y / max_cells));
    cell_ = std::max(cell_, std::max(size.x, size.y) / max_cells);
    origin_ = bounds.lo;
    nx_ = static_cast<int>(size.x / cell_) + 1;
    ny_ = static_cast<int>(size.y / cell_) + 1;
    for (const Contour& contour : contours) add_pieces(contour);

    starts_.assign(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) + 1, 0);
    const auto each_cell = [&](const Piece& piece, const auto& act) {
        const Cells c = cells({glm::min(piece.from, piece.to), glm::max(piece.from, piece.to)});
        for (int y = c.y0; y <= c.y1; ++y) {
            for (int x = c.x0; x <= c.x1; ++x) act(number(x, y));
        }
    };
    for (const Piece& piece : pieces_) each_cell(piece, [&](std::size_t c) { ++starts_[c + 1]; });
    for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
    items_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
        each_cell(pieces_[i], [&](std::size_t c) { items_[next[c]++] = i; });
    }
}

void ContourIndex::add_pieces(const Contour& contour) {
    for (std::size_t k = 0; k < contour.points.size(); ++k) {
        const dvec2 a = contour.points[k], b = contour.points[(k + 1) % contour.points.size()];
        const double length = std::sqrt(dot(b - a, b - a));
        if (length == 0) continue;
        const int parts = static_cast<int>(std::ceil(length / cell_));
        dvec2 from = a;
        for (int part = 1; part <= parts; ++part) {
            const dvec2 to = part == parts ? b : a + (b - a) * (static_cast<double>(part) / parts);
            pieces_.push_back({from, to});
            from = to;
        }
    }
}

ContourIndex::Cells ContourIndex::cells(const Rect& r) const {
    const auto index = [this](double offset, int count) {
        return static_cast<int>(std::min(std::max(std::floor(offset / cell_), 0.0), count - 1.0));
    };
    return {index(r.lo.x - origin_.x, nx_), index(r.hi.x - origin_.x, nx_), index(r.lo.y - origin_.y, ny_),
            index(r.hi.y - origin_.y, ny_)};
}

template <typename Visit>
void ContourIndex::visit(const Rect& r, const Visit& visit) const {
    if (pieces_.empty()) return;
    const Cells c = cells(r);
    for (int y = c.y0; y <= c.y1; ++y) {
        for (int x = c.x0; x <= c.x1; ++x) {
            const std::size_t at = number(x, y);
            for (std::uint32_t k = starts_[at]; k < starts_[at + 1]; ++k) visit(pieces_[items_[k]]);
        }
    }
}

std::optional<double> ContourIndex::distance(dvec2 p, double limit) const {
    // At a corner both pieces are equally near; the one whose line is farther away determines the sign.
    constexpr double equal = 1e-9;
    double nearest = limit * limit, side = 0;
    bool found = false;
    visit(grown(Rect{p, p}, limit), [&](const Piece& piece) {
        const dvec2 along = piece.to - piece.from, to_p = p - piece.from;
        const double length2 = dot(along, along);
        const double t = std::min(std::max(dot(to_p, along) / length2, 0.0), 1.0);
        const dvec2 gap = to_p - along * t;
        const double distance2 = dot(gap, gap);
        if (distance2 > nearest * (1 + equal)) return;
        const double line = cross(along, to_p) / std::sqrt(length2);
        if (found && distance2 >= nearest * (1 - equal) && std::abs(line) <= std::abs(side)) return;
        nearest = std::min(nearest, distance2);
        side = line;
        found = true;
    });
    if (!found) return std::nullopt;
    return side > 0 ? -std::sqrt(nearest) : std::sqrt(nearest);
}

double ContourIndex::way_through(dvec2 p, dvec2 direction, double limit) const {
    const dvec2 end = p + direction * limit;
    double way = limit;
    visit({glm::min(p, end), glm::max(p, end)}, [&](const Piece& piece) {
        const dvec2 along = piece.to - piece.from, from = piece.from - p;
        const double turn = cross(direction, along);
        // The ray leaves the solid only where it crosses the border from left to right.
        if (!(turn > 0)) return;
        const double share = cross(from, direction) / turn, length = cross(from, along) / turn;
        if (share >= 0 && share <= 1 && length > 0) way = std::min(way, length);
    });
    return way;
}

}  // namespace lamella
