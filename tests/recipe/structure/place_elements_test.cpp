// A plate of sticks from a recipe: kept, cut, told of what cannot be.
#include "recipe/structure/place_elements.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "engine/base/error.h"
#include "recipe/build/build_job.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/mentions.h"
#include "tests/app/commands/recipes.h"
#include "tests/engine/runs/plane_runs.h"

namespace place_elements_test {

using namespace lamella;

namespace {

std::string plate(const std::string& element, const std::string& keys) {
    return "[part]\nshape = \"box\"\nsize = [60, 24, 3]\n"
           "[[load]]\nbox = [[29, -12, -2], [30, -8, 2]]\nforce = [0, -10, 0]\n[[anchor]]\nface = \"-x\"\n"
           "[[element]]\n" +
           element + "[elements]\ndimensions = 2\n" + keys;
}

const std::string sticks = plate("length = 10\nwidth = 2.4\n", "count = 24\niterations = 40\n");

std::string told(const std::string& text) {
    try {
        build_job(recipe_of(text, "p.toml"));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a plate of sticks is one piece, the same at every height, and kept", "[elements]") {
    const Folder folder;
    OptimizeOptions options;
    options.plans = folder.path();
    int iterations = 0;
    options.on_elements = [&](const ElementIteration& done, int all) {
        CHECK(all == 40);
        iterations += done.index > 0 ? 1 : 0;
    };
    const Recipe recipe = recipe_of(sticks, "p.toml");
    const BuiltJob built = build_job(recipe, options);
    CHECK(iterations == 40);
    const ElementPlan& plan = *built.elements;
    CHECK(plan.elements.size() + plan.dropped == 24);
    CHECK(plan.volume > 0.2);
    CHECK(plan.volume < 24 * 22.8 / (60 * 24));
    CHECK(plan.compliance < 8 * plan.full_compliance);
    CHECK(plan.compliance > plan.full_compliance);
    const Box box = built.designed.bounds;
    const RowBand band = band_over(box, 0.05);
    const RunRows low = runs_at(*built.designed.part, -1.3, band),
                  high = runs_at(*built.designed.part, 1.4, band);
    CHECK(low.runs().size() > 0);
    CHECK(std::ranges::equal(low.runs(), high.runs()));
    const double area = static_cast<double>(low.total_length()) / run_unit * 0.05 * 0.05;
    CHECK(area / (60 * 24) == Approx(plan.volume).epsilon(0.02));

    const BuiltJob again = build_job(recipe, options);
    CHECK(iterations == 40);
    CHECK(again.elements->elements == plan.elements);
    CHECK(again.elements->compliance == plan.compliance);
    build_job(recipe_of(sticks + "seed = 2\n", "p.toml"), options);
    CHECK(iterations == 80);
}

TEST_CASE("a plan of elements that is damaged is refused", "[elements]") {
    const Folder folder;
    const std::filesystem::path file = folder.path() / "some.elements";
    ElementPlan plan{.elements = {{.shape = 1, .at = {0.1, 2, -3}, .turn = {0.6, 0, 0.8, 0}, .scale = 1.5},
                                  {.shape = 0, .at = {1.0 / 3, 0, 0}}},
                     .pieces = 3,
                     .moved = 2,
                     .dropped = 1,
                     .volume = 0.25,
                     .compliance = 12.5,
                     .full_compliance = 3.25,
                     .optimum = 6};
    write_element_plan(file, plan);
    const std::string whole = contents(file);
    const auto read = [](const std::string& text) {
        std::istringstream in(text);
        return read_element_plan(in, "some");
    };
    const ElementPlan back = read(whole);
    CHECK(back.elements == plan.elements);
    CHECK(back.pieces == 3);
    CHECK(back.moved == 2);
    CHECK(back.dropped == 1);
    CHECK(back.optimum == 6);
    for (std::size_t cut = 0; cut + 1 < whole.size(); cut += 7)
        CHECK_THROWS_AS(read(whole.substr(0, cut)), InputError);
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        return text.replace(at, from.size(), to);
    };
    CHECK_THROWS_AS(read(changed("2,3,2,1", "3,3,2,1")), InputError);  // fewer elements than announced
    CHECK_THROWS_AS(read(changed("2,3,2,1", "-2,3,2,1")), InputError);
    CHECK_THROWS_AS(read(changed("\n1,0.1", "\n1e12,0.1")), InputError);
    CHECK_THROWS_AS(read(changed("\n1,0.1", "\n0.5,0.1")), InputError);
    CHECK_THROWS_AS(read(changed("0.8", "0.9")), InputError);  // not a rotation
    CHECK_THROWS_AS(read(changed(",1.5\n", ",0\n")), InputError);
    CHECK_THROWS_AS(read(changed(",1.5\n", ";1.5\n")), InputError);
}

TEST_CASE("elements that cannot make the part are told why", "[elements]") {
    CHECK(mentions(told(plate("length = 80\nwidth = 2.4\n", "count = 24\n")),
                   "80 mm across, it is larger than the part, 60 mm"));
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 400\n")), "elements.count"));
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 400\n")), "smaller shapes"));
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 24\nelement = 3\n")),
                   "3 mm is too coarse for shapes 2.3"));
    // Two short sticks cannot reach from the wall to the load.
    CHECK(mentions(told(plate("length = 10\nwidth = 2.4\n", "count = 2\niterations = 5\n")),
                   "do not reach all loads and anchors"));
}

}  // namespace place_elements_test
