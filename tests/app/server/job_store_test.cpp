// Jobs that are built before anyone asks for them, and what is kept of a job.
#include "app/jobs/job_store.h"

#include <catch2/catch.hpp>
#include <future>

#include "app/http/http_server.h"
#include "app/jobs/jobs_ahead.h"
#include "app/jobs/layer_content.h"
#include "app/jobs/recipe_mistakes.h"
#include "tests/app/commands/folder.h"
#include "tests/wait_for.h"

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

    std::shared_ptr<const ServedJob> ahead(const std::string& text) {
        return jobs.build_ahead(text, "page", std::make_shared<CancelToken>());
    }
};

}  // namespace

TEST_CASE("a job that was built ahead is the one that is asked for", "[server]") {
    Store store;
    auto ahead = std::async(std::launch::async, [&] { return store.ahead(foam); });
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
    CHECK(store.ahead(wrong) == nullptr);
    CHECK_THROWS_AS(store.jobs.build(wrong, "page", 1), RecipeMistakes);
    const auto cancel = std::make_shared<CancelToken>();
    cancel->cancel();
    CHECK(store.jobs.build_ahead(foam, "", cancel) == nullptr);
}

TEST_CASE("what is looked at next is computed ahead, and given up for what comes after", "[server]") {
    Store store;
    JobsAhead ahead(store.jobs, 2);
    const auto is_held = [&](const std::string& id) {
        return wait_for(20, [&] {
            try {
                return store.jobs.find(id) != nullptr;
            } catch (const HttpError&) {
                return false;
            }
        });
    };
    const auto id_of = [&](const std::string& text) {
        return served_job_id(read_served_recipe(text, store.folder), text);
    };
    ahead.begin({foam + "[foam]\n", "page", 3});  // wrong: nobody is told
    ahead.begin({foam, "page", 1000});
    REQUIRE(is_held(id_of(foam)));
    // Of a job that takes long only the next one is left, and its end is not waited for.
    std::string slow = foam;
    slow.replace(slow.find("radius = 5"), 10, "radius = 60");
    slow += "[repair]\ntrim = 0.2\n";
    ahead.begin({slow, "page", 0});
    ahead.begin({foam + "# next\n", "page", {}});
    REQUIRE(is_held(id_of(foam + "# next\n")));
    CHECK_THROWS_AS(store.jobs.find(id_of(slow)), HttpError);
    // A job that is asked for gives up the building of another one.
    ahead.begin({slow, "page", 0});
    CHECK(store.jobs.build(foam + "# asked\n", "page", 1));
    ahead.end();
    ahead.begin({foam + "# late\n", "page", 0});
    CHECK_THROWS_AS(store.jobs.find(id_of(slow)), HttpError);
    CHECK_THROWS_AS(store.jobs.find(id_of(foam + "# late\n")), HttpError);
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
