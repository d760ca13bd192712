// Grids of angles for sticks and rings; ends of outlines triangulated with their holes cut open.
#include "procedural/elements/element_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "engine/mesh/triangulate.h"

namespace lamella {

namespace {

constexpr double half_round = std::numbers::pi;

/// Returns the number of chords of a half circle that deviate by at most `tolerance`.
int chords_of_half(double radius, double tolerance) {
    constexpr int fewest = 4, most = 500;
    const double cosine = std::max(1 - tolerance / radius, -1.0);
    const double chords = cosine < 1 ? half_round / (2 * std::acos(cosine)) : most;
    return static_cast<int>(
        std::clamp(std::ceil(chords), static_cast<double>(fewest), static_cast<double>(most)));
}

std::vector<dvec2> circle(double radius, double tolerance) {
    const int chords = 2 * chords_of_half(radius, tolerance);
    std::vector<dvec2> corners;
    for (int k = 0; k < chords; ++k) {
        const double angle = 2 * half_round * k / chords;
        corners.push_back(radius * dvec2(std::cos(angle), std::sin(angle)));
    }
    return corners;
}

double signed_area(const std::vector<dvec2>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return 0.5 * twice;
}

bool is_inside(const std::vector<dvec2>& polygon, dvec2 p) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if ((a.y <= p.y) != (b.y <= p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
}

/// A corner of the mesh: its number, where it is in the plane, and where it is for the triangulation: the
/// sides of a cut are apart.
struct Corner {
    std::uint32_t number;
    dvec2 at, shifted;
    bool is_cut = false;
};
using Loop = std::vector<Corner>;

/// Returns whether two segments cross or touch elsewhere than at common ends.
bool cross_each_other(dvec2 a, dvec2 b, dvec2 c, dvec2 d) {
    if (a == c || a == d || b == c || b == d) return false;
    // Also for sides in one line: their boxes tell.
    if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
        std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
        return false;
    const auto side = [](dvec2 from, dvec2 to, dvec2 p) { return cross(to - from, p - from); };
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

/// Throws InputError if sides of polygons that are not neighbours meet.
void check_sides(const std::vector<std::vector<dvec2>>& polygons) {
    struct Side {
        dvec2 from, to;
        std::size_t polygon, number;
    };
    std::vector<Side> sides;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        for (std::size_t k = 0; k < polygons[i].size(); ++k)
            sides.push_back({polygons[i][k], polygons[i][(k + 1) % polygons[i].size()], i, k});
    }
    const auto are_neighbours = [&](const Side& a, const Side& b) {
        const std::size_t count = polygons[a.polygon].size();
        return a.polygon == b.polygon &&
               ((a.number + 1) % count == b.number || (b.number + 1) % count == a.number);
    };
    for (std::size_t i = 0; i < sides.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const Side &a = sides[i], &b = sides[k];
            if (are_neighbours(a, b)) continue;
            const bool touch = a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
            if (touch || cross_each_other(a.from, a.to, b.from, b.to))
                throw InputError(fmt::format(
                    "sides of the outline meet at ({:.4g}, {:.4g}); accepted: polygons that do not", a.from.x,
                    a.from.y));
        }
    }
}

/// Cuts a loop open to a hole's corner over the shortest segment that crosses no side, and goes round it.
/// Each corner is cut once, so that cuts do not meet.
void cut_open(Loop& loop, const Loop& hole, const std::vector<Loop>& all) {
    double shortest = infinity;
    std::size_t from = 0, to = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        for (std::size_t k = 0; k < hole.size() && !loop[i].is_cut; ++k) {
            const double length = squared_length(loop[i].at - hole[k].at);
            if (length >= shortest) continue;
            const bool crosses = std::ranges::any_of(all, [&](const Loop& other) {
                for (std::size_t n = 0; n < other.size(); ++n) {
                    if (cross_each_other(loop[i].at, hole[k].at, other[n].at,
                                         other[(n + 1) % other.size()].at))
                        return true;
                }
                return false;
            });
            if (crosses) continue;
            shortest = length;
            from = i;
            to = k;
        }
    }
    const dvec2 way = hole[to].at - loop[from].at;
    constexpr double apart = 1e-7;  // mm
    const dvec2 left = apart / std::max(length(way), apart) * dvec2(-way.y, way.x);
    loop[from].is_cut = true;
    Loop round;
    for (std::size_t k = 0; k <= hole.size(); ++k) round.push_back(hole[(to + k) % hole.size()]);
    round.front().is_cut = round.back().is_cut = true;
    round.push_back(loop[from]);
    loop[from].shifted += left;
    round.front().shifted += left;
    round[hole.size()].shifted -= left;
    round.back().shifted -= left;
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(from) + 1, round.begin(), round.end());
}

/// Appends the triangles of a region with holes, counter-clockwise.
void triangulate(const std::vector<Loop>& outer_and_holes,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
    Loop loop = outer_and_holes.front();
    std::vector<Loop> all = outer_and_holes;
    for (std::size_t h = 1; h < outer_and_holes.size(); ++h) {
        cut_open(loop, outer_and_holes[h], all);
        all.push_back(loop);
    }
    std::vector<dvec3> points;
    points.reserve(loop.size());
    for (const Corner& corner : loop) points.emplace_back(corner.shifted, 0);
    std::vector<std::array<std::uint32_t, 3>> found;
    triangulate_loop(points, found);
    for (const auto& [a, b, c] : found) {
        const std::array<std::uint32_t, 3> corners{loop[a].number, loop[b].number, loop[c].number};
        // Both sides of a cut are one edge; between them a triangle is none.
        const bool is_edge = corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0];
        if (!is_edge) triangles.push_back(corners);
    }
}

}  // namespace

std::vector<dvec2> stick_outline(double length, double width, double tolerance) {
    const int chords = chords_of_half(0.5 * width, tolerance);
    std::vector<dvec2> corners;
    for (int end = 0; end < 2; ++end) {
        const dvec2 middle((end == 0 ? 0.5 : -0.5) * (length - width), 0);
        for (int k = 0; k <= chords; ++k) {
            const double angle = half_round * (end - 0.5 + static_cast<double>(k) / chords);
            corners.push_back(middle + 0.5 * width * dvec2(std::cos(angle), std::sin(angle)));
        }
    }
    return corners;
}

std::vector<std::vector<dvec2>> ring_outline(double diameter, double width, double tolerance) {
    return {circle(0.5 * diameter, tolerance), circle(0.5 * diameter - width, tolerance)};
}

TriangleMesh stick_surface(double length, double width, double tolerance) {
    const int rings = chords_of_half(0.5 * width, tolerance) / 2 + 1, around = 4 * rings;
    const double radius = 0.5 * width;
    TriangleMesh mesh;
    mesh.vertices.emplace_back(-0.5 * length, 0, 0);
    const auto last = static_cast<std::uint32_t>(1 + 2 * rings * around);
    const auto number = [&](int ring, int k) {
        if (ring < 0) return std::uint32_t{0};
        if (ring == 2 * rings) return last;
        return static_cast<std::uint32_t>(1 + ring * around + k % around);
    };
    // Rings of the left end from its tip, then of the right end to its tip.
    for (int ring = 0; ring < 2 * rings; ++ring) {
        const bool is_right = ring >= rings;
        const double angle = 0.5 * half_round * (is_right ? 2 * rings - ring : ring + 1) / rings;
        const double x = 0.5 * length - radius + radius * std::cos(angle);
        for (int k = 0; k < around; ++k) {
            const double turn = 2 * half_round * k / around;
            mesh.vertices.emplace_back(is_right ? x : -x, radius * std::sin(angle) * std::cos(turn),
                                       radius * std::sin(angle) * std::sin(turn));
        }
    }
    mesh.vertices.emplace_back(0.5 * length, 0, 0);
    for (int ring = -1; ring < 2 * rings; ++ring) {
        for (int k = 0; k < around; ++k) {
            const std::uint32_t a = number(ring, k), b = number(ring, k + 1), c = number(ring + 1, k),
                                d = number(ring + 1, k + 1);
            if (a != b) mesh.triangles.push_back({a, b, d});
            if (c != d) mesh.triangles.push_back({a, d, c});
        }
    }
    return mesh;
}

TriangleMesh ring_surface(double diameter, double width, double tolerance) {
    const int along = 2 * chords_of_half(0.5 * diameter, tolerance),
              around = 2 * chords_of_half(0.5 * width, tolerance);
    TriangleMesh mesh;
    for (int i = 0; i < along; ++i) {
        const double a = 2 * half_round * i / along;
        for (int k = 0; k < around; ++k) {
            const double b = 2 * half_round * k / around;
            const double far = 0.5 * (diameter - width) + 0.5 * width * std::cos(b);
            mesh.vertices.emplace_back(far * std::cos(a), far * std::sin(a), 0.5 * width * std::sin(b));
        }
    }
    const auto number = [&](int i, int k) {
        return static_cast<std::uint32_t>(i % along * around + k % around);
    };
    for (int i = 0; i < along; ++i) {
        for (int k = 0; k < around; ++k) {
            mesh.triangles.push_back({number(i, k), number(i + 1, k), number(i + 1, k + 1)});
            mesh.triangles.push_back({number(i, k), number(i + 1, k + 1), number(i, k + 1)});
        }
    }
    return mesh;
}

TriangleMesh outline_surface(const std::vector<std::vector<dvec2>>& polygons, double thickness) {
    check_sides(polygons);
    // A polygon inside an odd number of others is a hole of the smallest of them.
    std::vector<std::vector<std::size_t>> around(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        for (std::size_t k = 0; k < polygons.size(); ++k) {
            if (i != k && is_inside(polygons[k], polygons[i].front())) around[i].push_back(k);
        }
    }
    TriangleMesh mesh;
    std::vector<Loop> loops;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const bool is_hole = around[i].size() % 2 == 1;
        std::vector<dvec2> corners = polygons[i];
        if ((signed_area(corners) < 0) != is_hole) std::ranges::reverse(corners);
        Loop& loop = loops.emplace_back();
        for (const dvec2 at : corners) {
            loop.push_back({static_cast<std::uint32_t>(mesh.vertices.size()), at, at});
            mesh.vertices.emplace_back(at, -0.5 * thickness);
            mesh.vertices.emplace_back(at, 0.5 * thickness);
        }
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const std::uint32_t a = loop[k].number, b = loop[(k + 1) % loop.size()].number;
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        if (around[i].size() % 2 == 1) continue;
        std::vector<Loop> region{loops[i]};
        for (std::size_t k = 0; k < polygons.size(); ++k) {
            const bool is_hole_of_it = around[k].size() == around[i].size() + 1 &&
                                       std::ranges::find(around[k], i) != around[k].end();
            if (is_hole_of_it) region.push_back(loops[k]);
        }
        std::vector<std::array<std::uint32_t, 3>> ends;
        triangulate(region, ends);
        for (const auto& t : ends) {
            mesh.triangles.push_back({t[0] + 1, t[1] + 1, t[2] + 1});
            mesh.triangles.push_back({t[0], t[2], t[1]});
        }
    }
    return mesh;
}

}  // namespace lamella
