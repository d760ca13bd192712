// Layers as recipes ask for them: first ones, lists, lifts, scales; and what makes no sense.
#include "recipe/layering/plan_layers.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/app/commands/recipes.h"

namespace plan_layers_test {

using namespace lamella;

namespace {

const std::string ten_high = "[part]\nshape = \"box\"\nsize = [4, 4, 10]\n";

LayerPlan plan_of(const std::string& text) { return build_job(recipe_of(text)).job.layers; }

}  // namespace

TEST_CASE("equal layers are what they were", "[layers]") {
    CHECK(plan_of(ten_high + "[layers]\nheight = 0.3\n") == LayerPlan(33, 0.3));
    CHECK(plan_of(ten_high + "[layers]\nheight = 0.2\nfirst = 0.2\n") == LayerPlan(50, 0.2));
}

TEST_CASE("a first layer of its own, and a list", "[layers]") {
    CHECK(plan_of(ten_high + "[layers]\nheight = 0.2\nfirst = 0.4\n") == LayerPlan({{1, 0.4}, {48, 0.2}}));
    // 2.1 mm are eleven layers of 0.2 mm, that begin below it; the last ends at 10.1, beyond the part.
    CHECK(plan_of(ten_high + "[layers]\nheight = 0.2\nheights = [[2.1, 0.1], [5, 0.3]]\n") ==
          LayerPlan({{11, 0.2}, {28, 0.1}, {17, 0.3}}));
    CHECK(plan_of(ten_high + "[layers]\nheights = [[0, 0.25], [4, 0.5]]\nfirst = 0.5\n") ==
          LayerPlan({{1, 0.5}, {14, 0.25}, {12, 0.5}}));
    // What begins within the first layer begins above it.
    CHECK(plan_of(ten_high + "[layers]\nheights = [[0, 0.25], [0.1, 0.5]]\nfirst = 0.5\n") ==
          LayerPlan(20, 0.5));
    // 0.04 mm are left, which no layer's middle lies in.
    CHECK(plan_of(ten_high + "[layers]\nheight = 0.24\nheights = [[9.8, 0.2]]\n").count() == 41 + 1);
}

TEST_CASE("the layers below a lifted part are the print's first", "[layers]") {
    const std::string lifted =
        ten_high + "[support]\nkind = \"pillars\"\nlift = 2.52\n[printer]\nprofile = \"elegoo-mars-3\"\n";
    const Recipe recipe = recipe_of(lifted + "[layers]\nheight = 0.05\nfirst = 0.1\n");
    CHECK(lift_layers(recipe) == LayerPlan({{1, 0.1}, {49, 0.05}}));
    const BuiltJob built = build_job(recipe);
    CHECK(built.layers.plan == LayerPlan(200, 0.05));
    CHECK(lift_layers(recipe_of(ten_high + "[layers]\nheight = 0.05\n")).count() == 0);
}

TEST_CASE("layers are those of the print, under a scale", "[layers]") {
    const BuiltJob built = build_job(
        recipe_of(ten_high + "[layers]\nheight = 0.2\nfirst = 0.4\n[process]\nscale = [1, 1, 2]\n"));
    CHECK(built.job.layers == LayerPlan({{1, 0.4}, {98, 0.2}}));
    CHECK(built.designed.layers == LayerPlan({{1, 0.2}, {98, 0.1}}));
    for (const int i : {0, 1, 50, 98}) {
        CHECK(built.job.plane(i) - built.job.z0() ==
              Approx(2 * (built.designed.plane(i) - built.designed.z0())));
    }
}

TEST_CASE("layers adapt to the outer surface", "[layers]") {
    const std::string ball = "[part]\nshape = \"sphere\"\nradius = 6\n[layers]\nheight = 0.2\ncusp = 0.12\n";
    const BuiltJob built = build_job(recipe_of(ball));
    CHECK(*built.layers.cusp <= 0.12 * 1.001);
    CHECK(built.job.layers.least_height() >= 0.1 - 1e-9);
    CHECK(built.job.layers.greatest_height() <= 0.3 + 1e-9);
    CHECK(built.job.layers.count() < 75);
    // A skin outside is 1 mm more, all about; foam inside changes nothing.
    const BuiltJob skinned = build_job(
        recipe_of(ball + "[skin]\nthickness = 1\nside = \"outside\"\n[foam]\ncell = 2\nbeam = 0.3\n"));
    CHECK(skinned.job.layers.total() == Approx(14).margin(0.1));
    const BuiltJob first = build_job(recipe_of(ball + "first = 0.25\n"));
    CHECK(first.job.layers.height(0) == 0.25);
    CHECK(first.job.layers.total() == Approx(12).margin(0.1));
}

namespace {

/// A region of layers of their own, between two heights over the bed of parts whose middle lies at z = 0.
std::string layers_region(const std::string& name, double lo, double hi, double height) {
    return fmt::format(
        "[[field]]\nname = \"{0}\"\nformula = \"max({1} - z, z - {2})\"\n"
        "[[region]]\nfield = \"{0}\"\nmake = \"layers\"\nlayer_height = {3}\n",
        name, lo - 5, hi - 5, height);
}

}  // namespace

TEST_CASE("regions have layers of their own", "[layers][regions]") {
    const std::string ten = ten_high + "[layers]\nheight = 0.2\n";
    CHECK(plan_of(ten + layers_region("band", 4, 6, 0.1)) == LayerPlan({{20, 0.2}, {20, 0.1}, {20, 0.2}}));
    // Beyond the part a region has none, and the later of two wins.
    CHECK(plan_of(ten + layers_region("band", 6, 60, 0.1)) == LayerPlan({{30, 0.2}, {40, 0.1}}));
    CHECK(plan_of(ten + layers_region("band", 2, 8, 0.1) + layers_region("in", 4, 6, 0.25)) ==
          LayerPlan({{10, 0.2}, {20, 0.1}, {8, 0.25}, {20, 0.1}, {10, 0.2}}));
    CHECK(plan_of(ten + layers_region("in", 4, 6, 0.25) + layers_region("band", 2, 8, 0.1)) ==
          LayerPlan({{10, 0.2}, {60, 0.1}, {10, 0.2}}));
    CHECK(plan_of(ten + layers_region("away", 20, 30, 0.1)) == LayerPlan(50, 0.2));
    // A list of heights holds where no region does; a first layer everywhere.
    CHECK(plan_of(ten + "heights = [[5, 0.25]]\nfirst = 0.4\n" + layers_region("band", 4, 8, 0.1)) ==
          LayerPlan({{1, 0.4}, {18, 0.2}, {40, 0.1}, {8, 0.25}}));
    // Only what a region holds of the part counts: a ball has none above its top.
    const std::string ball = "[part]\nshape = \"sphere\"\nradius = 5\n[layers]\nheight = 0.2\n";
    CHECK(plan_of(ball + layers_region("top", 9, 14, 0.1)) == LayerPlan({{45, 0.2}, {10, 0.1}}));
    // Turned, regions stay where they are on the part.
    CHECK(plan_of("[part]\nshape = \"box\"\nsize = [4, 4, 10]\nturn = [180, 0, 0]\n[layers]\nheight = 0.2\n" +
                  layers_region("band", 0, 2, 0.1)) == LayerPlan({{40, 0.2}, {20, 0.1}}));
}

TEST_CASE("layers that adapt are at most as high as a region says", "[layers][regions]") {
    const std::string adapting = ten_high + "[layers]\nheight = 0.2\ncusp = 0.1\nmost = 0.4\n";
    CHECK(plan_of(adapting) == LayerPlan(25, 0.4));
    const LayerPlan plan = plan_of(adapting + layers_region("band", 4, 6, 0.05));
    for (int i = 0; i < plan.count(); ++i) {
        INFO(plan.bottom(i) << " to " << plan.top(i));
        const bool is_in = plan.bottom(i) > 4 - 1e-3 && plan.bottom(i) < 6 - 1e-3;
        CHECK(plan.height(i) <= (is_in ? 0.05 : 0.4) + 1e-9);
        if (is_in) CHECK(plan.height(i) > 0.04);
    }
    CHECK(plan.count() >= 10 + 40 + 10);
    CHECK(plan.count() <= 10 + 41 + 10);
}

TEST_CASE("a region of layers says what it lacks", "[layers][regions]") {
    const std::string field = "[[field]]\nname = \"a\"\nformula = \"z - 1\"\n";
    CHECK(mentions(complaint_about(ten_high + field + "[[region]]\nfield = \"a\"\nmake = \"layers\"\n"),
                   "layer_height"));
    CHECK(mentions(complaint_about(ten_high + field +
                                   "[[region]]\nfield = \"a\"\nmake = \"empty\"\nlayer_height = 0.1\n"),
                   "layer_height"));
}

TEST_CASE("heights that make no sense are refused", "[layers]") {
    const auto says = [](const std::string& keys, const std::string& words) {
        INFO(keys);
        CHECK(mentions(complaint_about(ten_high + "[layers]\n" + keys), words));
    };
    says("heights = [[2, 0.1], [1, 0.2]]\n", "layers.heights: 1 mm over the bed does not come after 2 mm");
    says("heights = [[2, 0]]\n", "layers.heights: layers of 0 mm; accepted: 0.001 to 10 mm");
    says("heights = [[2, 0.1]]\ncusp = 0.1\n", "cannot be combined with layers.cusp");
    says("least = 0.1\n", "layers.least: has no effect without layers.cusp");
    says("most = 0.1\n", "layers.most: has no effect without layers.cusp");
    says("cusp = 0.1\nheight = 0.1\nleast = 0.2\n", "layers of 0.2 mm at least and 0.15 mm at most");
    says("height = 0.2\nheights = [[0, 0.2], [5, 0.001]]\ncusp = 0\n", "layers.cusp");
}

}  // namespace plan_layers_test
