// The overhang survey next to slicing the part once, as a G-code back-end does before its toolpaths.
#include <benchmark/benchmark.h>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/csg.h"
#include "engine/surveys/overhang_survey.h"
#include "tests/bench/wavy_ball.h"

namespace {

using namespace lamella;

/// 0: a wavy ball of 100 mm in 100,000 triangles; 1: the koala. Layers of 0.2 mm.
Job support_job(std::int64_t which) {
    const std::string path = std::string(LAMELLA_SOURCE_DIR) + "/examples/models/koala_mm.obj";
    Job job;
    job.part =
        make_mesh_field(which == 0 ? bench::wavy_ball(1e5) : close_mesh(read_mesh(path, {}).mesh, path));
    job.bounds = job.part->bounds();
    job.layers = equal_layers(job.bounds.size().z, 0.2);
    return job;
}

/// Contours of every layer to 0.025 mm, dropped.
class Outlines : public Backend {
  public:
    int open(const Job& /*job*/, LayerRange range, bool /*resume*/) override { return range.first; }
    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<LayerProduct>();
        constexpr double tolerance = 0.025;
        for (const Contour& contour : layer.contours(tolerance)) product->area += signed_area(contour.points);
        return product;
    }
    void write(const Layer& /*layer*/, LayerProduct& /*product*/) override {}
    void finish() override {}
};

/// The arguments are the part and the number of threads.
void support_slicing(benchmark::State& state) {
    const Job job = support_job(state.range(0));
    StreamOptions options;
    options.range = {0, job.layers.count()};
    options.threads = static_cast<int>(state.range(1));
    double volume = 0;
    for (auto _ : state) {
        Outlines outlines;
        volume = stream_layers(job, outlines, options).volume;
    }
    state.counters["layers"] = job.layers.count();
    state.counters["mm3"] = volume;
}
BENCHMARK(support_slicing)->ArgsProduct({{0, 1}, {1, 2}})->UseRealTime()->Unit(benchmark::kMillisecond);

/// The same job surveyed; the third argument says whether stability is looked at.
void overhang_survey(benchmark::State& state) {
    const Job job = support_job(state.range(0));
    OverhangSurveyOptions options;
    options.threads = static_cast<int>(state.range(1));
    if (state.range(2) == 0) options.stability.reset();
    OverhangSurvey survey;
    for (auto _ : state) survey = survey_overhangs(job, options);
    state.counters["layers"] = job.layers.count();
    state.counters["points"] = static_cast<double>(survey.points.size());
    state.counters["hanging_mm"] = survey.hanging_length;
    state.counters["own_bridges"] = static_cast<double>(survey.own_bridges);
    state.counters["topples_at"] = survey.topples_at.value_or(-1);
}
BENCHMARK(overhang_survey)
    ->ArgsProduct({{0, 1}, {1, 2}, {1}})
    ->Args({0, 1, 0})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
