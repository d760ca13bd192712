// Synthesis on the surface, then distances carried into the space about it.
#include "procedural/pattern/surface_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "procedural/pattern/brick_crumbs.h"
#include "procedural/pattern/carried_distance.h"
#include "procedural/pattern/force_bridges.h"
#include "procedural/pattern/nearest_on_lattice.h"
#include "procedural/pattern/sharp_edges.h"
#include "procedural/pattern/struts_below.h"
#include "procedural/pattern/thin_walls.h"
#include "procedural/texture/body_sites.h"

namespace lamella {

namespace {

constexpr int sweeps_at_the_coarsest = 1000, sweeps_after = 5;
constexpr int largest_step = 16384;
constexpr int side = PatternBrick::side;

/// Returns the distance at a point of the lattice, whose nearest site is given. Outside the skin, between two
/// sides of a slit or of a wall, it is the smaller of theirs: the pattern of neither reaches over to the
/// other.
double distance_on_lattice(const SurfaceSites& sites, const CarriedDistance& carried,
                           const NearestOnLattice& nearest, double depth, glm::i64vec3 at,
                           std::uint32_t site) {
    const dvec3 p = dvec3(at) * sites.spacing, normal = sites.normals[site];
    double distance = carried.at(p, site);
    const double height = glm::dot(p - sites.places[site], normal);
    if (height <= 0 && height >= -depth) return distance;
    std::size_t hint = 0;
    for (int k = 0; k < 27; ++k) {
        const std::uint32_t other =
            nearest.site(at + glm::i64vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1), hint);
        if (other != NearestOnLattice::none && glm::dot(normal, sites.normals[other]) < 0)
            distance = std::min(distance, carried.at(p, other));
    }
    return distance;
}

/// Returns the bricks of distances from the surface down to a depth, mm.
std::vector<PatternBrick> bricks_about(const SurfaceSites& sites, std::span<const float> distances,
                                       double depth, double unit) {
    const CarriedDistance carried(sites, distances);
    const double margin = 2 * sites.spacing;
    const NearestOnLattice nearest(sites, depth + margin, margin);
    std::vector<PatternBrick> bricks;
    for (const glm::i64vec3 corner : nearest.bricks()) bricks.emplace_back().corner = corner;
    const double limit = largest_step * unit;
    parallel_for(bricks.size(), [&](std::size_t i) {
        for (int k = 0; k < PatternBrick::samples; ++k) {
            const glm::i64vec3 at = std::int64_t{PatternBrick::cells} * bricks[i].corner +
                                    glm::i64vec3(k % side, k / side % side, k / side / side);
            const std::uint32_t site = nearest.site(at);
            std::int16_t& step = bricks[i].steps[static_cast<std::size_t>(k)];
            step = PatternBrick::no_sample;
            if (site == NearestOnLattice::none) continue;
            const double distance = distance_on_lattice(sites, carried, nearest, depth, at, site);
            step = static_cast<std::int16_t>(std::lround(std::clamp(distance, -limit, limit) / unit));
        }
    });
    return bricks;
}

/// Returns the largest differences of neighbouring samples of a brick, along each axis.
glm::ivec3 steepest_steps(const PatternBrick& brick) {
    constexpr std::array<std::size_t, 3> strides{1, side, std::size_t{side} * side};
    glm::ivec3 most(0);
    for (int k = 0; k < PatternBrick::samples; ++k) {
        const glm::ivec3 at(k % side, k / side % side, k / side / side);
        const int here = brick.steps[static_cast<std::size_t>(k)];
        if (here == PatternBrick::no_sample) continue;
        for (int axis = 0; axis < 3; ++axis) {
            if (at[axis] == PatternBrick::cells) continue;
            const int next =
                brick.steps[static_cast<std::size_t>(k) + strides[static_cast<std::size_t>(axis)]];
            if (next != PatternBrick::no_sample) most[axis] = std::max(most[axis], std::abs(next - here));
        }
    }
    return most;
}

/// The interpolated distance is no steeper than the steepest differences along each axis together.
double slope_of(std::span<const PatternBrick> bricks, double unit, double spacing) {
    std::vector<glm::ivec3> steepest(bricks.size());
    parallel_for(bricks.size(), [&](std::size_t i) { steepest[i] = steepest_steps(bricks[i]); });
    glm::ivec3 most(0);
    for (const glm::ivec3& of_brick : steepest) most = glm::max(most, of_brick);
    const dvec3 slopes = dvec3(most) * (unit / spacing);
    return std::max(1.0, std::sqrt(glm::dot(slopes, slopes)));
}

/// Returns the edge of finite elements: half a strut, or as wide as keeps their number in bounds.
double element_edge(const Field& shell, double strut) {
    constexpr double most = 3e6;
    const dvec3 size = shell.bounds().size();
    return std::max(0.5 * strut, std::cbrt(size.x * size.y * size.z / most));
}

/// Returns a sound pattern, and of reinforcement by forces the softness before it and after.
SoundPattern reinforced(const Field& body, const Example& example, const std::vector<PatternLevel>& levels,
                        const SurfacePatternSettings& settings, std::pair<double, double>& softness) {
    const SurfaceSites& sites = levels.back().sites;
    const SynthesisSettings& synthesis = settings.example.synthesis;
    const BridgeSettings by_shape = bridge_settings(sites, settings.example);
    std::optional<SkinElements> elements;
    std::optional<BridgesByShape> shape;
    std::optional<BridgesByForces> forces;
    BridgeChoice* choice = nullptr;
    if (settings.example.reinforce == Reinforcement::forces) {
        if (!settings.shell)
            throw InputError("forces act on the skin of a body; accepted: settings with a shell");
        elements.emplace(*settings.shell, sites, settings.depth,
                         element_edge(*settings.shell, settings.example.strut), synthesis.cancel);
        choice = &forces.emplace(sites, *elements, settings.loads,
                                 ForceSettings{.by_shape = by_shape, .thickness = settings.depth});
    } else if (settings.example.reinforce == Reinforcement::shape) {
        choice = &shape.emplace(sites, by_shape);
    }
    std::optional<StrutsBelow> below;
    if (settings.self_supporting) below.emplace(sites, body, settings.depth, settings.example.strut, choice);
    SoundPattern made = synthesise_example(example, levels, settings.example, below ? &*below : choice);
    if (below) {
        const double strut = settings.example.strut;
        made.bridges += below->complete(strut, std::max(strut, settings.example.gap), made.printed.distance);
        made.printed.share = solid_share(made.printed.distance, sites.spacing);
    }
    if (choice != nullptr) {
        const bool is_known = shape && !settings.self_supporting;
        const BridgePlan left =
            is_known ? shape->last() : plan_bridges(sites, made.printed.distance, by_shape);
        made.cut_struts = left.cut_struts;
        made.detours = left.detours;
    }
    if (below) made.hanging = below->missing(made.printed.distance).size();
    if (forces) {
        if (settings.self_supporting) forces->choose(made.printed.distance);  // analyses it once more
        softness = {forces->softness().front(), settings.self_supporting
                                                    ? forces->softness().back()
                                                    : std::ranges::min(forces->softness())};
    }
    return made;
}

}  // namespace

std::vector<PatternLevel> levels_on(const Field& body, const Example& example,
                                    const SurfacePatternSettings& settings) {
    const SynthesisSettings& synthesis = settings.example.synthesis;
    std::vector<PatternLevel> levels;
    for (int halvings = example.levels - 1; halvings >= 0; --halvings) {
        PatternLevel level;
        level.sites =
            sites_on_surface(body, example.spacing * (1 << halvings), most_pattern_sites, synthesis.cancel);
        const bool is_coarsest = levels.empty();
        set_tangents(level.sites, is_coarsest ? nullptr : &levels.back().sites, settings.axis,
                     is_coarsest ? sweeps_at_the_coarsest : sweeps_after);
        level.windows = site_windows(level.sites, synthesis.window);
        levels.push_back(std::move(level));
    }
    set_across(levels.back().sites, body, 2 * std::min(settings.example.strut, settings.depth));
    set_over_edges(levels.back().sites, 0.5 * settings.example.strut);
    return levels;
}

SurfaceBricks synthesise_on_surface(const Volume& picture, const Field& body,
                                    const SurfacePatternSettings& settings) {
    const Example example = make_example(picture, settings.example);
    const std::vector<PatternLevel> levels = levels_on(body, example, settings);
    std::pair<double, double> softness{0, 0};
    const SoundPattern pattern = reinforced(body, example, levels, settings, softness);
    SurfaceBricks made{.spacing = example.spacing,
                       .unit = std::max(settings.example.strut, settings.example.gap) / largest_step,
                       .slope = 1,
                       .share = pattern.printed.share,
                       .wanted_share = pattern.wanted_share,
                       .pieces = pattern.pieces,
                       .joins = pattern.joins,
                       .bridges = pattern.bridges,
                       .cut_struts = pattern.cut_struts,
                       .detours = pattern.detours,
                       .hanging = pattern.hanging,
                       .dropped = pattern.printed.dropped,
                       .softness_before = softness.first,
                       .softness = softness.second};
    made.bricks = bricks_about(levels.back().sites, pattern.printed.distance, settings.depth, made.unit);
    const double strut = settings.example.strut / made.spacing, deep = settings.depth / made.spacing;
    made.dropped +=
        drop_crumbs(body, settings.depth, static_cast<std::size_t>(0.5 * strut * strut * deep), made);
    made.slope = slope_of(made.bricks, made.unit, made.spacing);
    return made;
}

SurfacePattern::SurfacePattern(SurfaceBricks bricks) : bricks_(std::move(bricks)) {
    for (std::uint32_t i = 0; i < bricks_.bricks.size(); ++i) places_.emplace(bricks_.bricks[i].corner, i);
}

const PatternBrick* SurfacePattern::brick_of(glm::i64vec3 cell, std::uint32_t& hint) const {
    const glm::i64vec3 corner(cell.x >> 3, cell.y >> 3, cell.z >> 3);
    if (hint >= bricks_.bricks.size() || bricks_.bricks[hint].corner != corner) {
        const auto found = places_.find(corner);
        if (found == places_.end()) return nullptr;
        hint = found->second;
    }
    return &bricks_.bricks[hint];
}

namespace {

constexpr double farthest_cell = 1e15;

/// The samples at the corners of a cell: x varies fastest.
std::array<double, 8> corners_of(const PatternBrick& brick, glm::i64vec3 cell) {
    const std::int16_t* const steps =
        &brick.steps[static_cast<std::size_t>((cell.x & 7) + side * ((cell.y & 7) + side * (cell.z & 7)))];
    std::array<double, 8> corners{};
    for (int k = 0; k < 8; ++k)
        corners[static_cast<std::size_t>(k)] = steps[(k & 1) + side * ((k >> 1 & 1) + side * (k >> 2))];
    return corners;
}

bool has_gap(const std::array<double, 8>& corners) {
    return std::ranges::find(corners, double{PatternBrick::no_sample}) != corners.end();
}

double interpolated(const std::array<double, 8>& corners, dvec3 share) {
    const auto along = [&](std::size_t c) { return corners[c] + (corners[c + 1] - corners[c]) * share.x; };
    const double low = along(0) + (along(2) - along(0)) * share.y;
    const double high = along(4) + (along(6) - along(4)) * share.y;
    return low + (high - low) * share.z;
}

/// Returns how many cells of a brick beyond this one along an axis have corners of the one sign that its own
/// have.
int cells_alike(const PatternBrick& brick, glm::i64vec3 cell, int axis, bool ascending) {
    constexpr std::array<int, 3> strides{1, side, side * side};
    const int stride = strides[static_cast<std::size_t>(axis)];
    const int a = strides[static_cast<std::size_t>((axis + 1) % 3)],
              b = strides[static_cast<std::size_t>((axis + 2) % 3)];
    const std::int16_t* corner =
        brick.steps.data() + (cell.x & 7) + side * (cell.y & 7) + std::ptrdiff_t{side} * side * (cell.z & 7);
    const int place = static_cast<int>(cell[axis] & 7);
    const int cells = ascending ? PatternBrick::cells - 1 - place : place;
    const std::ptrdiff_t onward = ascending ? stride : -stride;
    if (ascending) corner += stride;  // of the face beyond which the next cell lies
    const bool is_solid = *corner > 0;
    const auto differs = [&](std::int16_t step) {
        return (step > 0) != is_solid || step == PatternBrick::no_sample;
    };
    for (int alike = 0; alike < cells; ++alike) {
        corner += onward;
        if (differs(corner[0]) || differs(corner[a]) || differs(corner[b]) || differs(corner[a + b]))
            return alike;
    }
    return cells;
}

bool is_near(dvec3 at) { return std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < farthest_cell; }

// Away from the surface, the shell alone decides.
constexpr double solid = -std::numeric_limits<double>::min();

}  // namespace

double SurfacePattern::value_near(dvec3 p, std::uint32_t& hint) const {
    const dvec3 at = p / bricks_.spacing, floor = glm::floor(at);
    if (!is_near(at)) return solid;
    const glm::i64vec3 cell(floor);
    const PatternBrick* const brick = brick_of(cell, hint);
    if (brick == nullptr) return solid;
    const std::array<double, 8> corners = corners_of(*brick, cell);
    return has_gap(corners) ? solid : -interpolated(corners, at - floor) * bricks_.unit / bricks_.slope;
}

WindowPattern::Stretch SurfacePattern::stretch_near(dvec3 p, int axis, bool ascending,
                                                    std::uint32_t& hint) const {
    const dvec3 at = p / bricks_.spacing, floor = glm::floor(at), share = at - floor;
    if (!is_near(at)) return {solid, 0};
    const double left = (ascending ? 1 - share[axis] : share[axis]) * bricks_.spacing;  // of the cell
    const glm::i64vec3 cell(floor);
    const PatternBrick* const brick = brick_of(cell, hint);
    if (brick == nullptr) return {solid, left};
    const std::array<double, 8> corners = corners_of(*brick, cell);
    if (has_gap(corners)) return {solid, left};
    const double sum = interpolated(corners, share), value = -sum * bricks_.unit / bricks_.slope;
    const auto [least, most] = std::ranges::minmax(corners);
    if (least > 0 || most <= 0) {
        const double onward = bricks_.spacing * cells_alike(*brick, cell, axis, ascending);
        return {value, std::max(left + onward, std::abs(value))};
    }
    const std::size_t next = std::size_t{1} << static_cast<unsigned>(axis);
    double steepest = 0;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        if ((c & next) == 0) steepest = std::max(steepest, std::abs(corners[c + next] - corners[c]));
    }
    const double same =
        steepest * left > std::abs(sum) * bricks_.spacing ? std::abs(sum) * bricks_.spacing / steepest : left;
    return {value, std::max(same, std::abs(value))};
}

}  // namespace lamella
