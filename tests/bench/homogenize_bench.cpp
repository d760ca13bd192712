// The stiffness of a foam of 64 cells, at growing resolution.
#include <benchmark/benchmark.h>

#include "procedural/elasticity/field_sample.h"
#include "procedural/elasticity/homogenization.h"
#include "procedural/foam/voronoi_foam.h"

using namespace lamella;

namespace {

ElementMask foam_sample(int n) {
    FoamSettings settings;
    settings.cell = 1.0;
    settings.beam_radius = 0.12;
    settings.repeats_after = 1;
    settings.region = {dvec3(0), dvec3(4)};
    return sample_field(*make_voronoi_foam(settings), settings.region, n);
}

/// Six load cases; the number of iterations and of nodes along with the time.
void homogenize_foam(benchmark::State& state) {
    const ElementMask sample = foam_sample(static_cast<int>(state.range(0)));
    Homogenized found;
    for (auto _ : state) found = homogenize(sample, {});
    state.counters["iterations"] = found.iterations;
    state.counters["nodes"] = static_cast<double>(found.nodes);
    state.counters["young"] = closest_isotropic(found.stiffness).young;
}
BENCHMARK(homogenize_foam)
    ->Arg(32)
    ->Arg(64)
    ->Arg(96)
    ->Arg(128)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->UseRealTime();

}  // namespace
