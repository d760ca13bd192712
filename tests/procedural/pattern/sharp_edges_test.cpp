// Sharp edges: which sites lie round them, and that solid goes round.
#include "procedural/pattern/sharp_edges.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/texture/body_sites.h"

namespace sharp_edges_test {

using namespace lamella;

namespace {

constexpr double spacing = 0.2, width = 0.5;

SurfaceSites sites_of(const Field& body) {
    SurfaceSites sites = sites_on_surface(body, spacing, 1'000'000, nullptr);
    set_tangents(sites, nullptr, dvec3(0.3, 1, 0.2), 0);
    set_over_edges(sites, width);
    return sites;
}

/// Of a box about the origin, whose faces are 3 mm away: how far a point of a face is from the next edge.
double to_edge(dvec3 place) {
    const dvec3 far = glm::abs(place);
    const double largest = std::max({far.x, far.y, far.z}), least = std::min({far.x, far.y, far.z});
    return 3 - (far.x + far.y + far.z - largest - least);
}

}  // namespace

TEST_CASE("sites beside a sharp convex edge have one over it", "[texture]") {
    const FieldPtr box = make_box({dvec3(-3), dvec3(3)});
    const SurfaceSites sites = sites_of(*box);
    REQUIRE(sites.over_edge.size() == sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const std::uint32_t other = sites.over_edge[i];
        const double from = to_edge(sites.places[i]);
        if (from < width - spacing) REQUIRE(other != SurfaceSites::none);
        if (from > width) REQUIRE(other == SurfaceSites::none);
        if (other == SurfaceSites::none) continue;
        CHECK(glm::dot(sites.normals[i], sites.normals[other]) < 0.8);
        CHECK(length(sites.places[i] - sites.places[other]) <= width);
    }
}

TEST_CASE("round and concave edges are none", "[texture]") {
    CHECK(sites_of(*make_sphere(dvec3(0), 2)).over_edge.empty());
    const FieldPtr corner = make_difference(make_box({dvec3(-3), dvec3(3)}), make_box({dvec3(0), dvec3(4)}));
    const SurfaceSites sites = sites_of(*corner);
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const dvec3 place = sites.places[i];
        if (glm::all(glm::lessThan(glm::abs(place), dvec3(2.4))))
            CHECK(sites.over_edge[i] == SurfaceSites::none);
    }
}

TEST_CASE("solid goes round a sharp edge", "[texture]") {
    const FieldPtr box = make_box({dvec3(-3), dvec3(3)});
    const SurfaceSites sites = sites_of(*box);
    // A stripe on the upper face alone, at an angle to its edges.
    const auto stripe = [](dvec3 place) {
        return static_cast<float>(1 - std::abs(0.8 * place.x + 0.6 * (place.y - 3)));
    };
    std::vector<float> values;
    for (std::size_t i = 0; i < sites.size(); ++i)
        values.push_back(sites.normals[i].z > 0.5 ? stripe(sites.places[i]) : -1.0F);
    const std::vector<float> before = values;
    share_over_edges(sites, values);
    int solid = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const dvec3 place = sites.places[i];
        const bool is_beside = sites.normals[i].y > 0.5 && std::abs(place.x) < 2;
        if (!is_beside) {
            CHECK(values[i] >= before[i]);
            continue;
        }
        const float at_edge = stripe({place.x, 3, 3});
        if (place.z > 3 - width + spacing && std::abs(at_edge) > 0.15F)
            CHECK((values[i] > 0) == (at_edge > 0));
        if (place.z < 3 - width) CHECK(values[i] == before[i]);
        solid += values[i] > 0 ? 1 : 0;
    }
    CHECK(solid > 20);
}

}  // namespace sharp_edges_test
