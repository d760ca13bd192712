// What each check of a layer costs: 200 layers of 40 x 40 x 10 mm of foam, in rows 0.08 mm apart, one core.
#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <deque>
#include <limits>

#include "engine/checks/neck_check.h"
#include "engine/checks/overhang_check.h"
#include "engine/checks/peel_check.h"
#include "engine/checks/void_check.h"
#include "engine/layers/survey_rows.h"
#include "engine/morphology/sampled_ball.h"
#include "engine/morphology/thin_feature_search.h"
#include "engine/morphology/thin_features.h"
#include "engine/runs/row_sets.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/foam/voronoi_foam.h"

namespace {

using namespace lamella;

constexpr double edge = 40, height = 10, layer_height = 0.05, pitch = 0.08;  // mm
constexpr int layer_count = 200;
constexpr std::size_t max_places = 10;

CheckGrid grid() {
    CheckGrid grid;
    grid.band.along_origin = grid.band.across_origin = -edge / 2 - pitch;
    grid.band.along_pitch = grid.band.across_pitch = pitch;
    grid.band.count = grid.band.hi = static_cast<int>(edge / pitch) + 4;
    grid.layers = {layer_count, layer_height};
    return grid;
}

FieldPtr foam() {
    FoamSettings settings;
    settings.cell = 2;
    settings.beam_radius = 0.3;
    settings.seed = 1;
    settings.region = {dvec3(-edge / 2, -edge / 2, 0), dvec3(edge / 2, edge / 2, height)};
    return make_intersection({make_voronoi_foam(settings), make_box(settings.region)});
}

RunRows rows_of(const Field& field, int layer) {
    SliceContext context;
    Scratch scratch;
    return all_rows(context.slice(field, (layer + 0.5) * layer_height), grid().band, scratch);
}

const std::vector<RunRows>& layers() {
    static const std::vector<RunRows> all = [] {
        const FieldPtr field = foam();
        std::vector<RunRows> rows;
        for (int i = 0; i < layer_count; ++i) rows.push_back(rows_of(*field, i));
        return rows;
    }();
    return all;
}

CellLattice lattice(double reach) {
    return {Run{0, grid().band.hi * run_unit}, static_cast<std::size_t>(grid().band.count), reach, run_unit};
}

/// Limits of resin printers.
CheckContext context() {
    CheckContext context{grid(), {}, max_places};
    for (const Check check : {Check::islands, Check::overhangs})
        context.limits.verdicts[static_cast<std::size_t>(check)] = Severity::fail;
    context.limits.overhang = layer_height;
    context.limits.neck = 0.6;
    return context;
}

LayerSample sample(int layer) {
    LayerSample sample;
    sample.index = layer;
    sample.rows.part = layers()[static_cast<std::size_t>(layer)];
    sample.rows.supports = empty_rows(sample.rows.part.lines());
    return sample;
}

void check_rows(benchmark::State& state) {
    const FieldPtr field = foam();
    for (auto _ : state) {
        for (int i = 0; i < layer_count; ++i) benchmark::DoNotOptimize(rows_of(*field, i));
    }
}

void check_cells(benchmark::State& state) {
    layers();
    for (auto _ : state) {
        for (const RunRows& rows : layers())
            benchmark::DoNotOptimize(LayerCells(rows, lattice(4 * run_unit)));
    }
    std::size_t runs = 0;
    for (const RunRows& rows : layers()) runs += rows.runs().size();
    state.counters["runs"] = static_cast<double>(runs);
}

void check_thickness(benchmark::State& state, FeatureKind kind, double thickness) {
    const SampledBall ball = sampled_ball(grid().band, layer_height, thickness, 0);
    const Thinness measure{ball.radius, 1.5 * ball.radius + run_unit};
    std::vector<LayerCells> all_cells;
    for (const RunRows& rows : layers()) all_cells.emplace_back(rows, lattice(reach_of_cells(measure)));
    std::int64_t found = 0;
    for (auto _ : state) {
        found = 0;
        auto cells = all_cells.begin();
        RunRows thin;
        for (const RunRows& rows : layers()) {
            thin_rows(rows, *cells++, kind, measure, run_unit, thin);
            found += thin.total_length();
        }
    }
    state.counters["volume"] = grid().volume(found);
}

template <typename Thin>
void thickness_across_layers(benchmark::State& state, FeatureKind kind, double thickness) {
    layers();
    const oneapi::tbb::global_control one_core(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const SampledBall ball = sampled_ball(grid().band, layer_height, thickness, thickness);
    std::int64_t found = 0;
    for (auto _ : state) {
        found = 0;
        Thin thin(ball.lattice, {ball.radius, 1.5 * ball.radius + run_unit}, kind);
        RunRows rows;
        const auto take = [&] {
            while (thin.pop(rows)) found += rows.total_length();
        };
        for (const RunRows& layer : layers()) {
            thin.push(layer);
            take();
        }
        thin.finish();
        take();
    }
    state.counters["volume"] = grid().volume(found);
}

void check_thickness_up(benchmark::State& state, FeatureKind kind, double thickness) {
    thickness_across_layers<ThinFeatureSearch>(state, kind, thickness);
}
/// As necks have it, for comparison.
void check_thickness_up_by_all(benchmark::State& state, FeatureKind kind, double thickness) {
    thickness_across_layers<ThinFeatureStream>(state, kind, thickness);
}

void check_pieces(benchmark::State& state) {
    layers();
    for (auto _ : state) {
        StreamingComponents pieces;
        std::vector<EndedComponent> ended;
        for (int i = 0; i < layer_count; ++i)
            pieces.add(label_layer(layers()[static_cast<std::size_t>(i)], i, Growth{}), i, {}, ended);
        benchmark::DoNotOptimize(ended);
    }
}

void check_voids(benchmark::State& state) {
    layers();
    for (auto _ : state) {
        VoidCheck voids(context());
        for (int i = 0; i < layer_count; ++i) {
            LayerSample layer = sample(i);
            PreparedRows labelled = voids.prepare(layer);
            voids.add(layer, std::move(labelled));
        }
        voids.finish();
    }
}

void check_peel(benchmark::State& state) {
    std::vector<LabelledLayer> labels;
    for (const RunRows& rows : layers())
        labels.push_back(label_layer(rows, static_cast<int>(labels.size()), Growth{}));
    for (auto _ : state) {
        PeelCheck peel(context());
        for (std::size_t i = 0; i < labels.size(); ++i) {
            LayerSample layer;
            layer.index = static_cast<int>(i);
            layer.part = labels[i];
            peel.add(layer, {});
        }
        peel.finish();
        state.counters["places"] = static_cast<double>(peel.faults(Check::peel).count());
    }
}

void check_hold(benchmark::State& state) {
    std::vector<LabelledLayer> labels;
    for (const RunRows& rows : layers())
        labels.push_back(label_layer(rows, static_cast<int>(labels.size()), Growth{}));
    // Layers are cut, and their rows known, where they are checked.
    const FieldPtr field = foam();
    std::deque<SliceContext> contexts;
    std::vector<const SliceField*> slices;
    Scratch scratch;
    for (int i = 0; i < layer_count; ++i) {
        slices.push_back(&contexts.emplace_back().slice(*field, (i + 0.5) * layer_height));
        benchmark::DoNotOptimize(all_rows(*slices.back(), grid().band, scratch));
    }
    for (auto _ : state) {
        OverhangCheck check(context());
        for (std::size_t i = 0; i < labels.size(); ++i) {
            LayerSample layer = sample(static_cast<int>(i));
            layer.part = labels[i];
            layer.cells.emplace(layer.rows.part, lattice(0));
            layer.rows_in = [&](const RowBand& band) { return all_rows(*slices[i], band, scratch); };
            check.add(layer, {});
        }
        check.finish();
        state.counters["overhangs"] = static_cast<double>(check.faults(Check::overhangs).count());
    }
}

void check_necks(benchmark::State& state) {
    layers();
    const oneapi::tbb::global_control one_core(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    for (auto _ : state) {
        NeckCheck necks(context());
        for (int i = 0; i < layer_count; ++i) {
            LayerSample layer = sample(i);
            necks.add(layer, {});
        }
        necks.finish();
    }
}

BENCHMARK(check_rows)->Unit(benchmark::kMillisecond);
BENCHMARK(check_cells)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(check_thickness, solid, FeatureKind::wall, 0.4)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(check_thickness, gaps, FeatureKind::gap, 0.5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(check_thickness_up, solid, FeatureKind::wall, 0.6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(check_thickness_up, gaps, FeatureKind::gap, 0.5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(check_thickness_up_by_all, solid, FeatureKind::wall, 0.6)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(check_thickness_up_by_all, gaps, FeatureKind::gap, 0.5)->Unit(benchmark::kMillisecond);
BENCHMARK(check_pieces)->Unit(benchmark::kMillisecond);
BENCHMARK(check_voids)->Unit(benchmark::kMillisecond);
BENCHMARK(check_peel)->Unit(benchmark::kMillisecond);
BENCHMARK(check_hold)->Unit(benchmark::kMillisecond);
BENCHMARK(check_necks)->Unit(benchmark::kMillisecond);

}  // namespace
