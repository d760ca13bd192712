// The island survey of the koala's foam without a skin: a pass over all layers, and a layer without the
// islands.
#include <benchmark/benchmark.h>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/surveys/island_survey.h"
#include "procedural/foam/voronoi_foam.h"

namespace {

using namespace lamella;

/// The koala, 4 mm cells, beams of 0.4 mm, 0.05 mm layers.
Job koala_job(FieldPtr& body) {
    const std::string path = std::string(LAMELLA_SOURCE_DIR) + "/examples/models/koala_mm.obj";
    body = make_mesh_field(close_mesh(read_mesh(path, {}).mesh, path));
    FoamSettings settings;
    settings.cell = 4;
    settings.beam_radius = 0.4;
    settings.seed = 7;
    settings.region = body->bounds();
    Job job;
    job.part = make_intersection({body, make_voronoi_foam(settings)});
    job.bounds = body->bounds();
    job.layers = equal_layers(job.bounds.size().z, 0.05);
    return job;
}

/// All layers; the arguments are the pitch in micrometres and the number of threads.
void island_survey(benchmark::State& state) {
    FieldPtr body;
    const Job job = koala_job(body);
    IslandSurveyOptions options;
    options.pitch = static_cast<double>(state.range(0)) * 1e-3;
    options.threads = static_cast<int>(state.range(1));
    IslandSurvey survey;
    for (auto _ : state) survey = survey_islands(job, body, options);
    state.counters["layers"] = job.layers.count();
    state.counters["islands"] = static_cast<double>(survey.report.count);
    state.counters["island_mm3"] = survey.report.volume;
    state.counters["part_mm3"] = survey.report.part_volume;
    state.counters["dropped_runs"] = static_cast<double>(survey.dropped->runs().size());
}
BENCHMARK(island_survey)
    ->Args({200, 1})
    ->Args({200, 2})
    ->Args({100, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// The runs of every 20th layer at 50 micrometres, with the islands (0) and without (1).
void layers_without_islands(benchmark::State& state) {
    FieldPtr body;
    Job job = koala_job(body);
    IslandSurveyOptions options;
    options.pitch = 0.2;
    if (state.range(0) == 1)
        job.part = make_without_boxes(job.part, survey_islands(job, body, options).dropped);
    const dvec3 size = job.bounds.size();
    RowBand band;
    band.along_origin = job.bounds.lo.x;
    band.across_origin = job.bounds.lo.y;
    band.along_pitch = band.across_pitch = 0.05;
    band.count = static_cast<int>(size.y / 0.05);
    band.hi = static_cast<int>(size.x / 0.05);
    RunRows rows;
    for (auto _ : state) {
        for (int layer = 0; layer < job.layers.count(); layer += 20) Layer(job, layer).runs(band, rows);
        benchmark::DoNotOptimize(rows.runs().data());
    }
}
BENCHMARK(layers_without_islands)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
