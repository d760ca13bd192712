// Jobs that are built before anyone asks for them, and what is kept of a job.
#include "app/jobs/job_store.h"

#include <catch2/catch.hpp>
#include <future>

#include "app/jobs/layer_content.h"
#include "app/jobs/recipe_mistakes.h"
#include "tests/app/commands/folder.h"

namespace job_store_test {

using namespace lamella;

namespace {

const std::string foam =
    "[part]\nshape = \"sphere\"\nradius = 5\n[foam]\ncell = 2\nbeam = 0.3\n[layers]\nheight = 0.1\n"
    "[printer]\nprofile = \"prusa-sl1s\"\n";

/// A store of jobs with an empty folder.
struct Store {
    Folder files;
    ServedFolder folder{files.path()};
    EventHub events;
    JobStore jobs{folder, events, 2, 4};
};

}  // namespace

TEST_CASE("a job that was built ahead is the one that is asked for", "[server]") {
    Store store;
    auto ahead = std::async(std::launch::async, [&] { return store.jobs.build_ahead(foam); });
    const auto asked = store.jobs.build(foam, "page", 1);  // during the build, or after it
    const auto built = ahead.get();
    REQUIRE(built);
    CHECK(store.jobs.find(built->id)->id == asked->id);
    CHECK(store.jobs.build(foam, "other", 1) == store.jobs.find(built->id));
    CHECK(asked->job().identity == built->job().identity);
    // Another recipe does not wait for it.
    CHECK(store.jobs.build(foam + "# other\n", "page", 2)->id != built->id);
}

TEST_CASE("a job that cannot be built ahead is told to whoever asks", "[server]") {
    Store store;
    const std::string wrong = foam + "[foam]\n";
    CHECK(store.jobs.build_ahead(wrong) == nullptr);
    CHECK_THROWS_AS(store.jobs.build(wrong, "page", 1), RecipeMistakes);
    store.jobs.cancel_all();
    CHECK(store.jobs.build_ahead(foam) == nullptr);
}

TEST_CASE("the coarse volume of a job is computed once", "[server]") {
    Store store;
    const auto job = store.jobs.build(foam, "page", 1);
    const auto coarse = job->coverage(64, {});
    CHECK(*coarse == coverage_volume(*job, 64, {}));
    CHECK(job->coverage(64, {}) == coarse);
    CHECK(*job->coverage(48, {}) == coverage_volume(*job, 48, {}));
    CHECK(job->coverage(96, {}) != job->coverage(96, {}));
    CancelToken cancelled;
    cancelled.cancel();
    PassControl control;
    control.cancel = &cancelled;
    CHECK_THROWS_AS(job->coverage(32, control), Interrupted);
    CHECK(*job->coverage(32, {}) == coverage_volume(*job, 32, {}));
}

}  // namespace job_store_test
