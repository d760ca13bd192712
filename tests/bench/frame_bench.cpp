// Foams in a frame at 8K: runs of a layer, and what making the frame costs.
#include <benchmark/benchmark.h>

#include "engine/field/slice_context.h"
#include "engine/mesh/mesh_field.h"
#include "tests/bench/plate.h"
#include "tests/bench/wavy_ball.h"

namespace {

using namespace lamella;

/// The plate's foam in a wavy ball of 100,000 triangles; the argument says whether it has a frame.
FoamSettings foam_in_ball(const benchmark::State& state) {
    FoamSettings settings = bench::plate_foam();
    const FieldPtr body = make_mesh_field(bench::wavy_ball(100'000));
    settings.region = body->bounds();
    if (state.range(0)) settings.frame = FrameSettings{body, 0.5, true};
    return settings;
}

/// Runs of a layer, its pieces warm.
void frame_layer(benchmark::State& state) {
    const auto foam = make_voronoi_foam(foam_in_ball(state));
    SliceContext context;
    const SliceField& slice = context.slice(*foam, bench::plate_z);
    Scratch scratch;
    std::size_t runs = bench::plate_runs(slice, scratch, 1);
    for (auto _ : state) runs = bench::plate_runs(slice, scratch, 1);
    state.counters["runs"] = static_cast<double>(runs);
    state.counters["beams"] = static_cast<double>(foam->beams_at(bench::plate_z).size());
}
BENCHMARK(frame_layer)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

/// Layer after layer, 50 micrometres apart, with all that each needs anew.
void frame_layers_50um(benchmark::State& state) {
    const auto foam = make_voronoi_foam(foam_in_ball(state));
    double z = 30;
    Scratch scratch;
    for (auto _ : state) {
        SliceContext context;
        benchmark::DoNotOptimize(bench::plate_runs(context.slice(*foam, z += 0.05), scratch, 1));
    }
}
BENCHMARK(frame_layers_50um)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->Iterations(200);

}  // namespace
