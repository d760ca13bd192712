// Bridges by shape: drawn patterns, and sheets that lose struts one by one.
#include "procedural/pattern/pattern_bridges.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "procedural/pattern/flat_pattern.h"
#include "procedural/pattern/least_widths.h"
#include "procedural/pattern/pattern_pieces.h"
#include "procedural/pattern/solid_parting.h"
#include "procedural/skin/raster.h"
#include "tests/procedural/texture/sheets.h"

namespace pattern_bridges_test {

using namespace lamella;

namespace {

constexpr int size = 120;
constexpr double spacing = 0.2;  // a sheet of 24 x 24 mm

/// Draws a pattern, given its distance function, in a frame of void: nothing is near over the border.
template <typename Distance>
std::vector<float> drawn(const SurfaceSites& sites, const Distance& distance) {
    std::vector<float> values;
    for (const dvec3 p : sites.places) {
        const double frame = std::min(std::min(p.x, 24 - p.x), std::min(p.y, 24 - p.y)) - 1;
        values.push_back(static_cast<float>(std::min(frame, distance(p))));
    }
    return signed_distances(sites, values, 4);
}

double bar(dvec3 p, double x0, double x1, double y0, double y1) {
    return std::min(std::min(p.x - x0, x1 - p.x), std::min(p.y - y0, y1 - p.y));
}

std::vector<float> with_bridges(const SurfaceSites& sites, std::vector<float> distances,
                                const BridgePlan& plan, double strut) {
    for (const SiteLine& line : plan.bridges) {
        const std::vector<float> added = struts_along(sites, line, strut, 4);
        for (std::size_t i = 0; i < distances.size(); ++i) distances[i] = std::max(distances[i], added[i]);
    }
    return signed_distances(sites, distances, 4);
}

double length_of(const SiteLine& line) {
    const dvec3 way = line.back().place - line.front().place;
    return std::sqrt(glm::dot(way, way));
}

}  // namespace

TEST_CASE("a strut that alone holds a part gets a second one", "[texture]") {
    const SurfaceSites sites = flat_sites(size, size, spacing);
    // Two plates 4 mm apart, one strut between their left ends.
    const std::vector<float> plates = drawn(sites, [](dvec3 p) {
        return std::max({bar(p, 3, 21, 3, 10), bar(p, 3, 21, 14, 21), bar(p, 5, 6, 9, 15)});
    });
    const BridgePlan plan = plan_bridges(sites, plates, {});
    CHECK(plan.cut_struts > 0);
    REQUIRE(!plan.bridges.empty());
    // The first one goes where the way round is longest, straight over the gap.
    const SiteLine& first = plan.bridges.front();
    CHECK(first.front().place.x > 17);
    CHECK(length_of(first) == Approx(4).margin(2 * spacing));
    for (const SitePoint& point : first)
        CHECK(point.place.x == Approx(first.front().place.x).margin(1.5 * spacing));
    const BridgePlan again = plan_bridges(sites, with_bridges(sites, plates, plan, 0.8), {});
    CHECK(again.cut_struts == 0);
    CHECK(again.bridges.empty());
}

TEST_CASE("what a strut may lose is an ornament, and a wide hold is no strut", "[texture]") {
    const SurfaceSites sites = flat_sites(size, size, spacing);
    const auto plate = [](dvec3 p) { return bar(p, 3, 21, 3, 10); };
    // A spike of 0.8 mm with 1.6 % of the solid; then one with twice as much.
    for (const double top : {12.5, 16.5}) {
        const BridgePlan plan = plan_bridges(
            sites, drawn(sites, [&](dvec3 p) { return std::max(plate(p), bar(p, 12, 12.8, 9, top)); }), {});
        CHECK((plan.cut_struts > 0) == (top > 16));
    }
    const BridgePlan wide =
        plan_bridges(sites,
                     drawn(sites,
                           [&](dvec3 p) {
                               return std::max({plate(p), bar(p, 3, 21, 14, 21), bar(p, 9, 14, 9, 15)});
                           }),
                     {});
    CHECK(wide.cut_struts == 0);
}

TEST_CASE("ways through the solid are those round a gap, and long ones are shortened", "[texture]") {
    const SurfaceSites sites = flat_sites(size, size, spacing);
    // A ring with a slit to the right: the way round is that of the middle circle, or somewhat inside.
    const std::vector<float> ring = drawn(sites, [](dvec3 p) {
        const double radius = std::hypot(p.x - 12, p.y - 12);
        const double slit = std::max(0.5 - std::abs(p.y - 12), 0.0) * (p.x > 12 ? 1 : 0);
        return slit > 0 ? -slit : 1 - std::abs(radius - 7);
    });
    const auto nearest = [&](dvec3 at) {
        return nearest_sites(sites, std::vector<dvec3>{at}, std::vector<dvec3>{{0, 0, 1}}).front();
    };
    SolidWays ways(sites, ring);
    const std::uint32_t above = nearest({19, 12.7, 0}), below = nearest({19, 11.3, 0});
    const double round = 2 * std::numbers::pi * 6 + 2;
    CHECK(ways.length(above, below, 100) == Approx(round).epsilon(0.08));  // along neighbours: up to 8 % more
    CHECK(ways.length(above, below, 20) == 20);
    CHECK(ways.length(above, nearest({18.5, 13.5, 0}), 100) == Approx(0.94).margin(0.3));
    const BridgePlan plan = plan_bridges(sites, ring, {});
    CHECK(plan.detours > 0);
    REQUIRE(!plan.bridges.empty());
    const std::vector<float> closed = with_bridges(sites, ring, plan, 0.8);
    CHECK(plan_bridges(sites, closed, {}).bridges.empty());
    // Half as long a slit is no detour.
    CHECK(plan_bridges(sites,
                       drawn(sites,
                             [](dvec3 p) {
                                 const double slit = std::min(0.5 - std::abs(p.y - 12), p.x - 12);
                                 return std::min(9 - std::hypot(p.x - 12, p.y - 12), -slit);
                             }),
                       {.detour = 16})
              .bridges.empty());
}

TEST_CASE("no part of a sheet hangs on one strut", "[texture]") {
    // An independent look: discs that just cover a strut are taken out of a raster one by one, and what is
    // left is counted.
    const auto worst_loss = [](const FlatPattern& sheet) {
        constexpr double pixels = 5;
        TiledMask solid(static_cast<int>(sheet.size().x * pixels), static_cast<int>(sheet.size().y * pixels));
        TiledMask gap = solid;
        for (int y = 0; y < solid.height; ++y) {
            for (int x = 0; x < solid.width; ++x) {
                const dvec2 at = sheet.size() * dvec2(x + 0.5, y + 0.5) / dvec2(solid.width, solid.height);
                solid.marked[solid.index(x, y)] = sheet.distance(at) > 0 ? 1 : 0;
                gap.marked[solid.index(x, y)] = sheet.distance(at) > 0 ? 0 : 1;
            }
        }
        const std::vector<std::int64_t> depth = squared_distances(gap);
        const double thin = 0.6 * pixels;  // half the width of struts of 1.2 mm
        std::size_t worst = 0;
        for (int y = 0; y < solid.height; ++y) {
            for (int x = 0; x < solid.width; ++x) {
                const auto here = depth[solid.index(x, y)];
                const bool is_middle =
                    solid.marked[solid.index(x, y)] != 0 && here >= depth[solid.index(x + 1, y)] &&
                    here >= depth[solid.index(x - 1, y)] && here >= depth[solid.index(x, y + 1)] &&
                    here >= depth[solid.index(x, y - 1)];
                if (!is_middle || static_cast<double>(here) > thin * thin) continue;
                TiledMask left = solid;
                const int reach = static_cast<int>(std::sqrt(static_cast<double>(here)) + 2);
                for (int j = -reach; j <= reach; ++j) {
                    for (int i = -reach; i <= reach; ++i)
                        if (i * i + j * j <= reach * reach) left.marked[solid.index(x + i, y + j)] = 0;
                }
                std::vector<std::size_t> sizes;
                for (const TiledComponent& part : components_of(left)) sizes.push_back(part.pixels.size());
                std::ranges::sort(sizes, std::greater<>());
                if (sizes.size() > 1) worst = std::max(worst, sizes[1]);
            }
        }
        return static_cast<double>(worst) / static_cast<double>(solid.count());
    };
    const Volume dots = read_picture(LAMELLA_SOURCE_DIR "/examples/inputs/spots.png");
    ExampleSettings settings;
    settings.size = 30;
    settings.invert = true;
    settings.reinforce = Reinforcement::none;
    const FlatPattern joined(dots, {20, 20}, settings);
    CHECK(joined.pattern().joins > 10);
    CHECK(worst_loss(joined) > 0.1);
    settings.reinforce = Reinforcement::shape;
    const FlatPattern sound(dots, {20, 20}, settings);
    CHECK(sound.pattern().bridges > 0);
    CHECK(sound.pattern().cut_struts == 0);
    CHECK(worst_loss(sound) < 0.025);
    // Struts between dots are added, as few as do.
    CHECK(sound.pattern().printed.share < 1.1 * sound.pattern().wanted_share);
}

}  // namespace pattern_bridges_test
