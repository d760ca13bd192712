// Layers of placed elements: how the time depends on how many there are, and on their shape.
#include <benchmark/benchmark.h>

#include "procedural/elements/element_field.h"
#include "procedural/elements/element_start.h"
#include "procedural/voronoi/counter_hash.h"
#include "tests/bench/plate.h"

namespace {

using namespace lamella;
using namespace lamella::bench;

/// Elements anywhere on the plate, 20,000 for each mm of its height.
std::vector<PlacedElement> scattered(std::int64_t count) {
    std::vector<PlacedElement> elements;
    const double height = static_cast<double>(count) / 20'000;
    for (std::int64_t k = 0; k < count; ++k) {
        const CounterHash draw(1, 0, k, 0, 0);
        const auto part = [&](std::uint64_t i) { return draw.uniform(i); };
        const dvec3 way(2 * part(0) - 1, 2 * part(1) - 1, 2 * part(2) - 1);
        elements.push_back({.shape = 0,
                            .at = dvec3(192, 108, height) * dvec3(part(3), part(4), part(5)),
                            .turn = turn_to(way / length(way))});
    }
    return elements;
}

/// The runs of a layer half way up, cold: the first number is of elements, the second their shape.
void element_layer(benchmark::State& state) {
    const ElementShapePtr shape = state.range(1) == 0 ? make_stick(2.2, 0.3) : make_ring(2.2, 0.3);
    const FieldPtr field = make_element_field({shape}, scattered(state.range(0)));
    Scratch scratch;
    std::size_t runs = 0;
    for (auto _ : state) {
        SliceContext context;
        runs = plate_runs(context.slice(*field, field->bounds().center().z), scratch, 1);
    }
    state.counters["runs"] = static_cast<double>(runs);
}
BENCHMARK(element_layer)
    ->ArgsProduct({{100'000, 1'000'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
