// Topology optimisation: a whole one in the plane, and iterations in space.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/procedural/optimization/topology_problems.h"

using namespace lamella;

namespace {

/// The half beam of 300 x 100 elements to its end: 93 loops of optimality criteria.
void topopt_mbb_300x100(benchmark::State& state) {
    const TopologyProblem<2> problem = half_mbb_beam(300, 100, 0.5);
    TopologySettings settings;
    settings.density.radius = 12;
    settings.sensitivity_filter = true;
    settings.iterations = 1000;
    TopologyIteration last;
    for (auto _ : state) {
        TopologyOptimizer<2> optimizer(problem, settings);
        while (!optimizer.is_finished()) last = optimizer.iterate();
    }
    state.counters["loops"] = last.index;
    state.counters["compliance"] = last.compliance;
}
BENCHMARK(topopt_mbb_300x100)->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();

/// A solid cantilever of 2 n x n x n elements at 12 %, after `range(1)` iterations that are not measured.
void topopt_3d(benchmark::State& state) {
    const int n = static_cast<int>(state.range(0)) / 2;
    const TopologyProblem<3> problem = solid_cantilever(2 * n, n, n, 0.12, 1e-6);
    TopologySettings settings;
    settings.density.radius = std::sqrt(3.0);
    settings.iterations = 1000;
    TopologyOptimizer<3> optimizer(problem, settings);
    for (std::int64_t i = 0; i < state.range(1); ++i) optimizer.iterate();
    int most = 0;
    TopologyIteration last;
    for (auto _ : state) {
        last = optimizer.iterate();
        most = std::max(most, last.solver_iterations);
    }
    state.counters["solver_iterations"] = most;
    state.counters["compliance"] = last.compliance;
}
BENCHMARK(topopt_3d)
    ->Name("topopt_3d_64")
    ->Args({64, 0})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(50)
    ->UseRealTime();
BENCHMARK(topopt_3d)
    ->Name("topopt_3d_256")
    ->Args({256, 1})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->UseRealTime();

}  // namespace
