// Meshes at 8K: sections and skins of a wavy ball of many triangles.
#include <benchmark/benchmark.h>

#include "engine/field/slice_context.h"
#include "engine/mesh/mesh_field.h"
#include "engine/solids/csg.h"
#include "engine/solids/shell.h"
#include "procedural/pattern/surface_pattern.h"
#include "procedural/skin/image_windows.h"
#include "procedural/skin/surface_windows.h"
#include "tests/bench/plate.h"
#include "tests/bench/wavy_ball.h"

namespace {

using namespace lamella;
using bench::wavy_ball;

/// Slicing a field and making the plate's runs of it.
void slice_plate(benchmark::State& state, const Field& field) {
    Scratch scratch;
    std::size_t runs = 0;
    for (auto _ : state) {
        SliceContext context;
        const SliceField& slice = context.slice(field, 31.7);
        runs = bench::plate_runs(slice, scratch, 1);
    }
    state.counters["runs"] = static_cast<double>(runs);
}

/// The section of a mesh; the argument is its number of triangles.
void mesh_section(benchmark::State& state) {
    slice_plate(state, *make_mesh_field(wavy_ball(static_cast<double>(state.range(0)))));
}
BENCHMARK(mesh_section)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

/// A skin of 1 mm: the body's part within 1 mm of its surface.
void skin_layer(benchmark::State& state) {
    const FieldPtr body = make_mesh_field(wavy_ball(static_cast<double>(state.range(0))));
    slice_plate(state, *make_intersection({body, make_shell(body, 1)}));
}
BENCHMARK(skin_layer)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

/// A number that changes along x: 1 mm in the middle, by a tenth more or less at the ends.
class AlongX : public Grading {
  public:
    double at(dvec3 p) const override { return 1 + 0.002 * (p.x - 96); }
    Interval range(const Box& box) const override { return {at(box.lo), at(box.hi)}; }
};

/// A skin of a thickness that varies.
void graded_skin_layer(benchmark::State& state) {
    const FieldPtr body = make_mesh_field(wavy_ball(static_cast<double>(state.range(0))));
    slice_plate(state, *make_intersection({body, make_shell(body, std::make_shared<AlongX>(), {0.1, 3})}));
}
BENCHMARK(graded_skin_layer)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

/// The same skin with windows of 3 mm between struts of 1 mm: Voronoi (0), hexagons (1), a picture (2); a
/// pattern by example, for which the picture is three times as large (3).
std::shared_ptr<const WindowPattern> windows(const FieldPtr& body, std::int64_t kind) {
    const SurfaceWindowSettings settings{3, 1, 0.5, 1};
    if (kind == 0) return make_voronoi_windows(*body, settings, 1);
    if (kind == 1) return make_hexagon_windows(*body, settings);
    Volume picture;
    picture.size = {64, 64, 1};
    std::vector<std::uint8_t> samples(64 * 64, 255);
    for (std::size_t k = 0; k < 64 * 64; ++k) {
        if (k % 64 < 16 || k / 64 < 16) samples[k] = 0;
    }
    picture.samples = std::move(samples);
    picture.full_scale = 255;
    if (kind == 3) {
        SurfacePatternSettings example;
        example.example = {.size = 48, .strut = 3, .reinforce = Reinforcement::none};
        return std::make_shared<SurfacePattern>(synthesise_on_surface(picture, *body, example));
    }
    return std::make_shared<ImageWindows>(StrutImage(picture, {4, 1, 0.5, false}), *body, 1, 1);
}

void patterned_skin_layer(benchmark::State& state) {
    const FieldPtr body = make_mesh_field(wavy_ball(static_cast<double>(state.range(0))));
    const FieldPtr shell = make_patterned_shell(make_shell(body, 1), windows(body, state.range(1)));
    slice_plate(state, *make_intersection({body, shell}));
}
BENCHMARK(patterned_skin_layer)
    ->ArgsProduct({{100'000, 1'000'000}, {0, 1, 2}})
    ->Args({100'000, 3})
    ->Unit(benchmark::kMillisecond);

/// From a mesh field to its windows: seeds and their cells, or charts.
void patterned_skin_setup(benchmark::State& state) {
    const FieldPtr body = make_mesh_field(wavy_ball(static_cast<double>(state.range(0))));
    for (auto _ : state) benchmark::DoNotOptimize(windows(body, state.range(1)).get());
}
BENCHMARK(patterned_skin_setup)->ArgsProduct({{100'000}, {0, 1, 2}})->Unit(benchmark::kMillisecond);

/// From a mesh field to its graded skin: numbers at vertices, tree, edges that show.
void graded_skin_setup(benchmark::State& state) {
    const FieldPtr body = make_mesh_field(wavy_ball(static_cast<double>(state.range(0))));
    for (auto _ : state)
        benchmark::DoNotOptimize(make_shell(body, std::make_shared<AlongX>(), {0.1, 3}).get());
}
BENCHMARK(graded_skin_setup)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

/// From a mesh in memory to its first section: normals, tree, indices.
void mesh_field_setup(benchmark::State& state) {
    const SolidMesh solid = wavy_ball(static_cast<double>(state.range(0)));
    for (auto _ : state) {
        SliceContext context;
        benchmark::DoNotOptimize(&context.slice(*make_mesh_field(solid), 31.7));
    }
}
BENCHMARK(mesh_field_setup)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
