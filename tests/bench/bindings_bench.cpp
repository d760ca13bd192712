// What a section costs through the C interface, beside the same asked from inside.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstring>
#include <vector>

#include "bindings/lamella.h"
#include "engine/contours/contours.h"
#include "engine/contours/coverage.h"
#include "engine/field/slice_context.h"
#include "recipe/build/build_job.h"
#include "recipe/recipe_draft.h"

namespace lamella {
namespace {

constexpr const char* foam_text =
    "[part]\nshape = \"box\"\nsize = [120, 68, 40]\n[foam]\ncell = 3\nbeam = 0.3\n";
constexpr int columns = 7680, rows = 4320;
constexpr double pitch = 0.0165, tolerance = 0.025;

/// The job of the text, inside and through the C interface; heights that no cache knows yet.
struct Foam {
    Foam() {
        RecipeDraft draft;
        draft.read_text(foam_text, "bench.toml");
        inside = build_job(draft.finish());
        lamella_context_create(LAMELLA_ABI_VERSION, &context);
        lamella_recipe* recipe = nullptr;
        lamella_recipe_create(context, &recipe);
        lamella_recipe_add_text(context, recipe, foam_text, std::strlen(foam_text), "bench.toml");
        lamella_job_build(context, recipe, nullptr, &job);
        lamella_recipe_destroy(recipe);
    }
    ~Foam() {
        lamella_job_destroy(job);
        lamella_context_destroy(context);
    }
    Foam(const Foam&) = delete;
    Foam& operator=(const Foam&) = delete;
    double next_z() { return -15 + 0.05 * (calls++ % 600); }

    BuiltJob inside;
    lamella_context* context = nullptr;
    lamella_job* job = nullptr;
    int calls = 0;
};

void mask_inside(benchmark::State& state) {
    Foam foam;
    std::vector<std::uint8_t> pixels(std::size_t{columns} * rows);
    Scratch scratch;
    RunRows lines;
    std::vector<GreyRun> greys;
    for (auto _ : state) {
        SliceContext context;
        const SliceField& slice = context.slice(*foam.inside.job.part, foam.next_z());
        std::uint8_t* to = pixels.data();
        for (int first = 0; first < rows; first += 64) {
            RowBand band;
            band.along_origin = -columns * pitch / 2;
            band.across_origin = -rows * pitch / 2;
            band.along_pitch = band.across_pitch = pitch;
            band.first = first;
            band.count = std::min(64, rows - first);
            band.sub = 4;
            band.hi = columns;
            lines.clear();
            greys.clear();
            slice.runs(band, scratch, lines);
            coverage(band, lines, greys);
            for (const GreyRun& grey : greys) {
                std::memset(to, grey.value, grey.length);
                to += grey.length;
            }
        }
    }
}
BENCHMARK(mask_inside)->Unit(benchmark::kMillisecond);

void mask_by_call(benchmark::State& state) {
    Foam foam;
    std::vector<std::uint8_t> pixels(std::size_t{columns} * rows);
    lamella_raster raster{};
    raster.struct_size = sizeof raster;
    raster.columns = columns;
    raster.rows = rows;
    raster.lines = 4;
    raster.x = -columns * pitch / 2;
    raster.y = -rows * pitch / 2;
    raster.pitch_x = raster.pitch_y = pitch;
    for (auto _ : state) {
        lamella_section* section = nullptr;
        lamella_section_open(foam.context, foam.job, foam.next_z(), &section);
        if (lamella_section_coverage(foam.context, section, LAMELLA_PART, &raster, pixels.data(), 0) !=
            LAMELLA_OK)
            state.SkipWithError("no mask");
        lamella_section_destroy(section);
    }
}
BENCHMARK(mask_by_call)->Unit(benchmark::kMillisecond);

void contours_inside(Foam& foam, double z, Scratch& scratch) {
    SliceContext context;
    benchmark::DoNotOptimize(trace_contours(context.slice(*foam.inside.job.part, z), tolerance, scratch));
}

bool contours_by_call(Foam& foam, double z) {
    lamella_section* section = nullptr;
    lamella_contours* contours = nullptr;
    lamella_section_open(foam.context, foam.job, z, &section);
    const std::int32_t status =
        lamella_section_contours(foam.context, section, LAMELLA_PART, tolerance, &contours);
    lamella_contours_destroy(contours);
    lamella_section_destroy(section);
    return status == LAMELLA_OK;
}

/// The same heights in turn, one after the other: a machine's moods are greater than what is looked for. The
/// counters tell both in ms, and what the second takes over the first.
void contours_both_ways(benchmark::State& state) {
    Foam foam;
    Scratch scratch;
    double inside = 0, by_call = 0;
    int rounds = 0;
    const auto timed = [](const auto& work) {
        const auto start = std::chrono::steady_clock::now();
        work();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    };
    for (auto _ : state) {
        const double z = foam.next_z();
        const auto ask_inside = [&] { inside += timed([&] { contours_inside(foam, z, scratch); }); };
        const bool inside_first = ++rounds % 2 == 0;
        if (inside_first) ask_inside();
        by_call += timed([&] {
            if (!contours_by_call(foam, z)) state.SkipWithError("no contours");
        });
        if (!inside_first) ask_inside();
    }
    state.counters["inside_ms"] = inside / rounds;
    state.counters["by_call_ms"] = by_call / rounds;
    state.counters["ratio"] = by_call / inside;
}
BENCHMARK(contours_both_ways)->Unit(benchmark::kMillisecond)->MinTime(10);

}  // namespace
}  // namespace lamella
