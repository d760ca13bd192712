// Struts below what would begin in the air: a drawn pattern, and one by example, on a box that stands.
#include "procedural/pattern/struts_below.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/solids/primitives.h"
#include "procedural/pattern/least_widths.h"
#include "procedural/pattern/surface_pattern.h"
#include "procedural/texture/body_sites.h"

namespace struts_below_test {

using namespace lamella;

namespace {

constexpr double strut = 0.8, depth = 1;

std::vector<SiteLine> struts_of(const FieldPtr& body, const SurfaceSites& sites,
                                std::span<const float> distances) {
    return struts_below(sites, HangingPieces(sites, *body, depth), distances, strut);
}

SurfaceSites sites_of(const FieldPtr& body) {
    SurfaceSites sites = sites_on_surface(*body, 0.25, 1'000'000, nullptr);
    set_tangents(sites, nullptr, dvec3(0, 0, 1), 0);
    return sites;
}

}  // namespace

TEST_CASE("a tongue that hangs down gets a strut below, and nothing else does", "[pattern]") {
    const FieldPtr body = make_box({dvec3(0), dvec3(10, 10, 14)});
    const SurfaceSites sites = sites_of(body);
    for (const bool is_joined : {true, false}) {
        std::vector<float> distances;
        for (const dvec3 p : sites.places) {
            // Below 4 mm and above 8 mm all is solid; a tongue hangs down to 6 mm, and perhaps a bar joins
            // both.
            const bool at_front = p.y<0.1, at_back = p.y> 9.9;
            const bool tongue = at_front && std::abs(p.x - 5) < 1 && p.z > 6;
            const bool bar = is_joined && at_back && std::abs(p.x - 5) < 1;
            distances.push_back(p.z < 4 || p.z > 8 || tongue || bar ? 1.0F : -1.0F);
        }
        const std::vector<SiteLine> struts = struts_of(body, sites, distances);
        REQUIRE(struts.size() == 1);
        const SiteLine& line = struts.front();
        CHECK(line.front().place.z == Approx(6).margin(0.25));
        CHECK(std::abs(line.front().place.x - 5) < 1.01);
        CHECK(line.back().place.z == Approx(4).margin(0.25));
        for (std::size_t i = 1; i < line.size(); ++i) {
            CHECK(line[i].place.z < line[i - 1].place.z);
            CHECK(glm::distance(line[i].place, line[i - 1].place) < 1.5 * sites.spacing);
        }
    }
}

TEST_CASE("a tongue beside a column hangs, however narrow the gap between them", "[pattern]") {
    // A window in a front that is solid else. Lines a spacing of 0.25 mm apart see solid on both sides of the
    // gap.
    constexpr double gap_begin = 4.05, gap_end = 4.2, tongue_end = 5;
    const FieldPtr body = make_box({dvec3(0), dvec3(10, 10, 14)});
    const SurfaceSites sites = sites_of(body);
    std::vector<float> distances;
    for (const dvec3 p : sites.places) {
        double distance = 1;
        if (p.y < 0.1) {
            distance = std::max({4 - p.z, p.z - 8, gap_begin - p.x, p.x - 9});
            distance = std::max(distance, std::min({p.x - gap_end, 6 - p.x, p.z - tongue_end}));
        }
        distances.push_back(static_cast<float>(std::clamp(distance, -1.0, 1.0)));
    }
    const std::vector<SiteLine> struts = struts_of(body, sites, distances);
    REQUIRE(struts.size() == 1);
    CHECK(struts.front().front().place.z == Approx(tongue_end).margin(0.25));
    // It ends at a site within the solid below.
    CHECK(struts.front().back().place.z < 4);
    CHECK(struts.front().back().place.z > 4 - 2 * sites.spacing);
    StrutsBelow below(sites, *body, depth, strut, nullptr);
    CHECK(below.complete(strut, 1, distances) == 1);
    CHECK(below.missing(distances).empty());
}

TEST_CASE("a foot that begins just over the bed gets a strut to the one on it", "[pattern]") {
    // A ball's lowest point is solid; a ring about it begins 0.04 mm higher.
    const FieldPtr body = make_sphere(dvec3(0), 12);
    const SurfaceSites sites = sites_of(body);
    std::vector<float> distances;
    for (const dvec3 p : sites.places) {
        const double radius = glm::length(dvec2(p));
        const bool is_low = p.z < 0;
        distances.push_back(
            static_cast<float>(is_low ? std::clamp(std::max(0.5 - radius, radius - 1), -1.0, 1.0) : 1.0));
    }
    const std::vector<SiteLine> struts = struts_of(body, sites, distances);
    REQUIRE(struts.size() == 1);
    CHECK(glm::length(dvec2(struts.front().back().place)) < 0.7);
}

TEST_CASE("what begins at the bottom of the body needs supports, not struts", "[pattern]") {
    // Two legs, each a piece of its own, and a wall between them that ends above.
    const FieldPtr body = make_box({dvec3(0), dvec3(10, 10, 8)});
    const SurfaceSites sites = sites_of(body);
    std::vector<float> distances;
    for (const dvec3 p : sites.places) distances.push_back(p.z > 5 || std::abs(p.x - 5) > 3 ? 1.0F : -1.0F);
    CHECK(struts_of(body, sites, distances).empty());
}

TEST_CASE("a disc in a level ceiling gets a strut to what walls hold, and then hangs no more", "[pattern]") {
    // No way over the surface leads down from the disc: it rises nowhere above the ceiling's lower face.
    const FieldPtr body = make_box({dvec3(0), dvec3(12, 12, 8)});
    const SurfaceSites sites = sites_of(body);
    std::vector<float> distances;
    for (const dvec3 p : sites.places) {
        const double radius = glm::length(dvec2(p) - dvec2(6));
        distances.push_back(
            p.z < 7.9 ? 1.0F : static_cast<float>(std::clamp(std::max(2 - radius, radius - 4), -1.0, 1.0)));
    }
    const std::vector<SiteLine> struts = struts_of(body, sites, distances);
    REQUIRE(struts.size() == 1);
    const auto from_middle = [&](const SitePoint& at) { return glm::length(dvec2(at.place) - dvec2(6)); };
    CHECK(from_middle(struts.front().front()) < 2.3);
    CHECK(from_middle(struts.front().back()) > 3.7);
    const std::vector<float> drawn = struts_along(sites, struts.front(), strut, 2);
    for (std::size_t i = 0; i < sites.size(); ++i) distances[i] = std::max(distances[i], drawn[i]);
    CHECK(HangingPieces(sites, *body, depth).find(CarriedDistance(sites, distances)).empty());
}

TEST_CASE("a pattern that supports itself begins nowhere in the air", "[pattern]") {
    const auto body = make_box({dvec3(0), dvec3(20, 16, 18)});
    ExampleSettings settings;
    settings.size = 24;
    const Example example =
        make_example(read_picture(LAMELLA_SOURCE_DIR "/examples/inputs/bricks.png"), settings);
    const std::vector<PatternLevel> levels =
        levels_on(*body, example, {.example = settings, .axis = dvec3(0, 0, 1)});
    const SurfaceSites& sites = levels.back().sites;
    const SoundPattern plain = synthesise_example(example, levels, settings, nullptr);
    StrutsBelow below(sites, *body, depth, strut, nullptr);
    const SoundPattern held = synthesise_example(example, levels, settings, &below);
    const auto hanging = [&](const SoundPattern& pattern) {
        return struts_of(body, sites, pattern.printed.distance).size();
    };
    CAPTURE(hanging(plain), hanging(held), held.bridges);
    CHECK(hanging(plain) > 5);
    CHECK(hanging(held) == 0);
    CHECK(held.bridges >= hanging(plain));
    CHECK(held.printed.share == Approx(plain.printed.share).margin(0.02));
}

}  // namespace struts_below_test
