// Layers over several processes: mpirun as users start it, and ranks within this process that fail.
#include "app/ranks/distribute_layers.h"

#include <catch2/catch.hpp>

#include "app/ranks/rank_failure.h"
#include "recipe/build/build_job.h"
#include "recipe/output/outputs.h"
#include "recipe/output/render_only.h"
#include "recipe/recipe_draft.h"
#include "tests/app/commands/folder.h"
#include "tests/app/ranks/mpirun.h"
#include "tests/app/ranks/ranks_inside.h"

namespace distribute_layers_test {

using namespace lamella;

namespace {

Recipe foam_recipe() {
    RecipeDraft draft;
    draft.read_text(
        "[part]\nname = \"b\"\nshape = \"box\"\nsize = [6, 6, 10]\n[foam]\ncell = 2\nbeam = 0.3\n[layers]\n"
        "height = 0.1\n[printer]\nprofile = \"svg\"\n",
        "test.toml");
    return draft.finish();
}

/// A run of so many ranks within this process, of which `failing` has no outputs that can be made.
StreamReport spread(const Folder& folder, const std::string& output, int size, int failing, Post& post) {
    const Recipe recipe = foam_recipe();
    const BuiltJob built = build_job(recipe);
    const std::vector<Output> outputs{{folder / output, recipe.printer}};
    StreamOptions options;
    options.range = {0, built.job.layers.count()};
    options.threads = 1;
    CancelToken aborted;
    StreamOptions options_there = options;
    options_there.cancel = &aborted;
    std::vector<std::thread> others;
    for (int rank = 1; rank < size; ++rank) {
        others.emplace_back([&, rank] {
            RanksInside ranks(post, rank, size);
            std::vector<Output> mine = outputs;
            if (rank == failing) mine.front().printer.vector.tolerance = -1;
            try {
                tell_failures(ranks, [&] {
                    render_blocks(ranks, built.job, make_renderer(mine, options.range), options_there);
                });
            } catch (const Interrupted&) {
            }
        });
    }
    RanksInside first(post, 0, size);
    auto backend = make_outputs(outputs, true);
    const auto join = [&] {
        for (std::thread& other : others) other.join();
    };
    try {
        const StreamReport report = spread_layers(first, built.job, backend, options);
        join();
        return report;
    } catch (...) {
        aborted.cancel();  // as all processes are
        join();
        throw;
    }
}

}  // namespace

TEST_CASE("any number of ranks writes what one process writes", "[ranks]") {
    const Folder folder;
    Post alone;
    spread(folder, "1.svg", 1, 0, alone);
    const std::string expected = contents(folder / "1.svg");
    REQUIRE(expected.size() > 1000);
    for (const int size : {2, 3, 5, 40}) {
        Post post;
        const std::string output = std::to_string(size) + ".svg";
        const StreamReport report = spread(folder, output, size, 0, post);
        CHECK(report.layers_written == 100);
        CHECK(contents(folder / output) == expected);
        CHECK(post.max_outstanding <= 17);
    }
}

TEST_CASE("a rank that fails fails the run with its words", "[ranks]") {
    const Folder folder;
    Post post;
    CHECK_THROWS_WITH(spread(folder, "f.svg", 3, 2, post), Catch::StartsWith("rank 2: "));
    CHECK_FALSE(std::filesystem::exists(folder / "f.svg"));
}

#ifdef LAMELLA_MPIRUN
namespace {

const std::string foam_command =
    std::string(LAMELLA_COMMAND) +
    " slice --shape box --shape-size 8,8,8 --cell 2 --beam 0.3 --layer-height 0.1 "
    "--threads 1 -q ";

}  // namespace

TEST_CASE("mpirun makes the same bytes with 1, 2 and 4 processes", "[ranks]") {
    const Folder folder;
    for (const std::string printer : {"svg", "marlin", "prusa-sl1s"}) {
        std::string expected;
        for (const int size : {1, 2, 4}) {
            const std::string output = folder / printer + std::to_string(size);
            const Outcome outcome = mpirun(
                "-n " + std::to_string(size) + " " + foam_command + "--printer " + printer + " -o " + output,
                folder);
            INFO(outcome.err);
            REQUIRE(outcome.code == 0);
            if (size == 1) expected = contents(output);
            CHECK(contents(output) == expected);
            CHECK(expected.size() > 1000);
        }
    }
}

TEST_CASE("what mpirun is given wrongly is told once, with the exit code", "[ranks]") {
    const Folder folder;
    const Outcome wrong = mpirun("-n 2 " + foam_command + "--beam -1 -o " + folder / "x.svg", folder);
    CHECK(wrong.code == 2);
    CHECK(wrong.err.find("--beam: ") != std::string::npos);
    CHECK(wrong.err.find("--beam: ") == wrong.err.rfind("--beam: "));
}
#endif

}  // namespace distribute_layers_test
