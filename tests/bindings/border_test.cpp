// The border itself: versions, sizes of structs, null pointers, what is told of failures.
#include "tests/bindings/handles_by_call.h"

#include <cstddef>
#include <vector>

namespace border_test {

using namespace lamella;

namespace {

constexpr const char* ball = "[part]\nshape = \"sphere\"\nradius = 5\n";

std::int32_t build(const Caller& caller, const std::string& text) {
    const RecipeHandle recipe = recipe_by_call(caller, text);
    lamella_job* job = nullptr;
    const std::int32_t status = lamella_job_build(caller, recipe.get(), nullptr, &job);
    lamella_job_destroy(job);
    return status;
}

}  // namespace

TEST_CASE("another version of the interface is refused", "[bindings]") {
    lamella_context* context = nullptr;
    CHECK(lamella_abi_version() == LAMELLA_ABI_VERSION);
    CHECK(lamella_context_create(LAMELLA_ABI_VERSION + 1, &context) == LAMELLA_BAD_CALL);
    CHECK(context == nullptr);
    CHECK(lamella_context_create(LAMELLA_ABI_VERSION, nullptr) == LAMELLA_BAD_CALL);
}

TEST_CASE("every object that is no more may be destroyed", "[bindings]") {
    lamella_context_destroy(nullptr);
    lamella_cancel_destroy(nullptr);
    lamella_recipe_destroy(nullptr);
    lamella_job_destroy(nullptr);
    lamella_section_destroy(nullptr);
    lamella_runs_destroy(nullptr);
    lamella_contours_destroy(nullptr);
    lamella_cancel_request(nullptr);
}

TEST_CASE("a program that knows less of a struct gets what it knows", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, std::string(ball));
    auto known = sized<lamella_job_info>();
    caller.require(lamella_job_info_get(caller, job.get(), &known));
    CHECK(known.layer_count == 200);
    lamella_job_info old;
    std::memset(&old, 0x5a, sizeof old);
    old.struct_size = offsetof(lamella_job_info, lower);
    caller.require(lamella_job_info_get(caller, job.get(), &old));
    CHECK(old.layer_count == 200);
    CHECK(old.struct_size == offsetof(lamella_job_info, lower));
    const auto* bytes = reinterpret_cast<const unsigned char*>(&old);
    for (std::size_t i = old.struct_size; i < sizeof old; ++i) REQUIRE(bytes[i] == 0x5a);

    auto options = sized<lamella_run_options>();
    options.struct_size = offsetof(lamella_run_options, look_ahead);
    options.look_ahead = -1;  // which such a program does not have
    auto backend = sized<lamella_backend>();
    backend.render = [](void*, lamella_context*, lamella_section*, lamella_product*) { return 0; };
    backend.write = [](void*, const lamella_section_info*, const lamella_product*) { return 0; };
    caller.require(lamella_run_backend(caller, job.get(), &backend, &options, nullptr));
}

TEST_CASE("a program that knows more may ask only for what there is", "[bindings]") {
    struct Newer {
        lamella_run_options known;
        std::int64_t more;
    } options{};
    const Caller caller;
    const JobHandle job = job_by_call(caller, std::string(ball));
    auto backend = sized<lamella_backend>();
    backend.render = [](void*, lamella_context*, lamella_section*, lamella_product*) { return 0; };
    backend.write = [](void*, const lamella_section_info*, const lamella_product*) { return 0; };
    options.known.struct_size = sizeof options;
    caller.require(lamella_run_backend(caller, job.get(), &backend, &options.known, nullptr));
    options.more = 1;
    CHECK(lamella_run_backend(caller, job.get(), &backend, &options.known, nullptr) == LAMELLA_BAD_CALL);
    options.known.struct_size = 0;
    CHECK(lamella_run_backend(caller, job.get(), &backend, &options.known, nullptr) == LAMELLA_BAD_CALL);
    CHECK_THAT(caller.error().message, Catch::Contains("struct_size"));
}

TEST_CASE("null pointers are bad calls", "[bindings]") {
    const Caller caller;
    lamella_recipe* recipe = nullptr;
    lamella_job* job = nullptr;
    lamella_section* section = nullptr;
    CHECK(lamella_recipe_create(nullptr, &recipe) == LAMELLA_BAD_CALL);
    CHECK(lamella_recipe_create(caller, nullptr) == LAMELLA_BAD_CALL);
    CHECK(lamella_recipe_read(caller, nullptr, &recipe) == LAMELLA_BAD_CALL);
    CHECK(lamella_job_build(caller, nullptr, nullptr, &job) == LAMELLA_BAD_CALL);
    CHECK(lamella_section_open(caller, nullptr, 0, &section) == LAMELLA_BAD_CALL);
    CHECK_THAT(caller.error().message, Catch::Contains("job is a null pointer"));
    const JobHandle made = job_by_call(caller, std::string(ball));
    CHECK(lamella_job_info_get(caller, made.get(), nullptr) == LAMELLA_BAD_CALL);
    const SectionHandle cut = section_by_call(caller, made.get(), 0);
    CHECK(lamella_section_coverage(caller, cut.get(), LAMELLA_PART, nullptr, nullptr, 0) == LAMELLA_BAD_CALL);
    CHECK(lamella_section_contours(caller, cut.get(), 4, 0.1, nullptr) == LAMELLA_BAD_CALL);
}

TEST_CASE("mistakes of a recipe are told with their place", "[bindings]") {
    const Caller caller;
    CHECK(build(caller, "[part]\nshape = \"sphere\"\nradios = 5\n\n[foam]\ncell = \"x +\"\nbeam = 0.2\n") ==
          LAMELLA_BAD_INPUT);
    const lamella_error error = caller.error();
    CHECK(error.status == LAMELLA_BAD_INPUT);
    CHECK(std::string(error.path) == "test.toml");
    CHECK(error.line == 3);
    CHECK_THAT(error.message, Catch::Contains("did you mean `radius`"));

    const RecipeHandle recipe = recipe_by_call(caller);
    const std::string broken = "[part\n";
    CHECK(lamella_recipe_add_text(caller, recipe.get(), broken.data(), broken.size(), "a/b.toml") ==
          LAMELLA_BAD_INPUT);
    CHECK(std::string(caller.error().path) == "a/b.toml");
    CHECK(caller.error().line == 1);
    CHECK(lamella_recipe_set(caller, recipe.get(), "foam.sell", "1") == LAMELLA_BAD_INPUT);
    CHECK_THAT(caller.error().message, Catch::Contains("did you mean `foam.cell`"));
    CHECK(caller.error().line == 0);
    CHECK(lamella_recipe_set(caller, recipe.get(), "", "1") == LAMELLA_BAD_INPUT);
    CHECK(lamella_recipe_set(caller, recipe.get(), "region.make", "solid") == LAMELLA_BAD_INPUT);
}

TEST_CASE("what is set comes before what texts say, and texts add to each other", "[bindings]") {
    const Caller caller;
    const RecipeHandle recipe = recipe_by_call(caller);
    caller.require(lamella_recipe_set(caller, recipe.get(), "part.radius", "4"));
    const auto add = [&](const std::string& text) {
        caller.require(lamella_recipe_add_text(caller, recipe.get(), text.data(), text.size(), "t.toml"));
    };
    add(ball);
    add("[layers]\nheight = 0.1\n[[field]]\nname = \"a\"\nkind = \"sphere\"\nradius = 1\n");
    add("[[field]]\nname = \"b\"\nkind = \"sphere\"\nradius = 2\n[[region]]\nfield = \"a\"\nmake = "
        "\"empty\"\n");
    add("[[region]]\nfield = \"b\"\nmake = \"empty\"\n");
    const JobHandle job = job_by_call(caller, recipe.get());
    auto info = sized<lamella_job_info>();
    caller.require(lamella_job_info_get(caller, job.get(), &info));
    CHECK(info.layer_count == 80);
    const double pi = 3.14159265358979;
    CHECK(area_by_call(caller, section_by_call(caller, job.get(), 0).get()) ==
          Approx(pi * (16 - 4)).epsilon(1e-3));
    caller.require(lamella_recipe_set(caller, recipe.get(), "part.radius", "wide"));
    lamella_job* none = nullptr;
    CHECK(lamella_job_build(caller, recipe.get(), nullptr, &none) == LAMELLA_BAD_INPUT);
    CHECK_THAT(caller.error().message, Catch::StartsWith("part.radius: "));
}

}  // namespace border_test
