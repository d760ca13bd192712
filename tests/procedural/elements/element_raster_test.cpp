// Densities of elements: closed forms, and gradients against differences.
#include "procedural/elements/element_raster.h"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

namespace element_raster_test {

using namespace lamella;

namespace {

struct Placing {
    CellGrid grid;
    std::vector<ElementUse> use;
    std::vector<DistanceTable> tables;
    std::vector<PlacedElement> elements;

    ElementRaster raster() const {
        ElementRaster made(grid, use, tables, 1.5 * grid.edge(), 0.25);
        made.set(elements);
        return made;
    }
};

/// Sticks and rings that overlap each other, solid and empty cells, and the border of the grid.
Placing scattered(bool is_flat, std::size_t count) {
    Placing placing;
    placing.grid = {{24, 16, is_flat ? 1 : 12}, dvec3(-3, 1, 2), {0.9, 1, 1.1}, is_flat};
    placing.use.assign(placing.grid.cells(), ElementUse::free);
    for (std::size_t i = 0; i < placing.use.size(); i += 37) placing.use[i] = ElementUse::outside;
    for (std::size_t i = 5; i < placing.use.size(); i += 41) placing.use[i] = ElementUse::solid;
    const int samples = is_flat ? 128 : 64;
    placing.tables.emplace_back(*make_stick(8, 2.6), 3, samples, is_flat);
    placing.tables.emplace_back(*make_ring(7, 2), 3, samples, is_flat);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    const Box box = placing.grid.box();
    for (std::size_t k = 0; k < count; ++k) {
        PlacedElement element{.shape = static_cast<std::uint32_t>(k % 2),
                              .at = box.lo + box.size() * dvec3(share(random), share(random), share(random)),
                              .scale = 0.8 + 0.4 * share(random)};
        const dvec3 rotation(3 * share(random), 3 * share(random), 3 * share(random));
        placing.elements.push_back(turned(element, is_flat ? dvec3(0, 0, rotation.z) : rotation));
    }
    return placing;
}

}  // namespace

TEST_CASE("gradients of densities and overlap are those of differences", "[elements]") {
    for (const bool is_flat : {true, false}) {
        INFO((is_flat ? "plane" : "space"));
        const Placing placing = scattered(is_flat, 9);
        const ElementRaster raster = placing.raster();
        std::mt19937 random(8);
        std::uniform_real_distribution<double> weight(-1, 1);
        std::vector<double> by_density(placing.grid.cells());
        for (double& w : by_density) w = weight(random);
        constexpr double by_overlap = 0.3, step = 1e-6;
        const std::vector<ElementGradient> found = raster.gradients(by_density, by_overlap);
        const auto function = [&](std::size_t k, const auto& change) {
            Placing other = placing;
            change(other.elements[k]);
            const ElementRaster made = other.raster();
            return std::inner_product(by_density.begin(), by_density.end(), made.densities().begin(),
                                      by_overlap * made.overlap());
        };
        const auto slope = [&](std::size_t k, const auto& change) {
            return (function(k, [&](PlacedElement& e) { change(e, step); }) -
                    function(k, [&](PlacedElement& e) { change(e, -step); })) /
                   (2 * step);
        };
        double largest = 0;
        for (std::size_t k = 0; k < placing.elements.size(); ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                if (is_flat && axis == 2) continue;
                const double at = slope(k, [&](PlacedElement& e, double by) { e.at[axis] += by; });
                CHECK(found[k].at[axis] == Approx(at).epsilon(1e-5).margin(1e-5));
                largest = std::max(largest, std::abs(at));
            }
            for (int axis = is_flat ? 2 : 0; axis < 3; ++axis) {
                const double turn = slope(k, [&](PlacedElement& e, double by) {
                    dvec3 rotation(0);
                    rotation[axis] = by;
                    e = turned(e, rotation);
                });
                CHECK(found[k].turn[axis] == Approx(turn).epsilon(1e-5).margin(1e-5));
            }
            const double scale = slope(k, [&](PlacedElement& e, double by) { e.scale += by; });
            CHECK(found[k].scale == Approx(scale).epsilon(1e-5).margin(1e-5));
        }
        CHECK(largest > 0.5);
    }
}

TEST_CASE("an element alone has its content in densities, and an overlap counts once", "[elements]") {
    Placing placing;
    placing.grid = {{60, 40, 1}, dvec3(0), dvec3(1), true};
    placing.use.assign(placing.grid.cells(), ElementUse::free);
    placing.tables.emplace_back(*make_stick(24, 8), 4, 200, true);
    placing.elements = {{.shape = 0, .at = {30, 20, 0}}};
    ElementRaster alone(placing.grid, placing.use, placing.tables, 1.5, 0);
    alone.set(placing.elements);
    const double content = 16 * 8 + pi * 16;
    const auto sum = [](const ElementRaster& raster) {
        return std::accumulate(raster.densities().begin(), raster.densities().end(), 0.0);
    };
    CHECK(sum(alone) == Approx(content).epsilon(0.01));
    CHECK(alone.overlap() == Approx(0).margin(1e-9));
    placing.elements.push_back(placing.elements.front());
    alone.set(placing.elements);
    // The norm of two equal amounts is a twelfth more than one of them, where that is below 1: at the border.
    CHECK(alone.overlap() == Approx(content).epsilon(0.03));
    CHECK(alone.overlap() < content);
    // Half outside: what stands out is not in the densities, and beyond the grid nothing is counted.
    placing.elements = {{.shape = 0, .at = {60, 20, 0}}};
    alone.set(placing.elements);
    CHECK(sum(alone) == Approx(0.5 * content).epsilon(0.02));
}

}  // namespace element_raster_test
