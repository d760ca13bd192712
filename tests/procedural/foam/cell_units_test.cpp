// Units answer which beams touch a box: the brute-force set, whatever the order, the cache or the threads.
#include "procedural/foam/cell_units.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <thread>

#include "procedural/foam/beam_box.h"
#include "tests/procedural/voronoi/brute_voronoi.h"
#include "tests/procedural/voronoi/graded_densities.h"

namespace cell_units_test {

using namespace lamella;

namespace {

using BeamUnits = CellUnits<BeamMaker>;

std::shared_ptr<const SeedTree> uniform(std::uint64_t seed) {
    return std::make_shared<const SeedTree>(std::make_shared<const ConstantDensity>(1.0), 4.0, seed);
}

bool same_place(const Beam& beam, const VoronoiEdge& s) {
    const auto near = [](dvec3 p, dvec3 q) { return glm::distance(p, q) < 1e-9; };
    return (near(beam.a, s.first) && near(beam.b, s.second)) ||
           (near(beam.a, s.second) && near(beam.b, s.first));
}

Box random_box(std::uint64_t sample, double spread, double side) {
    const CounterHash hash(55, 1, static_cast<std::int64_t>(sample), 0, 0);
    const dvec3 lo = spread * (dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2)) - 0.5);
    return {lo, lo + side * dvec3(hash.uniform(3), hash.uniform(4), hash.uniform(5))};
}

}  // namespace

TEST_CASE("the beams that touch a box are those found by brute force", "[cell_units]") {
    constexpr double reach = 1.7321, radius = 0.13;
    for (std::uint64_t sample = 0; sample < 24; ++sample) {
        INFO("sample " << sample);
        const auto tree = uniform(100 + sample);
        const BeamUnits units(tree, BeamMaker(NodeRadius(radius)), 1 << 24);
        const Box box = random_box(sample, 50, 1.5);
        // Edges that touch the box have their seeds within the reach of it, their ends within twice, and what
        // ends them within thrice.
        const Box core = grown(box, reach + radius);
        const auto seeds = tree->seeds_in(grown(box, 3 * reach + radius));
        std::vector<VoronoiEdge> expected;
        for (const VoronoiEdge& s : brute_voronoi_edges(seeds, core)) {
            if (touches({s.first, radius, s.second, radius}, box)) expected.push_back(s);
        }
        const auto beams = units.touching(box);
        CHECK(beams.size() == expected.size());
        for (const VoronoiEdge& s : expected) {
            CHECK(std::count_if(beams.begin(), beams.end(),
                                [&](const Beam& b) { return same_place(b, s); }) == 1);
        }
    }
}

TEST_CASE("in a graded density the beams are those of all cells within reach", "[cell_units]") {
    std::vector<std::shared_ptr<const SeedTree>> trees = {
        std::make_shared<const SeedTree>(std::make_shared<const JumpDensity>(0.3), 1.0, 5),
        std::make_shared<const SeedTree>(std::make_shared<const BowlDensity>(), 1.0, 6),
        std::make_shared<const SeedTree>(std::make_shared<const ConstantDensity>(3.3), 1.0, 7)};
    constexpr double reach = 1.7321, radius = 0.02;
    for (const auto& tree : trees) {
        const BeamUnits units(tree, BeamMaker(NodeRadius(radius)), 1 << 24);
        const Box box{{0.1, 0.2, 0.1}, {0.5, 0.9, 0.95}};
        // The tree search itself is tested against lists of all seeds; here every cell that may reach is
        // asked.
        std::vector<Beam> all, expected;
        VoronoiCell cell;
        BeamMaker maker{NodeRadius(radius)};
        TreeSearch search(*tree);
        for (const Seed& own : tree->seeds_in(grown(box, reach + radius))) {
            search.cell(own, cell);
            maker.append(cell, own, search.sites(), all);
        }
        for (const Beam& beam : all) {
            if (touches(beam, box)) expected.push_back(beam);
        }
        auto beams = units.touching(box);
        const auto less = [](const Beam& a, const Beam& b) {
            return std::tie(a.a.x, a.a.y, a.a.z, a.b.x, a.b.y) < std::tie(b.a.x, b.a.y, b.a.z, b.b.x, b.b.y);
        };
        std::sort(beams.begin(), beams.end(), less);
        std::sort(expected.begin(), expected.end(), less);
        CHECK(expected.size() > 3);
        CHECK(beams == expected);
    }
}

TEST_CASE("beams do not depend on the order of questions nor on the cache's size", "[cell_units]") {
    const auto tree = uniform(9);
    const BeamUnits roomy(tree, BeamMaker(NodeRadius(0.1)), 1 << 26),
        cramped(tree, BeamMaker(NodeRadius(0.1)), 0);
    for (std::uint64_t i = 0; i < 12; ++i) {
        const auto forward = roomy.touching(random_box(i, 12, 6));
        CHECK(!forward.empty());
        CHECK(forward == cramped.touching(random_box(i, 12, 6)));
    }
    const BeamUnits backward(tree, BeamMaker(NodeRadius(0.1)), 1 << 26);
    for (std::uint64_t i = 12; i-- > 0;) {
        CHECK(backward.touching(random_box(i, 12, 6)) == roomy.touching(random_box(i, 12, 6)));
    }
}

TEST_CASE("two threads get the beams that one gets", "[cell_units]") {
    const auto tree = uniform(10);
    std::vector<std::vector<Beam>> alone, first(10), second(10);
    const BeamUnits reference(tree, BeamMaker(NodeRadius(0.1)), 1 << 26),
        shared(uniform(10), BeamMaker(NodeRadius(0.1)), 1 << 18);
    for (std::uint64_t i = 0; i < 10; ++i) alone.push_back(reference.touching(random_box(i, 8, 5)));
    std::thread a([&] {
        for (std::size_t i = 0; i < 10; ++i) first[i] = shared.touching(random_box(i, 8, 5));
    });
    std::thread b([&] {
        for (std::size_t i = 10; i-- > 0;) second[i] = shared.touching(random_box(i, 8, 5));
    });
    a.join();
    b.join();
    CHECK(first == alone);
    CHECK(second == alone);
}

}  // namespace cell_units_test
