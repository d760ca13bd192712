// What the embedding program gives: fields, meshes, gradings, back-ends.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <vector>

#include "engine/base/geometry.h"
#include "tests/app/commands/command_run.h"
#include "tests/app/commands/folder.h"
#include "tests/bindings/handles_by_call.h"

namespace host_test {

using namespace lamella;

namespace {

std::int32_t ball(void* user, const double* points, std::size_t count, double* values) {
    const double radius = *static_cast<const double*>(user);
    for (std::size_t i = 0; i < count; ++i) {
        const double* p = points + 3 * i;
        values[i] = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - radius;
    }
    return 0;
}

lamella_field ball_field(double& radius) {
    auto field = sized<lamella_field>();
    field.metric = LAMELLA_EXACT;
    for (int axis = 0; axis < 3; ++axis) {
        field.lower[axis] = -radius;
        field.upper[axis] = radius;
    }
    field.values = ball;
    field.user = &radius;
    field.identity = "ball";
    return field;
}

std::string identity_of(const Caller& caller, const lamella_job* job) {
    auto info = sized<lamella_job_info>();
    caller.require(lamella_job_info_get(caller, job, &info));
    return info.identity;
}

/// A chequered surface of polynomials, by the operations of tangle_formula, and how it was asked for.
struct Tangle {
    static std::int32_t values(void* user, const double* points, std::size_t count, double* out) {
        for (std::size_t i = 0; i < count; ++i) {
            double sum = 11.8;
            for (int axis = 0; axis < 3; ++axis) {
                const double square = points[3 * i + static_cast<std::size_t>(axis)] *
                                      points[3 * i + static_cast<std::size_t>(axis)];
                sum = sum + square * (square - 5);
            }
            out[i] = sum;
        }
        auto& own = *static_cast<Tangle*>(user);
        const std::lock_guard lock(own.counting);
        own.calls.push_back(count);
        return 0;
    }
    double mean() const {
        return static_cast<double>(std::accumulate(calls.begin(), calls.end(), std::size_t{0})) /
               static_cast<double>(calls.size());
    }

    std::mutex counting;
    std::vector<std::size_t> calls;  ///< points of each
};

constexpr const char* tangle_formula =
    "[[field]]\nname = \"tangle\"\nkind = \"formula\"\nbounds = [[-3, -3, -3], [3, 3, 3]]\n"
    "formula = \"11.8 + x*x*(x*x - 5) + y*y*(y*y - 5) + z*z*(z*z - 5)\"\n[part]\nfield = \"tangle\"\n";

JobHandle tangle_job(const Caller& caller, Tangle& tangle) {
    auto field = sized<lamella_field>();
    field.metric = LAMELLA_SIGN;
    for (int axis = 0; axis < 3; ++axis) {
        field.lower[axis] = -3;
        field.upper[axis] = 3;
    }
    field.values = Tangle::values;
    field.user = &tangle;
    field.identity = "tangle";
    const RecipeHandle recipe = recipe_by_call(caller);
    caller.require(lamella_recipe_add_field(caller, recipe.get(), "tangle", &field));
    return job_by_call(caller, recipe.get());
}

/// The runs of a section over a square of 6.4 mm, as they are handed out.
std::vector<std::int32_t> runs_by_call(const Caller& caller, const lamella_job* job, double z) {
    auto raster = sized<lamella_raster>();
    raster.columns = raster.rows = 160;
    raster.lines = 2;
    raster.x = raster.y = -3.2;
    raster.pitch_x = raster.pitch_y = 0.04;
    lamella_runs* runs = nullptr;
    caller.require(
        lamella_section_runs(caller, section_by_call(caller, job, z).get(), LAMELLA_PART, &raster, &runs));
    auto view = sized<lamella_runs_view>();
    caller.require(lamella_runs_view_get(caller, runs, &view));
    std::vector<std::int32_t> all(view.ends, view.ends + 2 * view.first[view.line_count]);
    for (std::size_t l = 0; l <= view.line_count; ++l)
        all.push_back(static_cast<std::int32_t>(view.first[l]));
    lamella_runs_destroy(runs);
    return all;
}

/// A back-end that keeps what it is told.
struct Keeper {
    double area_of(int layer) const { return areas.at(static_cast<std::size_t>(layer)); }

    std::vector<int> written;
    std::vector<double> areas;
    std::atomic<int> rendered{0}, dropped{0};
    bool begun = false, ended = false;
    int fails_at = -1;
    std::int32_t fails_with = LAMELLA_FAULT;
    std::string failure = "the belt is off";
};

lamella_backend backend_of(Keeper& keeper) {
    auto backend = sized<lamella_backend>();
    backend.user = &keeper;
    backend.begin = [](void* user, const lamella_job_info* job, std::int32_t, std::int32_t last,
                       std::uint32_t, std::int32_t*) -> std::int32_t {
        static_cast<Keeper*>(user)->begun = job->layer_count >= last;
        return 0;
    };
    backend.render = [](void* user, lamella_context* context, lamella_section* layer,
                        lamella_product* product) -> std::int32_t {
        auto& own = *static_cast<Keeper*>(user);
        ++own.rendered;
        lamella_contours* contours = nullptr;
        if (lamella_section_contours(context, layer, LAMELLA_PART, 0.01, &contours) != LAMELLA_OK) return 3;
        auto view = sized<lamella_contours_view>();
        lamella_contours_view_get(context, contours, &view);
        product->area = view.area;
        product->data = new double(view.area);
        lamella_contours_destroy(contours);
        return 0;
    };
    backend.write = [](void* user, const lamella_section_info* layer,
                       const lamella_product* product) -> std::int32_t {
        auto& own = *static_cast<Keeper*>(user);
        if (layer->layer == own.fails_at) return own.fails_with;
        own.written.push_back(layer->layer);
        own.areas.push_back(*static_cast<double*>(product->data));
        return 0;
    };
    backend.end = [](void* user) -> std::int32_t {
        static_cast<Keeper*>(user)->ended = true;
        return 0;
    };
    backend.drop = [](void* user, void* data) {
        ++static_cast<Keeper*>(user)->dropped;
        delete static_cast<double*>(data);
    };
    backend.error = [](void* user) { return static_cast<Keeper*>(user)->failure.c_str(); };
    return backend;
}

}  // namespace

TEST_CASE("a field of the program's is a solid like any other", "[bindings]") {
    const Caller caller;
    double radius = 5;
    for (const std::int32_t metric : {LAMELLA_EXACT, LAMELLA_BOUND, LAMELLA_SIGN}) {
        lamella_field field = ball_field(radius);
        field.metric = metric;
        const RecipeHandle recipe = recipe_by_call(caller, "[layers]\nheight = 0.5\n");
        caller.require(lamella_recipe_add_field(caller, recipe.get(), "bulb", &field));
        const JobHandle job = job_by_call(caller, recipe.get());
        auto info = sized<lamella_job_info>();
        caller.require(lamella_job_info_get(caller, job.get(), &info));
        CHECK(std::string(info.name) == "bulb");
        CHECK(info.layer_count == 20);
        for (const double z : {-4.0, 0.3, 2.0}) {
            CHECK(area_by_call(caller, section_by_call(caller, job.get(), z).get()) ==
                  Approx(pi * (25 - z * z)).epsilon(2e-3));
        }
    }
}

TEST_CASE("a field of the program's makes the runs of its formula, by hundreds of points a call",
          "[bindings]") {
    const Caller caller;
    Tangle tangle;
    const JobHandle host = tangle_job(caller, tangle), own = job_by_call(caller, std::string(tangle_formula));
    for (const double z : {-1.6, 0.1, 2.2}) {
        tangle.calls.clear();
        const auto runs = runs_by_call(caller, host.get(), z);
        CHECK(runs == runs_by_call(caller, own.get(), z));
        CHECK(tangle.mean() > 500);
        const SectionHandle section = section_by_call(caller, host.get(), z);
        CHECK(area_by_call(caller, section.get()) ==
              area_by_call(caller, section_by_call(caller, own.get(), z).get()));
        CHECK(tangle.mean() > 500);
    }
}

TEST_CASE("a field that tells distances is asked by hundreds of points a call", "[bindings]") {
    const Caller caller;
    struct {
        std::size_t calls = 0, points = 0;
    } asked;
    auto field = sized<lamella_field>();
    field.metric = LAMELLA_EXACT;
    for (int axis = 0; axis < 3; ++axis) {
        field.lower[axis] = -5;
        field.upper[axis] = 5;
    }
    field.values = [](void* user, const double* points, std::size_t count, double* values) {
        auto& own = *static_cast<decltype(&asked)>(user);
        ++own.calls;
        own.points += count;
        double radius = 5;
        return ball(&radius, points, count, values);
    };
    field.user = &asked;
    field.identity = "ball";
    const RecipeHandle recipe = recipe_by_call(caller);
    caller.require(lamella_recipe_add_field(caller, recipe.get(), "bulb", &field));
    const JobHandle job = job_by_call(caller, recipe.get());
    asked = {};
    CHECK(area_by_call(caller, section_by_call(caller, job.get(), 1).get()) == Approx(24 * pi).epsilon(1e-3));
    CHECK(asked.points > 100 * asked.calls);
}

TEST_CASE("how a field of the program's is asked does not depend on threads", "[bindings]") {
    const Caller caller;
    Tangle tangle;
    const JobHandle job = tangle_job(caller, tangle);
    std::vector<double> areas;
    std::vector<std::size_t> calls;
    for (const std::int32_t threads : {1, 4}) {
        tangle.calls.clear();
        Keeper keeper;
        const lamella_backend backend = backend_of(keeper);
        auto options = sized<lamella_run_options>();
        options.threads = threads;
        options.last = 12;
        caller.require(lamella_run_backend(caller, job.get(), &backend, &options, nullptr));
        std::sort(tangle.calls.begin(), tangle.calls.end());
        if (areas.empty()) {
            areas = keeper.areas;
            calls = tangle.calls;
        }
        CHECK(keeper.areas == areas);
        CHECK(tangle.calls == calls);
    }
}

TEST_CASE("foam in a field of the program's is that in the same shape", "[bindings]") {
    const Caller caller;
    double radius = 5;
    const lamella_field field = ball_field(radius);
    const std::string foam = "[foam]\ncell = 2\nbeam = 0.25\n";
    const RecipeHandle recipe = recipe_by_call(caller, foam);
    caller.require(lamella_recipe_add_field(caller, recipe.get(), "bulb", &field));
    const JobHandle host = job_by_call(caller, recipe.get()),
                    own = job_by_call(caller, "[part]\nshape = \"sphere\"\nradius = 5\n" + foam);
    for (const double z : {-3.0, 1.1}) {
        CHECK(area_by_call(caller, section_by_call(caller, host.get(), z).get()) ==
              Approx(area_by_call(caller, section_by_call(caller, own.get(), z).get())).epsilon(1e-3));
    }
    CHECK(identity_of(caller, host.get()) != identity_of(caller, own.get()));
}

TEST_CASE("what identifies a field of the program's identifies the job", "[bindings]") {
    const Caller caller;
    double radius = 5;
    const auto identity = [&](const char* name) {
        lamella_field field = ball_field(radius);
        field.identity = name;
        const RecipeHandle recipe = recipe_by_call(caller);
        caller.require(lamella_recipe_add_field(caller, recipe.get(), "bulb", &field));
        return identity_of(caller, job_by_call(caller, recipe.get()).get());
    };
    CHECK(identity("a") == identity("a"));
    CHECK(identity("a") != identity("b"));
}

TEST_CASE("a mesh of the program's is closed and sliced", "[bindings]") {
    const Caller caller;
    const double vertices[]{0, 0, 0, 6, 0, 0, 0, 6, 0, 0, 0, 6};
    const std::uint32_t triangles[]{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    auto mesh = sized<lamella_mesh>();
    mesh.vertices = vertices;
    mesh.vertex_count = 4;
    mesh.triangles = triangles;
    mesh.triangle_count = 4;
    const RecipeHandle recipe = recipe_by_call(caller);
    caller.require(lamella_recipe_add_mesh(caller, recipe.get(), "corner", &mesh));
    const JobHandle job = job_by_call(caller, recipe.get());
    CHECK(area_by_call(caller, section_by_call(caller, job.get(), 2).get()) == Approx(8).epsilon(1e-2));
    const std::uint32_t beyond[]{0, 1, 4};
    mesh.triangles = beyond;
    mesh.triangle_count = 1;
    CHECK(lamella_recipe_add_mesh(caller, recipe.get(), "corner", &mesh) == LAMELLA_BAD_CALL);
    CHECK_THAT(caller.error().message, Catch::Contains("vertex 4 of 4"));
}

TEST_CASE("a grading of the program's makes the foam that its formula makes", "[bindings]") {
    const Caller caller;
    auto grading = sized<lamella_grading>();
    grading.least = 1;
    grading.greatest = 4;
    grading.identity = "linear";
    grading.values = [](void*, const double* points, std::size_t count, double* values) -> std::int32_t {
        for (std::size_t i = 0; i < count; ++i) values[i] = 2 + 0.2 * points[3 * i];
        return 0;
    };
    grading.range = [](void*, const double* lower, const double* upper, double* least,
                       double* greatest) -> std::int32_t {
        *least = 2 + 0.2 * lower[0];
        *greatest = 2 + 0.2 * upper[0];
        return 0;
    };
    const std::string part =
        "[part]\nshape = \"box\"\nsize = [10, 10, 4]\n[foam]\nbeam = 0.2\ncell_min = 1\n"
        "cell_max = 4\ncell = ";
    const RecipeHandle recipe = recipe_by_call(caller, part +
                                                           "\"wanted\"\n[[grading]]\nname = \"wanted\"\n"
                                                           "kind = \"host\"\n");
    lamella_job* none = nullptr;
    CHECK(lamella_job_build(caller, recipe.get(), nullptr, &none) == LAMELLA_BAD_INPUT);
    CHECK_THAT(caller.error().message,
               Catch::Contains("the embedding program does not provide the grading `wanted`"));
    caller.require(lamella_recipe_add_grading(caller, recipe.get(), "wanted", &grading));
    const JobHandle host = job_by_call(caller, recipe.get()),
                    own = job_by_call(caller, part + "\"2 + 0.2 * x\"\n");
    for (const double z : {-1.5, 0.2}) {
        CHECK(area_by_call(caller, section_by_call(caller, host.get(), z).get()) ==
              area_by_call(caller, section_by_call(caller, own.get(), z).get()));
    }
}

TEST_CASE("a foam asks a grading of the program's for many points at a time", "[bindings]") {
    struct Asked {
        std::size_t calls = 0, points = 0;
    };
    const auto waves = [](void* user, const double* points, std::size_t count, double* values) {
        auto& asked = *static_cast<Asked*>(user);
        ++asked.calls;
        asked.points += count;
        for (std::size_t i = 0; i < count; ++i) values[i] = 0.2 + 0.01 * points[3 * i + 2];
        return std::int32_t{0};
    };
    const std::string key = GENERATE("beam = \"wanted\"\ncell = 2\n", "beam = \"0.5 * wanted\"\ncell = 2\n",
                                     "beam = 0.2\ncell = \"10 * wanted\"\n");
    const Caller caller;
    const RecipeHandle recipe =
        recipe_by_call(caller, "[part]\nshape = \"box\"\nsize = [10, 10, 4]\n[foam]\n" + key +
                                   "[[grading]]\nname = \"wanted\"\nkind = \"host\"\n");
    Asked asked;
    auto grading = sized<lamella_grading>();
    grading.least = 0.15;
    grading.greatest = 0.25;
    grading.identity = "waves";
    grading.values = waves;
    grading.user = &asked;
    caller.require(lamella_recipe_add_grading(caller, recipe.get(), "wanted", &grading));
    auto options = sized<lamella_build_options>();
    options.threads = 1;
    lamella_job* job = nullptr;
    caller.require(lamella_job_build(caller, recipe.get(), &options, &job));
    const JobHandle handle(job, lamella_job_destroy);
    asked = {};
    CHECK(area_by_call(caller, section_by_call(caller, job, 0.1).get()) > 0);
    CHECK(asked.points > 1000);
    CHECK(asked.points > 6 * asked.calls);
}

TEST_CASE("a field that fails fails the call", "[bindings]") {
    const Caller caller;
    double radius = 5;
    lamella_field field = ball_field(radius);
    field.values = [](void*, const double*, std::size_t, double*) -> std::int32_t { return 9; };
    const RecipeHandle recipe = recipe_by_call(caller);
    caller.require(lamella_recipe_add_field(caller, recipe.get(), "bulb", &field));
    lamella_job* job = nullptr;
    std::int32_t status = lamella_job_build(caller, recipe.get(), nullptr, &job);
    const JobHandle handle(job, lamella_job_destroy);
    if (status == LAMELLA_OK) {
        const SectionHandle section = section_by_call(caller, job, 0);
        lamella_contours* contours = nullptr;
        status = lamella_section_contours(caller, section.get(), LAMELLA_PART, 0.1, &contours);
        CHECK(contours == nullptr);
    }
    CHECK(status == LAMELLA_FAULT);
    CHECK_THAT(caller.error().message, Catch::Contains("field `bulb` failed with status 9"));
    field.upper[0] = field.lower[0];
    CHECK(lamella_recipe_add_field(caller, recipe.get(), "bulb", &field) == LAMELLA_BAD_CALL);
    CHECK(lamella_recipe_add_field(caller, recipe.get(), "no name", &field) == LAMELLA_BAD_CALL);
}

TEST_CASE("a back-end of the program's gets every layer once, in order", "[bindings]") {
    const Caller caller;
    const JobHandle job =
        job_by_call(caller, std::string("[part]\nshape = \"sphere\"\nradius = 5\n[layers]\nheight = 0.1\n"));
    Keeper keeper;
    const lamella_backend backend = backend_of(keeper);
    auto options = sized<lamella_run_options>();
    std::vector<int> told;
    options.user = &told;
    options.progress = [](void* user, const char* what, std::int32_t done, std::int32_t) -> std::int32_t {
        if (std::string(what) == "layers") static_cast<std::vector<int>*>(user)->push_back(done);
        return 0;
    };
    auto report = sized<lamella_run_report>();
    caller.require(lamella_run_backend(caller, job.get(), &backend, &options, &report));
    REQUIRE(keeper.written.size() == 100);
    for (int i = 0; i < 100; ++i) {
        CHECK(keeper.written[static_cast<std::size_t>(i)] == i);
        double z = 0;
        caller.require(lamella_job_layer_z(caller, job.get(), i, &z));
        CHECK(keeper.area_of(i) == Approx(pi * (25 - z * z)).margin(0.05));
    }
    CHECK(keeper.begun);
    CHECK(keeper.ended);
    CHECK(keeper.rendered == keeper.dropped);
    CHECK(report.layers_written == 100);
    CHECK(report.volume == Approx(4 * pi / 3 * 125).epsilon(2e-3));
    CHECK(told.size() == 100);

    Keeper some;
    const lamella_backend other = backend_of(some);
    options.first = 40;
    options.last = 43;
    caller.require(lamella_run_backend(caller, job.get(), &other, &options, &report));
    CHECK(some.written == std::vector<int>{40, 41, 42});
    options.last = 101;
    CHECK(lamella_run_backend(caller, job.get(), &other, &options, &report) == LAMELLA_BAD_CALL);
}

TEST_CASE("a back-end that fails says why, and nothing of its is lost", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, std::string("[part]\nshape = \"sphere\"\nradius = 5\n"));
    Keeper keeper;
    keeper.fails_at = 17;
    const lamella_backend backend = backend_of(keeper);
    CHECK(lamella_run_backend(caller, job.get(), &backend, nullptr, nullptr) == LAMELLA_FAULT);
    CHECK(std::string(caller.error().message) == "the belt is off");
    CHECK(keeper.written.size() == 17);
    CHECK_FALSE(keeper.ended);
    CHECK(keeper.rendered == keeper.dropped);
    keeper.fails_with = LAMELLA_STOPPED;
    keeper.written.clear();
    CHECK(lamella_run_backend(caller, job.get(), &backend, nullptr, nullptr) == LAMELLA_STOPPED);
}

TEST_CASE("a token and a callback stop a run", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, std::string("[part]\nshape = \"sphere\"\nradius = 5\n"));
    lamella_cancel* cancel = nullptr;
    caller.require(lamella_cancel_create(caller, &cancel));
    Keeper keeper;
    const lamella_backend backend = backend_of(keeper);
    auto options = sized<lamella_run_options>();
    options.cancel = cancel;
    options.user = cancel;
    options.progress = [](void* user, const char*, std::int32_t done, std::int32_t) -> std::int32_t {
        if (done == 20) lamella_cancel_request(static_cast<lamella_cancel*>(user));
        return 0;
    };
    CHECK(lamella_run_backend(caller, job.get(), &backend, &options, nullptr) == LAMELLA_STOPPED);
    CHECK(keeper.written.size() >= 20);
    CHECK(keeper.written.size() < 60);
    CHECK(keeper.rendered == keeper.dropped);
    keeper.written.clear();
    options.cancel = nullptr;
    options.progress = [](void*, const char*, std::int32_t done, std::int32_t) -> std::int32_t {
        return done == 10 ? LAMELLA_STOPPED : LAMELLA_OK;
    };
    CHECK(lamella_run_backend(caller, job.get(), &backend, &options, nullptr) == LAMELLA_STOPPED);
    CHECK(keeper.written.size() == 10);
    lamella_cancel_destroy(cancel);
}

TEST_CASE("a run by a call writes what the command writes", "[bindings]") {
    const Folder folder;
    const std::string text =
        "[part]\nname = \"bulb\"\nshape = \"sphere\"\nradius = 4\n[foam]\ncell = 2\nbeam = 0.3\n"
        "[printer]\nprofile = \"svg\"\n";
    write(folder / "bulb.toml", text);
    REQUIRE(run_lamella("slice " + folder / "bulb.toml" + " -o " + folder / "command.svg").code == 0);
    const Caller caller;
    lamella_recipe* read = nullptr;
    caller.require(lamella_recipe_read(caller, (folder / "bulb.toml").c_str(), &read));
    const RecipeHandle recipe(read, lamella_recipe_destroy);
    const JobHandle job = job_by_call(caller, recipe.get());
    const std::string path = folder / "call.svg";
    auto options = sized<lamella_run_options>();
    options.last = 30;
    caller.require(lamella_run(caller, job.get(), path.c_str(), nullptr, nullptr));
    CHECK(contents(path) == contents(folder / "command.svg"));
    CHECK(lamella_run(caller, job.get(), path.c_str(), nullptr, nullptr) == LAMELLA_BAD_INPUT);
    options.flags = LAMELLA_FORCE;
    caller.require(lamella_run(caller, job.get(), path.c_str(), &options, nullptr));
    options.flags = 64;
    CHECK(lamella_run(caller, job.get(), path.c_str(), &options, nullptr) == LAMELLA_BAD_CALL);
    CHECK(lamella_run(caller, job.get(), (folder / "x@nothing").c_str(), nullptr, nullptr) ==
          LAMELLA_BAD_INPUT);
}

}  // namespace host_test
