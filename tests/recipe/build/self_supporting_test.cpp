// Self-supporting skins: no islands but those of the closed body, whatever the height of layers.
#include <catch2/catch.hpp>

#include "recipe/build/build_job.h"
#include "recipe/build/finish_job.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace self_supporting_test {

using namespace lamella;

namespace {

struct Found {
    std::size_t islands, pieces;  ///< pieces besides the first
    double volume;                ///< mm^3
};

Found found(const std::string& text, double layer_height, const Folder& plans) {
    Recipe recipe = recipe_of(text);
    recipe.layers.height = layer_height;
    OptimizeOptions options;
    options.plans = plans.path();
    BuiltJob built = build_job(recipe, options);
    finish_job(recipe, built, {.plans = {}});
    PrintCheckOptions checked;
    checked.limits.verdicts[static_cast<std::size_t>(Check::islands)] = Severity::fail;
    checked.limits.verdicts[static_cast<std::size_t>(Check::connectivity)] = Severity::fail;
    checked.limits.piece = 0.001;
    checked.limits.island = 0.16;  // a square of the nozzle, as filament has by default
    checked.pitch = 0.08;
    PrintCheck check(built.job, checked);
    survey_layers(built.job, check, {});
    const CheckReport& report = check.report();
    return {report.results[1].count, report.results[0].count, report.volume};
}

}  // namespace

TEST_CASE("a self-supporting skin has no islands but its body's, in layers of any height",
          "[slow][pattern]") {
    const Folder plans;
    const std::string body = "[part]\nshape = \"torus\"\nradius = 8\ntube = 4\n[skin]\nthickness = 1\n",
                      pattern = "pattern = \"by-example\"\nimage = \"" LAMELLA_SOURCE_DIR
                                "/examples/inputs/bricks.png\"\nimage_size = 24\nstrut = 0.8\n";
    const std::string held = body + pattern + "self_supporting = true\n";
    CHECK(found(body + pattern, 0.1, plans).islands > 10);
    for (const double height : {0.025, 0.05, 0.07, 0.1, 0.2, 0.3}) {
        CAPTURE(height);
        const Found skin = found(held, height, plans);
        CHECK(skin.islands == found(body, height, plans).islands);
        CHECK(skin.pieces == 0);
        // What is trimmed is little: compared without struts, which would hide it.
        const std::string unheld = held + "[repair]\nhold = 0\n";
        CHECK(found(unheld, height, plans).volume >
              0.99 * found(unheld + "trim = 0\n", height, plans).volume);
    }
}

}  // namespace self_supporting_test
