// A layer of foam at 8K: runs, coverage, contours, and the first layer from nothing.
#include <benchmark/benchmark.h>

#include "engine/contours/contours.h"
#include "engine/contours/coverage.h"
#include "engine/field/slice_context.h"
#include "printers/masks/png_writer.h"
#include "tests/bench/plate.h"

namespace {

using namespace lamella;

/// Runs of the whole plate, band by band; the argument is the number of sub-rows.
void foam_spans_8k(benchmark::State& state) {
    const auto foam = make_voronoi_foam(bench::plate_foam());
    SliceContext context;
    const SliceField& slice = context.slice(*foam, bench::plate_z);
    Scratch scratch;
    std::size_t runs = 0;
    for (auto _ : state) runs = bench::plate_runs(slice, scratch, static_cast<int>(state.range(0)));
    state.counters["runs"] = static_cast<double>(runs);
    state.counters["beams"] = static_cast<double>(foam->beams_at(bench::plate_z).size());
}
BENCHMARK(foam_spans_8k)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

/// Coverage runs from the plate's runs.
void foam_coverage_8k(benchmark::State& state) {
    const auto foam = make_voronoi_foam(bench::plate_foam());
    SliceContext context;
    const SliceField& slice = context.slice(*foam, bench::plate_z);
    Scratch scratch;
    std::vector<RunRows> bands;
    const int sub = static_cast<int>(state.range(0));
    for (int first = 0; first < bench::plate_height; first += 128) {
        slice.runs(bench::plate_band(first, sub), scratch, bands.emplace_back());
    }
    std::vector<GreyRun> grey;
    std::size_t grey_runs = 0;
    for (auto _ : state) {
        grey_runs = 0;
        int first = 0;
        for (const RunRows& rows : bands) {
            grey.clear();
            coverage(bench::plate_band(first, sub), rows, grey);
            benchmark::DoNotOptimize(grey.data());
            grey_runs += grey.size();
            first += 128;
        }
    }
    state.counters["grey_runs"] = static_cast<double>(grey_runs);
}
BENCHMARK(foam_coverage_8k)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

/// A mask's file from its grey runs.
void foam_png_8k(benchmark::State& state) {
    const std::vector<GreyRun> grey = bench::plate_grey(static_cast<int>(state.range(0)));
    PngHeader header;
    header.width = bench::plate_width;
    header.height = bench::plate_height;
    std::size_t bytes = 0;
    for (auto _ : state) bytes = encode_png(header, grey).size();
    state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(foam_png_8k)->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

/// Contours of the plate; the argument is the tolerance in micrometres.
void contours_foam_8k(benchmark::State& state) {
    const auto foam = make_voronoi_foam(bench::plate_foam());
    SliceContext context;
    const SliceField& slice = context.slice(*foam, bench::plate_z);
    Scratch scratch;
    std::size_t vertices = 0, loops = 0;
    for (auto _ : state) {
        const auto contours = trace_contours(slice, static_cast<double>(state.range(0)) * 1e-3, scratch);
        loops = contours.size();
        vertices = 0;
        for (const Contour& contour : contours) vertices += contour.points.size();
    }
    state.counters["contours"] = static_cast<double>(loops);
    state.counters["vertices"] = static_cast<double>(vertices);
}
BENCHMARK(contours_foam_8k)->Arg(50)->Arg(25)->Unit(benchmark::kMillisecond);

/// From nothing to the runs of the first layer: seeds, cells, beams, index, runs.
void first_layer_8k(benchmark::State& state) {
    for (auto _ : state) {
        const auto foam = make_voronoi_foam(bench::plate_foam());
        SliceContext context;
        const SliceField& slice = context.slice(*foam, bench::plate_z);
        Scratch scratch;
        benchmark::DoNotOptimize(bench::plate_runs(slice, scratch, 1));
    }
}
BENCHMARK(first_layer_8k)->Unit(benchmark::kMillisecond);

}  // namespace
