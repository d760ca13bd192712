// Builds cells around seeds on a surface, and computes the distance to their rounded windows.
#include "procedural/skin/surface_windows.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.h"
#include "procedural/voronoi/voronoi_cell.h"

namespace lamella {
namespace {

constexpr double reach_in_pitches = 1.5;  // no point of a surface is farther from its nearest seed
constexpr double room_share = 0.05;       // of a window: half the width below which a cell stays closed

std::vector<dvec3> places(const std::vector<SurfaceFoot>& seeds) {
    std::vector<dvec3> places;
    places.reserve(seeds.size());
    for (const SurfaceFoot& seed : seeds) places.push_back(seed.place);
    return places;
}

void check(const SurfaceWindowSettings& settings, bool seeded) {
    const auto length = [](double v, const char* what, bool positive) {
        if (std::isfinite(v) && (positive ? v > 0 : v >= 0)) return;
        throw InputError(
            fmt::format("{} is {} mm; it must be {}, finite", what, v, positive ? "positive" : "at least 0"));
    };
    length(settings.window, "the windows' width", true);
    length(settings.corner, "the radius of the windows' corners", false);
    length(settings.depth, "the depth of the windows", true);
    if (!seeded) throw InputError("windows need a surface to lie on; none was found");
}

/// Returns the indices of the seeds whose bisectors bound a cell.
std::vector<std::int32_t> planes_of(const VoronoiCell& cell) {
    std::vector<std::int32_t> planes;
    for (std::size_t v = 0; v < cell.vertex_count(); ++v) {
        for (const std::int32_t plane : cell.planes(v)) {
            if (plane >= 0) planes.push_back(plane);
        }
    }
    std::sort(planes.begin(), planes.end());
    planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
    return planes;
}

/// Returns half the width of the struts at a seed.
double half_strut(const Grading& strut, dvec3 seed) {
    const double width = strut.at(seed);
    if (width > 0 && std::isfinite(width)) return 0.5 * width;
    throw InputError(
        fmt::format("the strut between windows is {} mm wide at ({:.4g}, {:.4g}, {:.4g}) mm; it must be "
                    "positive and finite everywhere",
                    width, seed.x, seed.y, seed.z));
}

double mean_pitch(const Field& body, const SurfaceWindowSettings& settings) {
    check(settings, true);
    if (const auto strut = settings.strut->constant()) return settings.window + *strut;
    const Interval struts = positive_range(*settings.strut, body.bounds(), "the strut between windows is");
    return settings.window + 0.5 * (struts.lo + struts.hi);
}

}  // namespace

SurfaceWindows::SurfaceWindows(const std::vector<SurfaceFoot>& seeds, const SurfaceWindowSettings& settings)
    : tree_(places(seeds)), corner_(settings.corner) {
    check(settings, !seeds.empty());
    double widest = 0;
    std::vector<double> halves;
    halves.reserve(seeds.size());
    for (const SurfaceFoot& seed : seeds) {
        halves.push_back(half_strut(*settings.strut, seed.place));
        widest = std::max(widest, 2 * halves.back());
        min_inset_ = std::min(min_inset_, halves.back());
    }
    reach_ = reach_in_pitches * (settings.window + widest) + settings.depth;
    cells_.reserve(seeds.size());
    for (std::uint32_t i = 0; i < seeds.size(); ++i) {
        cells_.push_back(make_cell(seeds, i, halves[i], room_share * settings.window));
        if (cells_.back().closed) ++closed_;
    }
    faces_.shrink_to_fit();
    // Beyond a wall at least half a strut is solid, unless the other side of a thin wall is near.
    for (Cell& cell : cells_) cell.beyond = min_inset_;
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < seeds.size(); ++i) {
        if (cells_[i].walls_end == cells_[i].end) continue;
        near.clear();
        tree_.within(seeds[i].place, neighbourhood(), near);
        for (const std::uint32_t other : near) cells_[other].beyond = 0;
    }
}

SurfaceWindows::Cell SurfaceWindows::make_cell(const std::vector<SurfaceFoot>& seeds, std::uint32_t own,
                                               double half, double min_room) {
    struct Neighbour {
        double squared;
        std::uint32_t seed;
        bool behind;
    };
    std::vector<std::uint32_t> near;
    tree_.within(seeds[own].place, neighbourhood(), near);
    std::vector<Neighbour> neighbours;
    for (const std::uint32_t i : near) {
        const dvec3 way = seeds[i].place - seeds[own].place;
        if (i != own)
            neighbours.push_back({glm::dot(way, way), i, back_to_back(seeds[own].normal, seeds[i].normal)});
    }
    std::sort(neighbours.begin(), neighbours.end(), [](const Neighbour& a, const Neighbour& b) {
        return a.squared != b.squared ? a.squared < b.squared : a.seed < b.seed;
    });
    VoronoiCell cell;
    cell.start(reach_);
    for (const Neighbour& other : neighbours) {
        if (other.squared > 4 * cell.reach_squared()) break;
        if (!other.behind)
            cell.clip(seeds[other.seed].place - seeds[own].place, static_cast<std::int32_t>(other.seed));
    }
    Cell made;
    made.first = static_cast<std::uint32_t>(faces_.size());
    made.inset = half;
    double room = infinity;
    const auto add_face = [&](std::uint32_t seed) {
        const dvec3 way = seeds[seed].place - seeds[own].place;
        const double length = std::sqrt(glm::dot(way, way));
        faces_.push_back({way / length, 0.5 * length});
    };
    for (const std::int32_t plane : planes_of(cell)) {
        add_face(static_cast<std::uint32_t>(plane));
        room = std::min(room, faces_.back().distance - half);
    }
    made.walls_end = static_cast<std::uint32_t>(faces_.size());
    for (const Neighbour& other : neighbours) {
        if (!other.behind || other.squared > 4 * cell.reach_squared()) continue;
        VoronoiCell copy = cell;
        if (copy.clip(seeds[other.seed].place - seeds[own].place, static_cast<std::int32_t>(other.seed)))
            add_face(other.seed);
    }
    made.end = static_cast<std::uint32_t>(faces_.size());
    made.closed = room < min_room;
    made.corner = std::max(std::min(corner_, room), 0.0);
    return made;
}

/// Returns how far a point (relative to the seed) lies outside the window shrunk by its corners' radius, mm:
/// the largest distance to any wedge of two of its faces. It is a convex function.
SurfaceWindows::Excess SurfaceWindows::excess(const Cell& cell, dvec3 q, int axis) const {
    // maximum number of faces with rounded edges; cells on a surface have about six
    constexpr std::size_t most = 32;
    struct Shrunk {
        dvec3 normal;
        double by;  ///< signed distance of the point beyond the face, mm
    };
    Shrunk shrunk[most];
    std::size_t count = 0;
    const double inset = cell.inset + cell.corner;
    const double cube = reach_ - std::max(std::max(std::abs(q.x), std::abs(q.y)), std::abs(q.z));
    Excess worst{inset - cube, 0};
    for (std::uint32_t f = cell.first; f < cell.walls_end; ++f) {
        const double by = inset - (faces_[f].distance - glm::dot(faces_[f].normal, q));
        if (by > worst.value) worst = {by, faces_[f].normal[axis]};
        if (count < most) shrunk[count++] = {faces_[f].normal, by};
    }
    if (worst.value <= 0) return worst;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = shrunk[i].by;
        if (a <= 0) continue;
        for (std::size_t j = 0; j < count; ++j) {
            const double b = shrunk[j].by;
            if (b > a || (b == a && j <= i)) continue;
            const double cosine = glm::dot(shrunk[i].normal, shrunk[j].normal);
            const double sine_squared = 1 - cosine * cosine;
            // Beyond the edge of the wedge the distance is to the edge; otherwise it is to the farther face
            // alone.
            if (!(b > a * cosine) || sine_squared < 1e-9) continue;
            const double squared = (a * a + b * b - 2 * a * b * cosine) / sine_squared;
            if (!(squared > worst.value * worst.value)) continue;
            const double distance = std::sqrt(squared), da = shrunk[i].normal[axis],
                         db = shrunk[j].normal[axis];
            worst = {distance, (a * da + b * db - cosine * (a * db + b * da)) / (sine_squared * distance)};
        }
    }
    return worst;
}

/// Returns the interval of the line through q (relative to the seed) along the axis that lies in the cell's
/// window, relative to the seed; empty if none does. A window is convex.
Interval SurfaceWindows::window_on(const Cell& cell, dvec3 q, int axis) const {
    Interval open{-infinity, infinity};
    for (int k = 0; k < 3; ++k) {
        const double free = reach_ - cell.inset;
        if (k == axis) open = {-free, free};
        if (k != axis && std::abs(q[k]) >= free) return {};
    }
    q[axis] = 0;
    for (std::uint32_t f = cell.first; f < cell.walls_end; ++f) {
        const double room = faces_[f].distance - cell.inset - glm::dot(faces_[f].normal, q);
        const double rate = faces_[f].normal[axis];
        if (rate > 0) open.hi = std::min(open.hi, room / rate);
        if (rate < 0) open.lo = std::max(open.lo, room / rate);
        if (rate == 0 && room <= 0) return {};
    }
    if (!(open.lo < open.hi) || cell.corner == 0) return open;
    q[axis] = open.lo;
    open.lo = rounded_end(cell, q, axis, 1);
    q[axis] = open.hi;
    open.hi = rounded_end(cell, q, axis, -1);
    return open;
}

/// Returns the coordinate at which a line enters a window with rounded edges: by Newton's method from q,
/// which lies outside or on the border, in the direction `inward` (1 or -1). Infinitely far inward if it
/// passes by.
double SurfaceWindows::rounded_end(const Cell& cell, dvec3 q, int axis, double inward) const {
    constexpr int most_steps = 64;
    constexpr double near_enough = 1e-8, rounding = 1e-12;  // mm
    for (int step = 0; step < most_steps; ++step) {
        const Excess beyond = excess(cell, q, axis);
        const double way = beyond.value - cell.corner;
        if (way <= rounding) break;
        if (!(beyond.slope * inward < 0)) return inward * infinity;
        // Excess is convex, so steps never pass the border.
        const double length = -way / (beyond.slope * inward);
        q[axis] += inward * length;
        if (length < near_enough) break;
    }
    return q[axis];
}

/// Returns the coordinate, relative to the seed, at which the line through q leaves the cell.
double SurfaceWindows::way_to_border(const Cell& cell, dvec3 q, int axis) const {
    double leaves = reach_;
    q[axis] = 0;
    for (std::uint32_t f = cell.first; f < cell.end; ++f) {
        const double rate = faces_[f].normal[axis];
        if (rate > 0) leaves = std::min(leaves, (faces_[f].distance - glm::dot(faces_[f].normal, q)) / rate);
    }
    return leaves;
}

bool SurfaceWindows::windows_on(dvec3 p, int axis, Interval part, std::uint32_t& hint,
                                std::vector<Interval>& out) const {
    constexpr double beyond = 1e-7;  // mm, from one cell into the next
    for (double at = part.lo; at < part.hi;) {
        p[axis] = at;
        hint = tree_.nearest(p, hint).point;
        const Cell& cell = cells_[hint];
        const dvec3 place = tree_.points()[hint], q = p - place;
        // Outside the cube that the cell was clipped from, faces are unknown, and all is solid.
        if (std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}) >= reach_) {
            at += std::max(std::abs(value_near(p, hint)), beyond);
            continue;
        }
        const double leaves = std::min(place[axis] + way_to_border(cell, q, axis), part.hi);
        if (!cell.closed) {
            Interval open = window_on(cell, q, axis);
            open = {std::max(open.lo + place[axis], at), std::min(open.hi + place[axis], leaves)};
            const bool goes_on = !out.empty() && open.lo <= out.back().hi + 2 * beyond;
            if (open.lo < open.hi && goes_on) out.back().hi = open.hi;
            if (open.lo < open.hi && !goes_on) out.push_back(open);
        }
        at = std::max(leaves, at) + beyond;
    }
    return true;
}

SurfaceWindows::Ways SurfaceWindows::ways_out(const Cell& cell, dvec3 q) const {
    Ways ways;
    const double cube = std::max(std::max(std::abs(q.x), std::abs(q.y)), std::abs(q.z));
    ways.inside = cube < reach_;
    for (std::uint32_t f = cell.first; f < cell.end; ++f) {
        const double d = faces_[f].distance - glm::dot(faces_[f].normal, q);
        constexpr double rounding = 1e-9;
        if (d <= rounding * reach_) ways.inside = false;
        double& least = f < cell.walls_end ? ways.wall : ways.border;
        least = std::min(least, std::max(d, 0.0));
    }
    return ways;
}

double SurfaceWindows::value_near(dvec3 p, std::uint32_t& hint) const {
    Ways ways = ways_out(cells_[hint], p - tree_.points()[hint]);
    if (!ways.inside) {
        hint = tree_.nearest(p, hint).point;
        ways = ways_out(cells_[hint], p - tree_.points()[hint]);
    }
    const Cell& cell = cells_[hint];
    const dvec3 q = p - tree_.points()[hint];
    const double to_wall = ways.wall, to_border = ways.border;
    const double solid = std::min(to_wall + cell.beyond, to_border);
    if (cell.closed) return -solid;
    const double outside = excess(cell, q, 0).value - cell.corner;
    return outside < 0 ? std::min(-outside, to_border) : -std::min(outside, solid);
}

std::shared_ptr<const SurfaceWindows> make_voronoi_windows(const Field& body,
                                                           const SurfaceWindowSettings& settings,
                                                           std::uint64_t seed) {
    return std::make_shared<SurfaceWindows>(scatter_on_surface(body, mean_pitch(body, settings), seed),
                                            settings);
}

std::shared_ptr<const SurfaceWindows> make_hexagon_windows(const Field& body,
                                                           const SurfaceWindowSettings& settings) {
    return std::make_shared<SurfaceWindows>(hexagons_on_surface(body, mean_pitch(body, settings)), settings);
}

}  // namespace lamella
