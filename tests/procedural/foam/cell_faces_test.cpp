// Faces as rings: the same from both sides, flat, halfway between their seeds, closing the cell.
#include "procedural/foam/cell_faces.h"

#include <catch2/catch.hpp>
#include <map>

namespace cell_faces_test {

using namespace lamella;

namespace {

std::shared_ptr<const SeedTree> seeds() {
    return std::make_shared<const SeedTree>(std::make_shared<const ConstantDensity>(1.0), 4.0, 12);
}

struct Listed {
    std::map<std::pair<SeedKey, SeedKey>, std::vector<dvec3>> rings;
    std::map<SeedKey, dvec3> places;
};

/// The faces of the cells about the origin, each listed by the cell asked.
Listed list(CellFaces::Which which) {
    const auto tree = seeds();
    TreeSearch search(*tree);
    CellFaces faces;
    VoronoiCell cell;
    Listed listed;
    for (const Seed& own : tree->seeds_in({dvec3(-2.5), dvec3(2.5)})) {
        search.cell(own, cell);
        CHECK(faces.list(cell, own, search.sites(), {}, which) == 0);
        for (const Seed& site : search.sites()) listed.places[site.key] = site.position;
        listed.places[own.key] = own.position;
        for (const CellFaces::Face& face : faces.faces()) {
            listed.rings[{own.key, face.other}] = {face.ring.begin(), face.ring.end()};
        }
    }
    return listed;
}

}  // namespace

TEST_CASE("a face has the same ring from both sides", "[cell_faces]") {
    const Listed all = list(CellFaces::Which::all);
    int shared = 0;
    for (const auto& [keys, ring] : all.rings) {
        const auto other = all.rings.find({keys.second, keys.first});
        if (other == all.rings.end()) continue;
        ++shared;
        CHECK(other->second == ring);
    }
    CHECK(shared > 500);
}

TEST_CASE("a cell owns its faces towards higher keys", "[cell_faces]") {
    const Listed all = list(CellFaces::Which::all), owned = list(CellFaces::Which::owned);
    std::size_t higher = 0;
    for (const auto& [keys, ring] : all.rings) {
        const bool owns = keys.first < keys.second;
        higher += owns;
        CHECK(owned.rings.contains(keys) == owns);
        if (owns) CHECK(owned.rings.at(keys) == ring);
    }
    CHECK(owned.rings.size() == higher);
}

TEST_CASE("faces lie halfway between their seeds, and turn as seen from outside the lower one",
          "[cell_faces]") {
    const Listed all = list(CellFaces::Which::all);
    for (const auto& [keys, ring] : all.rings) {
        const dvec3 lower = all.places.at(std::min(keys.first, keys.second));
        const dvec3 higher = all.places.at(std::max(keys.first, keys.second));
        REQUIRE(ring.size() >= 3);
        dvec3 area(0);
        for (std::size_t i = 0; i < ring.size(); ++i) {
            CHECK(std::abs(glm::distance(ring[i], lower) - glm::distance(ring[i], higher)) < 1e-9);
            area += glm::cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
        }
        CHECK(glm::dot(area, higher - lower) >= 0);
    }
}

}  // namespace cell_faces_test
