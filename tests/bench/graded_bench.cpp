// Graded foam at 8K: cells from 2 to 8 mm over the plate, runs warm, and cells amortised over layers.
#include <benchmark/benchmark.h>

#include "engine/field/slice_context.h"
#include "tests/bench/plate.h"
#include "tests/engine/field/gradings.h"

namespace {

using namespace lamella;

FoamSettings graded_plate() {
    FoamSettings settings = bench::plate_foam();
    settings.cell = std::make_shared<const Ramp>(0, 2, 192, 8);
    settings.beam_radius = std::make_shared<const Ramp>(0, 0.2, 192, 0.5);
    return settings;
}

/// Runs of the whole plate, its cells warm; the argument is the number of sub-rows.
void foam_graded_spans_8k(benchmark::State& state) {
    const auto foam = make_voronoi_foam(graded_plate());
    SliceContext context;
    const SliceField& slice = context.slice(*foam, bench::plate_z);
    Scratch scratch;
    std::size_t runs = bench::plate_runs(slice, scratch, 1);
    for (auto _ : state) runs = bench::plate_runs(slice, scratch, static_cast<int>(state.range(0)));
    state.counters["runs"] = static_cast<double>(runs);
    state.counters["beams"] = static_cast<double>(foam->beams_at(bench::plate_z).size());
}
BENCHMARK(foam_graded_spans_8k)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

/// Everything but the runs of layer after layer, 50 micrometres apart: new cells, and the index of each
/// plane.
void foam_cells_per_layer_50um(benchmark::State& state) {
    const auto foam = make_voronoi_foam(graded_plate());
    double z = 10;
    benchmark::DoNotOptimize(foam->beams_at(z).size());
    for (auto _ : state) {
        SliceContext context;
        Scratch scratch;
        RunRows rows;
        RowBand nothing = bench::plate_band(0, 1);
        nothing.count = 1;
        context.slice(*foam, z += 0.05).runs(nothing, scratch, rows);
        benchmark::DoNotOptimize(rows.runs().data());
    }
}
BENCHMARK(foam_cells_per_layer_50um)->Unit(benchmark::kMillisecond)->Iterations(400);

/// Runs of the left part of a uniform plate, its cells warm: the argument is its share of the width in
/// quarters.
void foam_area(benchmark::State& state) {
    FoamSettings settings = bench::plate_foam();
    const int width = bench::plate_width / 4 * static_cast<int>(state.range(0));
    settings.region.hi.x = width * bench::plate_pixel;
    const auto foam = make_voronoi_foam(settings);
    SliceContext context;
    const SliceField& slice = context.slice(*foam, bench::plate_z);
    Scratch scratch;
    bench::plate_runs(slice, scratch, 1, width);
    for (auto _ : state) benchmark::DoNotOptimize(bench::plate_runs(slice, scratch, 1, width));
}
BENCHMARK(foam_area)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

/// From nothing to the runs of one layer, in parts that are 100 and 10,000 mm high.
void foam_height(benchmark::State& state) {
    FoamSettings settings = graded_plate();
    settings.region.hi.z = static_cast<double>(state.range(0));
    for (auto _ : state) {
        const auto foam = make_voronoi_foam(settings);
        SliceContext context;
        Scratch scratch;
        benchmark::DoNotOptimize(bench::plate_runs(context.slice(*foam, 50), scratch, 1));
    }
}
BENCHMARK(foam_height)->Arg(100)->Arg(10000)->Unit(benchmark::kMillisecond);

/// From nothing to the runs of the first layer of a part of 100 x 100 x 10,000 cells of 2 mm.
void first_layer_100x100x10000(benchmark::State& state) {
    FoamSettings settings;
    settings.cell = 2.0;
    settings.region = {{0, 0, 0}, {200, 200, 20000}};
    for (auto _ : state) {
        const auto foam = make_voronoi_foam(settings);
        SliceContext context;
        Scratch scratch;
        RunRows rows;
        RowBand band{.along_pitch = 0.05, .across_pitch = 0.05, .count = 4000, .hi = 4000};
        context.slice(*foam, 0.025).runs(band, scratch, rows);
        benchmark::DoNotOptimize(rows.runs().data());
    }
}
BENCHMARK(first_layer_100x100x10000)->Unit(benchmark::kMillisecond);

/// From nothing to the runs of the first band of a cube of 464^3 cells of 2 mm, uniform or graded.
void first_band_464(benchmark::State& state) {
    FoamSettings settings;
    settings.cell = 2.0;
    if (state.range(0)) settings.cell = std::make_shared<const Ramp>(0, 1.9, 928, 2.1);
    settings.region = {dvec3(0), dvec3(928)};
    for (auto _ : state) {
        const auto foam = make_voronoi_foam(settings);
        SliceContext context;
        Scratch scratch;
        RunRows rows;
        RowBand band{.along_pitch = 0.125, .across_pitch = 0.125, .count = 64, .hi = 7424};
        context.slice(*foam, 0.025).runs(band, scratch, rows);
        benchmark::DoNotOptimize(rows.runs().data());
    }
}
BENCHMARK(first_band_464)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
