// Foams with walls: planes of the plate opened cold and warm, their runs, and distances.
#include <benchmark/benchmark.h>

#include "engine/field/slice_context.h"
#include "procedural/foam/closed_foam.h"
#include "procedural/voronoi/counter_hash.h"
#include "tests/bench/plate.h"

namespace {

using namespace lamella;

/// The plate's foam with walls of 0.2 mm; the argument is the windows' share in percent.
ClosedFoamSettings walled_plate(const benchmark::State& state) {
    ClosedFoamSettings settings;
    settings.foam = bench::plate_foam();
    settings.wall = 0.2;
    settings.window = static_cast<double>(state.range(0)) / 100;
    return settings;
}

/// All pieces that meet one plane, nothing cached.
void walls_cold_plate(benchmark::State& state) {
    std::int64_t pieces = 0;
    double z = 50;
    for (auto _ : state) {
        const ClosedFoam foam(walled_plate(state));
        z += 1.7;
        pieces += static_cast<std::int64_t>(foam.pieces_touching({{0, 0, z}, {192, 108, z}}).size());
    }
    state.counters["pieces"] = static_cast<double>(pieces) / static_cast<double>(state.iterations());
}
BENCHMARK(walls_cold_plate)->Arg(0)->Arg(50)->Unit(benchmark::kMillisecond);

/// A layer in the middle of a print: its pieces found in the cache, its runs at 8K.
void walls_layer_8k(benchmark::State& state) {
    const ClosedFoam foam(walled_plate(state));
    Scratch scratch;
    std::size_t runs = 0;
    double z = bench::plate_z;
    benchmark::DoNotOptimize(foam.pieces_touching({{0, 0, z}, {192, 108, z}}));
    for (auto _ : state) {
        SliceContext context;
        const SliceField& slice = context.slice(foam, z += 0.05);
        runs = bench::plate_runs(slice, scratch, 1);
    }
    state.counters["runs"] = static_cast<double>(runs);
}
BENCHMARK(walls_layer_8k)->Arg(0)->Arg(50)->Unit(benchmark::kMillisecond)->Iterations(20);

/// Distances at random points of a cube of 20 mm; the argument says whether bricks are cached.
void walls_value(benchmark::State& state) {
    ClosedFoamSettings settings;
    settings.foam = {.cell = 2, .beam_radius = 0.1, .seed = 1, .region = {{0, 0, 0}, {20, 20, 20}}};
    const bool warm = state.range(0) != 0;
    if (!warm) settings.foam.cache_bytes = std::size_t{1} << 24;
    const ClosedFoam foam(settings);
    const auto point = [&](std::uint64_t i) {
        const CounterHash hash(7, 0, static_cast<std::int64_t>(i), 0, 0);
        return (warm ? 20.0 : 400.0) * dvec3(hash.uniform(0), hash.uniform(1), warm ? hash.uniform(2) : 0.01);
    };
    if (warm) {
        for (std::uint64_t i = 0; i < 20000; ++i) benchmark::DoNotOptimize(foam.value(point(i)));
    }
    std::uint64_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(foam.value(point(i++ % 20000)));
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(walls_value)->ArgNames({"warm"})->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
