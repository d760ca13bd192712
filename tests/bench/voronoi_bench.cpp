// Exact Voronoi cells a second, beams of a plate opened cold, and warm distances.
#include <benchmark/benchmark.h>

#include "procedural/foam/voronoi_foam.h"
#include "procedural/voronoi/cell_search.h"
#include "procedural/voronoi/counter_hash.h"
#include "procedural/voronoi/graded_density.h"

namespace {

using namespace lamella;

SeedTree uniform_tree() { return {std::make_shared<const ConstantDensity>(1.0), 4.0, 1}; }

/// Uniform seeds in rings: units of 64 cells, gathering included.
void voronoi_cells(benchmark::State& state) {
    const SeedTree tree = uniform_tree();
    VoronoiCell cell;
    RingSearch rings(tree);
    std::int64_t cells = 0, place = 0;
    for (auto _ : state) {
        const Box box = tree.block_box({place % 8, (place / 8) % 8, (place / 64) % 8});
        ++place;
        if (!rings.gather(box)) state.SkipWithError("leaves of several levels");
        for (std::size_t i = 0; i < rings.sites().size(); ++i) {
            if (!box.contains(rings.sites()[i].position)) continue;
            if (!rings.cell(i, cell)) continue;
            ++cells;
            benchmark::DoNotOptimize(cell.vertex_count());
        }
    }
    state.SetItemsProcessed(cells);
}
BENCHMARK(voronoi_cells);

/// The same cells, best first over the tree.
void voronoi_cells_by_tree(benchmark::State& state) {
    const SeedTree tree = uniform_tree();
    VoronoiCell cell;
    TreeSearch search(tree);
    std::int64_t cells = 0, place = 0;
    for (auto _ : state) {
        const auto block = tree.block({place % 8, (place / 8) % 8, (place / 64) % 8});
        ++place;
        for (std::uint32_t i = 0; i < block->positions.size(); ++i) {
            search.cell(block->seed(i), cell);
            ++cells;
            benchmark::DoNotOptimize(cell.vertex_count());
        }
    }
    state.SetItemsProcessed(cells);
}
BENCHMARK(voronoi_cells_by_tree);

/// Cells of 8 mm where x < 0.3 coarse cells, of 1 mm beyond: the density jumps by 512.
class Jump : public Grading {
  public:
    double at(dvec3 p) const override { return p.x < plane ? 8 : 1; }
    Interval range(const Box& box) const override {
        return {box.hi.x >= plane ? 1.0 : 8.0, box.lo.x < plane ? 8.0 : 1.0};
    }

  private:
    static constexpr double plane = 5;
};

/// Cells on both sides of a plane where the density jumps by 512, each exact, best first over the tree.
void voronoi_cells_graded(benchmark::State& state) {
    const SeedTree tree(std::make_shared<const GradedDensity>(std::make_shared<const Jump>()), 16.0, 1);
    VoronoiCell cell;
    TreeSearch search(tree);
    const auto block = tree.block({0, 0, 0});
    std::int64_t cells = 0;
    for (auto _ : state) {
        for (std::uint32_t i = 0; i < block->positions.size(); ++i) {
            search.cell(block->seed(i), cell);
            ++cells;
            benchmark::DoNotOptimize(cell.vertex_count());
        }
    }
    state.SetItemsProcessed(cells);
}
BENCHMARK(voronoi_cells_graded)->Unit(benchmark::kMillisecond);

/// All beams that meet one plane of a 192 x 108 mm plate, nothing cached.
void cold_plate(benchmark::State& state) {
    std::int64_t beams = 0;
    double z = 50;
    for (auto _ : state) {
        const VoronoiFoam foam(
            {.cell = 4.4, .beam_radius = 0.3, .seed = 1, .region = {{0, 0, 0}, {192, 108, 200}}});
        beams += static_cast<std::int64_t>(foam.beams_at(z += 1.7).size());
    }
    state.SetItemsProcessed(beams);
}
BENCHMARK(cold_plate)->Unit(benchmark::kMillisecond);

/// The next layers of the same plate, 0.05 mm apart.
void warm_plate(benchmark::State& state) {
    const VoronoiFoam foam(
        {.cell = 4.4, .beam_radius = 0.3, .seed = 1, .region = {{0, 0, 0}, {192, 108, 200}}});
    double z = 50;
    benchmark::DoNotOptimize(foam.beams_at(z));
    for (auto _ : state) benchmark::DoNotOptimize(foam.beams_at(z += 0.05));
}
BENCHMARK(warm_plate)->Unit(benchmark::kMillisecond)->Iterations(60);

/// Distances at random points of a cube of 20 mm, bricks cached.
void warm_value(benchmark::State& state) {
    const VoronoiFoam foam({.cell = 2, .beam_radius = 0.3, .seed = 1, .region = {{0, 0, 0}, {20, 20, 20}}});
    const auto point = [](std::uint64_t i) {
        const CounterHash hash(7, 0, static_cast<std::int64_t>(i), 0, 0);
        return 20.0 * dvec3(hash.uniform(0), hash.uniform(1), hash.uniform(2));
    };
    for (std::uint64_t i = 0; i < 20000; ++i) benchmark::DoNotOptimize(foam.value(point(i)));
    std::uint64_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(foam.value(point(i++ % 20000)));
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(warm_value);

}  // namespace
