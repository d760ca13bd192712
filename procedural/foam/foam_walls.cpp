// Triangle fans and windows of faces, and the visible edges of the fans.
#include "procedural/foam/foam_walls.h"

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

/// mm; a narrower gap between triangles is closed by rounding anyway
constexpr double min_gap = 1e-7;

double distance_to_line(dvec3 p, dvec3 a, dvec3 b) {
    const dvec3 along = b - a;
    const double l = length(along);
    return l > 0 ? length(glm::cross(p - a, along)) / l : length(p - a);
}

}  // namespace

std::size_t WallMaker::append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                              std::vector<FoamPiece>& pieces) {
    made_.clear();
    std::size_t left_out = beams_.append(cell, own, sites, made_);
    pieces.insert(pieces.end(), made_.begin(), made_.end());
    left_out += faces_.list(cell, own, sites, stretch(), CellFaces::Which::owned);
    for (const CellFaces::Face& face : faces_.faces()) {
        radii_.resize(face.ring.size());
        walls_.radius.grading().numbers(face.ring, radii_);
        corners_.clear();
        for (std::size_t i = 0; i < radii_.size(); ++i) corners_.push_back({face.ring[i], radii_[i]});
        append_wall(pieces);
    }
    return left_out;
}

/// Appends the wall of the face in corners_.
void WallMaker::append_wall(std::vector<FoamPiece>& pieces) {
    const std::size_t n = corners_.size();
    const auto thickness = [](const Corner& corner) { return corner.radius > 0; };
    const Corner middle = this->middle();
    if (!thickness(middle) && std::none_of(corners_.begin(), corners_.end(), thickness)) return;
    const double open = window(middle);
    if (open >= 1) return;
    for (std::size_t i = 0; i < n; ++i) append_rim(corners_[i], corners_[(i + 1) % n], pieces);

    const bool even = walls_.radius.constant();
    if (even && open == 0) {
        for (std::size_t i = 1; i + 1 < n; ++i)
            append_triangle(corners_[0], corners_[i], corners_[i + 1], pieces);
        return;
    }
    const auto inner = [&](const Corner& corner) {
        return Corner{middle.place + (corner.place - middle.place) * open,
                      middle.radius + (corner.radius - middle.radius) * open};
    };
    for (std::size_t i = 0; i < n; ++i) {
        const Corner &from = corners_[i], &to = corners_[(i + 1) % n];
        if (!even && has_crest(middle, i)) append_beam(inner(from), from, pieces);
        if (open == 0) {
            append_triangle(middle, from, to, pieces);
            continue;
        }
        append_triangle(from, to, inner(to), pieces);
        append_triangle(from, inner(to), inner(from), pieces);
        append_beam(inner(from), inner(to), pieces);
    }
}

void WallMaker::append_triangle(const Corner& a, const Corner& b, const Corner& c,
                                std::vector<FoamPiece>& pieces) const {
    const double by = walls_.growth;
    pieces.push_back(
        RoundTriangle{{a.place, b.place, c.place}, {a.radius + by, b.radius + by, c.radius + by}});
}

void WallMaker::append_beam(const Corner& a, const Corner& b, std::vector<FoamPiece>& pieces) const {
    pieces.push_back(Beam{a.place, a.radius + walls_.growth, b.place, b.radius + walls_.growth});
}

/// Appends the wall's rounded rim along an edge of the face, unless the foam's beams cover it.
void WallMaker::append_rim(const Corner& a, const Corner& b, std::vector<FoamPiece>& pieces) {
    made_.clear();
    beams_.append_edge(a.place, b.place, made_);
    const double whole = length(b.place - a.place);
    const auto holds = [&](dvec3 place, double radius) {
        const double t = whole > 0 ? length(place - a.place) / whole : 0;
        return a.radius + (b.radius - a.radius) * t + walls_.growth <= radius;
    };
    const bool held = std::all_of(made_.begin(), made_.end(), [&](const Beam& beam) {
        return holds(beam.a, beam.ra) && holds(beam.b, beam.rb);
    });
    if (!held) append_beam(a, b, pieces);
}

/// Returns the area centroid of the face, with the wall's radius there.
WallMaker::Corner WallMaker::middle() const {
    const dvec3 origin = corners_[0].place;
    dvec3 sum(0), mean(0);
    double areas = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        mean += (corners_[i].place - origin) / static_cast<double>(corners_.size());
        if (i == 0 || i + 1 == corners_.size()) continue;
        const dvec3 u = corners_[i].place - origin, v = corners_[i + 1].place - origin;
        const double area = length(glm::cross(u, v));
        areas += area;
        sum += (u + v) * (area / 3);
    }
    const dvec3 place = origin + (areas > 0 ? sum / areas : mean);
    return {place, walls_.radius.at(place)};
}

/// Returns the open share of the face's width; 0 if its rim would close the window.
double WallMaker::window(const Corner& middle) const {
    const double open = walls_.window->at(middle.place);
    if (!(open > 0)) return 0;
    double narrowest = infinity;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const dvec3 a = corners_[i].place, b = corners_[(i + 1) % corners_.size()].place;
        if (a != b) narrowest = std::min(narrowest, distance_to_line(middle.place, a, b));
    }
    return open * narrowest > middle.radius ? open : 0;
}

/// Returns whether the beam along the spoke from the centre to a corner protrudes between the adjacent
/// triangles.
bool WallMaker::has_crest(const Corner& middle, std::size_t spoke) const {
    const std::size_t n = corners_.size();
    const Corner &at = corners_[spoke], &before = corners_[(spoke + n - 1) % n],
                 &after = corners_[(spoke + 1) % n];
    const auto first =
        wedge({{middle.place, before.place, at.place}, {middle.radius, before.radius, at.radius}});
    const auto second =
        wedge({{middle.place, at.place, after.place}, {middle.radius, at.radius, after.radius}});
    if (!first || !second) return true;
    // The normals of the tangent planes differ only across the spoke.
    const dvec3 between = first->normals[0] - second->normals[0];
    if (length(between) * std::max(middle.radius, at.radius) < min_gap) return false;
    return glm::dot(between, after.place - middle.place) < 0;
}

}  // namespace lamella
