// Every recipe in examples/ builds, has a size and gives a first layer with something in it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "engine/field/slice_context.h"
#include "recipe/build/build_job.h"
#include "recipe/recipe_draft.h"

namespace examples_test {

using namespace lamella;

namespace {

std::vector<std::filesystem::path> recipes() {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(LAMELLA_SOURCE_DIR "/examples")) {
        if (entry.path().extension() == ".toml") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Length of all runs of one layer over a coarse raster, mm.
double solid_length(const BuiltJob& built, int layer) {
    constexpr int rows = 64;
    const Box& box = built.job.bounds;
    RowBand band;
    band.along_pitch = box.size().x / rows;
    band.across_pitch = box.size().y / rows;
    band.along_origin = box.lo.x;
    band.across_origin = box.lo.y;
    band.count = rows;
    band.hi = rows;
    SliceContext context;
    Scratch scratch;
    RunRows spans;
    context.slice(*built.job.part, built.job.plane(layer)).runs(band, scratch, spans);
    double length = 0;
    for (std::size_t line = 0; line < spans.lines(); ++line) {
        for (const Run& run : spans.line(line)) {
            REQUIRE(run.begin < run.end);
            length += (run.end - run.begin) * band.along_pitch / run_unit;
        }
    }
    return length;
}

}  // namespace

TEST_CASE("every example is a recipe whose layers hold material, but not everywhere") {
    REQUIRE(recipes().size() >= 20);
    for (const auto& path : recipes()) {
        INFO(path.string());
        RecipeDraft draft;
        draft.read_file(path.string());
        const Recipe recipe = draft.finish();
        const BuiltJob built = build_job(recipe);
        const Box& box = built.job.bounds;
        CHECK(built.job.layers.count() * recipe.layers.height ==
              Approx(box.size().z).margin(recipe.layers.height));
        const double whole = 64 * box.size().x;
        CHECK(solid_length(built, 0) <= whole);
        const double middle = solid_length(built, built.job.layers.count() / 2);
        CHECK(middle > 0);
        CHECK(middle < 0.9 * whole);
    }
}

}  // namespace examples_test
