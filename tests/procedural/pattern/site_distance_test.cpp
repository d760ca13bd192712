// Distances between sites against circles, and pieces against what was drawn.
#include "procedural/pattern/site_distance.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "procedural/pattern/least_widths.h"
#include "procedural/pattern/pattern_pieces.h"

namespace site_distance_test {

using namespace lamella;

namespace {

constexpr int size = 80;
constexpr double spacing = 0.25;

/// Samples a function of the place on a sheet of 20 x 20 mm.
template <typename Function>
std::vector<float> sampled(const SurfaceSites& sites, const Function& function) {
    std::vector<float> values;
    for (const dvec3 p : sites.places) values.push_back(static_cast<float>(function(p)));
    return values;
}

double from_middle(dvec3 p) { return std::hypot(p.x - 10, p.y - 10); }

}  // namespace

TEST_CASE("distances on a sheet are those from a circle", "[texture]") {
    const SurfaceSites sites = flat_sites(size, size, spacing);
    // The border does not depend on how steep the values are.
    const std::vector<float> values =
        sampled(sites, [](dvec3 p) { return 7 * (4 - from_middle(p)) / (1 + from_middle(p)); });
    const std::vector<float> distances = signed_distances(sites, values, 3);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const double exact = std::clamp(4 - from_middle(sites.places[i]), -3.0, 3.0);
        CHECK(static_cast<double>(distances[i]) == Approx(exact).margin(0.125 * spacing));
    }
    const std::vector<float> far = distances_from(sites, std::vector<SitePoint>{{0, sites.places[0]}}, 100);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const dvec3 way = sites.way(sites.places[0], sites.places[i]);
        CHECK(static_cast<double>(far[i]) == Approx(std::sqrt(glm::dot(way, way))).margin(1e-5));
    }
}

TEST_CASE("pieces of a pattern are joined by the fewest and shortest lines", "[texture]") {
    const SurfaceSites sites = flat_sites(size, size, spacing);
    // Discs at the corners of a square and one more; across the border two of them are near.
    const auto discs = [](dvec3 p) {
        double deepest = -100;
        for (const dvec2 at : {dvec2(2, 10), dvec2(8, 10), dvec2(18.5, 10), dvec2(8, 15)})
            deepest = std::max(deepest, 1.2 - std::hypot(p.x - at.x, p.y - at.y));
        return deepest;
    };
    const std::vector<float> values = sampled(sites, discs);
    const SitePieces pieces = pieces_of(sites, values);
    REQUIRE(pieces.sizes.size() == 4);
    const std::vector<float> none(sites.size(), 0);
    const auto sites_of = [](const std::vector<std::vector<std::uint32_t>>& lines) {
        std::vector<std::uint32_t> all;
        for (const auto& line : lines) all.insert(all.end(), line.begin(), line.end());
        return all;
    };
    const auto lines = lines_between(sites, pieces, none);
    CHECK(lines.size() == 3);
    for (const auto& line : lines) {
        for (std::size_t k = 1; k < line.size(); ++k)
            CHECK(std::ranges::count(sites.neighbours(line[k - 1]), line[k]) == 1);
        CHECK(pieces.piece[line.front()] != pieces.piece[line.back()]);
    }
    std::vector<float> joined = values;
    for (const std::uint32_t site : sites_of(lines)) joined[site] = 1;
    CHECK(pieces_of(sites, joined).sizes.size() == 1);
    // The way from 18.5 to 2 goes over the border: nothing lies between 9.5 and 17.
    for (const std::uint32_t site : sites_of(lines)) {
        const double x = sites.places[site].x;
        CHECK((x < 9.5 || x > 17));
    }
    // Where a way is reluctant, another is taken.
    std::vector<float> wall(sites.size(), 0);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (sites.places[i].x > 19.7 || sites.places[i].x < 0.3) wall[i] = 1e4F;
    }
    const auto around = lines_between(sites, pieces, wall);
    CHECK(around.size() == 3);
    CHECK(std::ranges::any_of(sites_of(around), [&](std::uint32_t site) {
        return sites.places[site].x > 10 && sites.places[site].x < 16;
    }));
}

TEST_CASE("a strut is widened about its middle, a corner is rounded", "[texture]") {
    const SurfaceSites sites = flat_sites(size, size, spacing);
    const SiteWindows windows = site_windows(sites, 3);
    // Two blocks, a bar of 0.5 mm between them, 10.1 mm high, and a spike of 0.5 mm on one of them.
    const auto blocks = [](dvec3 p) {
        const auto box = [&](double x0, double x1, double y0, double y1) {
            return std::min(std::min(p.x - x0, x1 - p.x), std::min(p.y - y0, y1 - p.y));
        };
        return std::max(
            {box(2, 6, 6, 14), box(13, 17, 6, 14), box(5, 14, 9.85, 10.35), box(3, 4.2, 13, 14.25)});
    };
    const std::vector<float> wide =
        with_least_width(sites, windows, signed_distances(sites, sampled(sites, blocks), 3), 1.5);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const dvec3 p = sites.places[i];
        const double value = static_cast<double>(wide[i]);
        CAPTURE(p.x, p.y, value);
        if (p.x > 7.5 &&
            p.x < 11.5) {  // the bar, now at least 1.5 mm wide and less than a site wider on each side
            const double away = std::abs(p.y - 10.1);
            if (away < 0.75) CHECK(value > 0);
            if (away > 0.75 + spacing) CHECK(value < 0);
        }
        if (p.x > 3 && p.x < 5 && p.y > 7 && p.y < 13) CHECK(value > 0);
        if (p.y > 14.3) CHECK(value < 0);
    }
}

}  // namespace site_distance_test
