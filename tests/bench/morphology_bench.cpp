// A foam, a capsule and a gyroid of 40 mm grown by balls, as dexels of one core; by blocks of lines and by
// brute force.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "engine/layers/layer.h"
#include "engine/morphology/layer_offset.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/foam/voronoi_foam.h"
#include "procedural/lattice/tpms.h"

namespace {

using namespace lamella;

constexpr double cube_edge = 40;  // mm

FieldPtr solid(std::int64_t kind) {
    if (kind == 1) return make_round_cone(Beam{{0, 0, -8}, 10, {0, 0, 8}, 10});
    if (kind == 2) {
        TpmsSettings settings;
        settings.period = make_constant_grading(8);
        settings.thickness = make_constant_grading(0.8);
        settings.region = {dvec3(-cube_edge / 2), dvec3(cube_edge / 2)};
        return make_intersection({make_sphere(dvec3(0), 18), make_tpms(settings)});
    }
    FoamSettings settings;
    settings.cell = 4;
    settings.beam_radius = 0.3;
    settings.seed = 1;
    settings.region = {dvec3(-cube_edge / 2), dvec3(cube_edge / 2)};
    return make_voronoi_foam(settings);
}

/// Layer z of n^3 dexels.
RunRows dexel_layer(const Field& field, int n, int z) {
    RowBand band;
    band.along_pitch = band.across_pitch = cube_edge / n;
    band.along_origin = band.across_origin = -cube_edge / 2;
    band.count = band.hi = n;
    SliceContext context;
    Scratch scratch;
    RunRows layer;
    context.slice(field, -cube_edge / 2 + (z + 0.5) * cube_edge / n).runs(band, scratch, layer);
    return layer;
}

std::vector<RunRows> dexels(std::int64_t kind, int n) {
    const FieldPtr field = solid(kind);
    std::vector<RunRows> layers;
    for (int z = 0; z < n; ++z) layers.push_back(dexel_layer(*field, n, z));
    return layers;
}

/// Arguments: 0 foam, 1 capsule or 2 ball of gyroid, n, radius in tenths of a dexel.
void grow_layers(benchmark::State& state) {
    const oneapi::tbb::global_control one_core(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const int n = static_cast<int>(state.range(1));
    const double radius = static_cast<double>(state.range(2)) / 10 * run_unit;
    const std::vector<RunRows> layers = dexels(state.range(0), n);
    std::int64_t volume = 0, runs = 0;
    for (auto _ : state) {
        DilationStream growing({run_unit, run_unit, static_cast<std::size_t>(n)}, radius);
        volume = 0;
        RunRows out;
        const auto take = [&] {
            while (growing.pop(out)) volume += out.total_length();
        };
        for (const RunRows& layer : layers) {
            growing.push(WeightedRows(layer, radius));
            take();
        }
        growing.finish();
        take();
    }
    for (const RunRows& layer : layers) runs += static_cast<std::int64_t>(layer.runs().size());
    state.counters["runs"] = static_cast<double>(runs);
    state.counters["volume"] = static_cast<double>(volume) / run_unit;
}
void sizes(benchmark::internal::Benchmark* bench) {
    for (const int kind : {0, 1}) {
        for (const int n : {256, 512}) {
            for (const int radius : {10, 25, 50, 100, 200, 400, 640}) bench->Args({kind, n, radius});
        }
    }
    for (const int radius : {30, 80, 160}) bench->Args({2, 256, radius});
    bench->Unit(benchmark::kMillisecond)->Iterations(1);
}
BENCHMARK(grow_layers)->Apply(sizes);

/// One layer of n^2 dexels grown by discs, within itself. Arguments as above.
void grow_one_layer(benchmark::State& state) {
    const oneapi::tbb::global_control one_core(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const int n = static_cast<int>(state.range(1));
    const double radius = static_cast<double>(state.range(2)) / 10 * run_unit;
    const WeightedRows rows(dexel_layer(*solid(state.range(0)), n, n / 2), radius);
    RunRows out;
    for (auto _ : state) grow_rows(rows, run_unit, out);
    state.counters["area"] = static_cast<double>(out.total_length()) / run_unit;
}
BENCHMARK(grow_one_layer)->ArgsProduct({{0, 1}, {2048}, {20, 100, 500, 2000}})->Unit(benchmark::kMillisecond);

/// The union over all rows within reach, for four layers alone, spread over all.
void grow_layers_brute(benchmark::State& state) {
    const int n = static_cast<int>(state.range(1));
    const double radius = static_cast<double>(state.range(2)) / 10 * run_unit;
    const std::vector<RunRows> layers = dexels(state.range(0), n);
    const int reach = static_cast<int>(radius / run_unit);
    for (auto _ : state) {
        std::vector<Run> runs;
        std::int64_t volume = 0;
        for (int z = n / 8; z < n; z += n / 4) {
            for (int y = 0; y < n; ++y) {
                runs.clear();
                for (int dz = -reach; dz <= reach; ++dz) {
                    for (int dy = -reach; dy <= reach; ++dy) {
                        const double left =
                            radius * radius - double(run_unit) * run_unit * (dy * dy + dz * dz);
                        if (left < 0 || z + dz < 0 || z + dz >= n || y + dy < 0 || y + dy >= n) continue;
                        const auto grow = static_cast<std::int32_t>(std::sqrt(left));
                        for (const Run& run :
                             layers[static_cast<std::size_t>(z + dz)].line(static_cast<std::size_t>(y + dy)))
                            runs.push_back({run.begin - grow, run.end + grow});
                    }
                }
                std::ranges::sort(runs, {}, &Run::begin);
                RunRows line;
                for (const Run& run : runs) line.push(run.begin, run.end);
                line.end_line();
                volume += line.total_length();
            }
        }
        benchmark::DoNotOptimize(volume);
    }
}
BENCHMARK(grow_layers_brute)
    ->ArgsProduct({{0, 1}, {256, 512}, {10, 25, 50, 100, 200, 400, 640}})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
