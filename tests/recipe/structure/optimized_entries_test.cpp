// Fields and gradings of kind `optimized`: regions and numbers that follow the result of the search.
#include <catch2/catch.hpp>

#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace optimized_entries_test {

using namespace lamella;

namespace {

const std::string block =
    "[part]\nshape = \"box\"\nsize = [24, 12, 12]\n"
    "[[load]]\nface = \"+x\"\nforce = [0, 0, -10]\n[[anchor]]\nface = \"-x\"\n";
const std::string search =
    "[optimize]\nresult = \"field\"\nelements = 24\niterations = 15\nsharpness = 4\nvolume = 0.3\n";
const std::string entries =
    "[[field]]\nname = \"frame\"\nkind = \"optimized\"\n[[grading]]\nname = \"share\"\nkind = "
    "\"optimized\"\n";

template <typename Visit>
void visit_points(Visit visit) {
    for (double x = -11.3; x < 12; x += 2.1) {
        for (double y = -5.3; y < 6; y += 2.3) {
            for (double z = -5.4; z < 6; z += 1.9) visit(dvec3(x, y, z));
        }
    }
}

}  // namespace

TEST_CASE("a region of the result is solid where the search found material", "[optimization]") {
    const BuiltJob empty =
        build_job(recipe_of(block + search + entries + "[[region]]\nfield = \"frame\"\nmake = \"empty\"\n"));
    const OptimizedPart& part = *empty.optimized;
    int dense = 0, points = 0;
    visit_points([&](dvec3 p) {
        const bool is_dense = part.density->at(p) > 0.5;
        CHECK((part.dense->value(p) < 0) == is_dense);
        CHECK(empty.body->value(p) < 0);
        CHECK((empty.job.part->value(p) > 0) == is_dense);
        dense += is_dense ? 1 : 0;
        ++points;
    });
    CHECK(dense == Approx(0.3 * points).margin(0.1 * points));
}

TEST_CASE("numbers of the foam follow the densities that were found", "[optimization]") {
    const std::string foam = "[foam]\ncell = 3\nbeam = \"0.2 + 0.3*wide\"\n";
    const std::string wide = "[[grading]]\nname = \"wide\"\nkind = \"formula\"\nformula = \"share^2\"\n";
    const BuiltJob job = build_job(recipe_of(block + search + entries + wide + foam));
    visit_points([&](dvec3 p) {
        const double share = job.optimized->density->at(p);
        CHECK(job.foam->member.asked->at(p) == Approx(0.2 + 0.3 * share * share));
    });
}

TEST_CASE("regions of the result stand among the others, each once", "[optimization]") {
    const std::string foam = "[foam]\ncell = 3\nbeam = 0.2\n";
    const std::string half = "[[field]]\nname = \"half\"\nformula = \"x\"\n";
    const std::string regions =
        "[[region]]\nfield = \"frame\"\nmake = \"foam\"\nbeam = 0.5\n"
        "[[region]]\nfield = \"half\"\nmake = \"foam\"\nbeam = 0.3\nblend = 2\n";
    const BuiltJob job = build_job(recipe_of(block + search + entries + foam + half + regions));
    REQUIRE(job.regions.list.size() == 2);
    CHECK(mentions(job.regions.list[1].name, "region 2 (`half`)"));
    visit_points([&](dvec3 p) {
        const double before = job.optimized->density->at(p) > 0.5 ? 0.5 : 0.2;
        const double beam = job.foam->member.asked->at(p);
        if (p.x < -1) CHECK(beam == Approx(0.3));
        if (p.x > 1) CHECK(beam == Approx(before));
        CHECK(beam <= std::max(before, 0.3) + 1e-12);
        CHECK(beam >= std::min(before, 0.3) - 1e-12);
    });
}

TEST_CASE("what depends on the result is no reason to search again", "[optimization]") {
    const Folder folder;
    OptimizeOptions options;
    options.plans = folder / "plans";
    int iterations = 0;
    options.on_iteration = [&](const OptimizationStep&, int) { ++iterations; };
    const auto build = [&](const std::string& more) {
        iterations = 0;
        build_job(recipe_of(block + search + entries + more), options);
        return iterations;
    };
    CHECK(build("[foam]\ncell = 3\nbeam = \"0.2 + 0.1*share\"\n") > 0);
    CHECK(build("[foam]\ncell = 4\nbeam = \"0.2 + 0.2*share\"\n") == 0);
    CHECK(build("[[region]]\nfield = \"frame\"\nmake = \"empty\"\n") == 0);
    const std::string pad = "[[field]]\nname = \"pad\"\nkind = \"box\"\nsize = [4, 4, 4]\n";
    CHECK(build(pad + "[[region]]\nfield = \"pad\"\nmake = \"empty\"\n") > 0);
}

TEST_CASE("a result that is not there is told", "[optimization]") {
    const auto told = [](const std::string& text) { return complaint_about(text); };
    CHECK(mentions(told("[part]\nshape = \"box\"\nsize = [24, 12, 12]\n" + entries),
                   "test.toml:4: field.kind: \"optimized\" is the result of a search, and there is none"));
    CHECK(mentions(told(block + search), "optimize.result: \"field\" leaves the part as it is"));
    CHECK(
        mentions(told(block + search + entries + "[[anchor]]\nfield = \"frame\"\n"),
                 "anchor.field: `frame` depends on the result of the search, which begins with this field"));
    const std::string hidden =
        "[[field]]\nname = \"later\"\nformula = \"share - 0.2\"\n[[load]]\nfield = \"later\"\npressure = 1\n";
    CHECK(mentions(told(block + search + entries + hidden), "load.field: `later` depends on the result"));
    std::string itself = block;
    itself.replace(0, itself.find("[[load"), "[part]\nfield = \"frame\"\n");
    CHECK(mentions(told(itself + search + entries), "part.field: `frame` depends on the result"));
    const std::string beam = "[optimize]\nresult = \"beam\"\nelements = 24\nvolume = 0.15\n";
    CHECK(mentions(told(block + entries + beam + "[foam]\ncell = 3\nbeam = \"0.2 + 0.1*share\"\n"),
                   "\"beam\" replaces test.toml"));
    CHECK(mentions(told(block + entries + beam + "[foam]\ncell = \"3 + share\"\nbeam = 0.3\n"),
                   "a formula or nothing is given"));
}

}  // namespace optimized_entries_test
