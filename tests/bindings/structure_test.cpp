// How parts bear their loads, asked through the C interface.
#include <set>
#include <vector>

#include "tests/bindings/handles_by_call.h"

namespace structure_test {

using namespace lamella;

namespace {

/// A bar of 20 x 4 x 4 mm, E = 2000 MPa and nu = 0, pulled along x with 16 N.
const std::string bar =
    "[part]\nshape = \"box\"\nsize = [20, 4, 4]\n[material]\nyoung = 2000\npoisson = 0\ndensity = 1\n"
    "[[load]]\nface = \"+x\"\nforce = [16, 0, 0]\n[[anchor]]\nface = \"-x\"\n";
const std::string plate =
    "[part]\nshape = \"box\"\nsize = [40, 20, 4]\n[material]\nyoung = 2000\npoisson = 0.3\n"
    "[[load]]\nbox = [[19.9, -0.1, -3], [20.1, 0.1, 3]]\nforce = [0, -10, 0]\n[[anchor]]\nface = \"-x\"\n"
    "[optimize]\ndimensions = 2\nelements = 40\niterations = 20\nvolume = 0.4\n";

}  // namespace

TEST_CASE("a bar stretches by its length times stress over modulus", "[bindings][optimization]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, bar);
    auto found = sized<lamella_structure>();
    auto options = sized<lamella_analysis_options>();
    options.model = LAMELLA_MODEL_ELEMENTS;
    options.elements = 20;
    caller.require(lamella_job_structure(caller, job.get(), &options, &found));
    CHECK(found.dimensions == 3);
    CHECK(found.iterations == 0);
    CHECK(found.element == Approx(1));
    CHECK(found.largest_displacement == Approx(20 * (16.0 / 16) / 2000).epsilon(1e-5));
    CHECK(found.compliance == Approx(16 * found.largest_displacement).epsilon(1e-5));
    CHECK(found.peak_stress == Approx(1).epsilon(1e-4));
    CHECK(found.mass == Approx(0.32).epsilon(1e-9));
    CHECK(found.volume == Approx(1));
}

TEST_CASE("a search is told while it goes on, and its result afterwards", "[bindings][optimization]") {
    const Caller caller;
    const RecipeHandle recipe = recipe_by_call(caller, plate);
    auto building = sized<lamella_build_options>();
    std::set<std::string> told;
    building.user = &told;
    building.progress = [](void* user, const char* what, std::int32_t, std::int32_t) {
        static_cast<std::set<std::string>*>(user)->insert(what);
        return std::int32_t{LAMELLA_OK};
    };
    lamella_job* made = nullptr;
    caller.require(lamella_job_build(caller, recipe.get(), &building, &made));
    const JobHandle job(made, lamella_job_destroy);
    CHECK(told.contains("optimisation"));
    auto found = sized<lamella_structure>();
    caller.require(lamella_job_structure(caller, job.get(), nullptr, &found));
    CHECK(found.dimensions == 2);
    CHECK(found.iterations == 20);
    CHECK(found.volume == Approx(0.4).epsilon(0.005));
    auto finer = sized<lamella_structure>();
    auto options = sized<lamella_analysis_options>();
    options.elements = 80;
    caller.require(lamella_job_structure(caller, job.get(), &options, &finer));
    CHECK(finer.iterations == 0);
    CHECK(finer.compliance == Approx(found.compliance).epsilon(0.1));
}

TEST_CASE("a search that is cancelled makes no job", "[bindings][optimization]") {
    const Caller caller;
    const RecipeHandle recipe = recipe_by_call(caller, plate);
    auto building = sized<lamella_build_options>();
    lamella_cancel* cancel = nullptr;
    caller.require(lamella_cancel_create(caller, &cancel));
    building.cancel = cancel;
    building.user = cancel;
    building.progress = [](void* user, const char*, std::int32_t done, std::int32_t) {
        if (done == 3) lamella_cancel_request(static_cast<lamella_cancel*>(user));
        return std::int32_t{LAMELLA_OK};
    };
    lamella_job* made = nullptr;
    CHECK(lamella_job_build(caller, recipe.get(), &building, &made) == LAMELLA_STOPPED);
    CHECK(made == nullptr);
    lamella_cancel_destroy(cancel);
}

TEST_CASE("an analysis of what is not loaded or not asked for rightly is refused", "[bindings]") {
    const Caller caller;
    auto found = sized<lamella_structure>();
    const JobHandle ball = job_by_call(caller, std::string("[part]\nshape = \"sphere\"\nradius = 5\n"));
    CHECK(lamella_job_structure(caller, ball.get(), nullptr, &found) == LAMELLA_BAD_INPUT);
    const JobHandle job = job_by_call(caller, bar);
    CHECK(lamella_job_structure(caller, job.get(), nullptr, nullptr) == LAMELLA_BAD_CALL);
    CHECK(lamella_job_structure(caller, nullptr, nullptr, &found) == LAMELLA_BAD_CALL);
    auto options = sized<lamella_analysis_options>();
    options.model = 3;
    CHECK(lamella_job_structure(caller, job.get(), &options, &found) == LAMELLA_BAD_CALL);
    options.model = LAMELLA_MODEL_LAW;
    CHECK(lamella_job_structure(caller, job.get(), &options, &found) == LAMELLA_BAD_INPUT);
    options = sized<lamella_analysis_options>();
    options.elements = 4;
    CHECK(lamella_job_structure(caller, job.get(), &options, &found) == LAMELLA_BAD_CALL);
}

}  // namespace structure_test
