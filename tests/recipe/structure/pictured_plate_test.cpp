// Plates that look like a picture: bounds, one piece, likeness, threads, plans, and what cannot be shown.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "engine/base/error.h"
#include "procedural/optimization/density_shape.h"
#include "procedural/optimization/shared_solves.h"
#include "procedural/volume/density_bricks.h"
#include "recipe/build/build_job.h"
#include "recipe/structure/structure_report.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace pictured_plate_test {

using namespace lamella;

namespace {

const std::string plate = "[part]\nshape = \"box\"\nsize = [96, 48, 4]\n[material]\nname = \"pla\"\n";
const std::string cantilever = plate +
                               "[[load]]\nbox = [[48, -2, -3], [48, 2, 3]]\nforce = [0, -10, 0]\n"
                               "[[anchor]]\nface = \"-x\"\n";
const std::string half_beam = plate +
                              "[[load]]\nbox = [[-48, 24, -3], [-48, 24, 3]]\nforce = [0, -10, 0]\n"
                              "[[anchor]]\nface = \"-x\"\nfix = \"x\"\n"
                              "[[anchor]]\nbox = [[46, -24, -3], [48, -24, 3]]\nfix = \"y\"\n";
const std::string bridge = plate +
                           "[[load]]\nface = \"+y\"\nforce = [0, -10, 0]\n"
                           "[[anchor]]\nbox = [[-48, -24, -3], [-44, -24, 3]]\n"
                           "[[anchor]]\nbox = [[44, -24, -3], [48, -24, 3]]\n";

std::string like(const std::string& picture, const std::string& more = "") {
    return "[optimize]\nkind = \"appearance\"\nelements = 96\nlevels = 2\niterations = 20\nneighbourhood = "
           "10\n"
           "compliance = 1.3\nimage = \"" LAMELLA_SOURCE_DIR "/examples/inputs/" +
           picture + ".png\"\nimage_size = 48\n" + more;
}

/// Number of pieces above 0.5, by faces.
int pieces(const OptimizedPart& part) {
    const std::vector<float> densities = part.densities->dense();
    const VoxelIndex& size = part.densities->size();
    const auto numbers = pieces_by_faces({size[0], size[1], size[2]}, [&](std::size_t e) {
        return part.use[e] != ElementUse::outside && densities[e] > 0.5F;
    });
    return *std::max_element(numbers.begin(), numbers.end()) + 1;
}

OptimizedPart made(const std::string& text, int threads = 0) {
    OptimizeOptions options;
    options.threads = threads;
    return *build_job(recipe_of(text), options).optimized;
}

/// Cancels a search after a number of solves.
class CancelAfter : public SharedSolves {
  public:
    explicit CancelAfter(int solves) : left_(solves) {}
    bool is_solved_here(std::size_t) const override { return true; }
    void give(const SolvedCase&) override {
        if (left_-- == 0) token_.cancel();
    }
    SolvedCase take(std::size_t, std::uint64_t) override { throw FaultError("there is no other process"); }
    const CancelToken& token() const { return token_; }

  private:
    int left_;
    CancelToken token_;
};

std::size_t files_in(const Folder& folder, const std::string& ending) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        count += entry.path().extension() == ending ? 1 : 0;
    return count;
}

std::string told(const std::string& text) {
    try {
        made(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a plate like a picture is stiff enough, light enough, one piece, and like it",
          "[optimization][slow]") {
    for (const std::string& load : {cantilever, half_beam, bridge}) {
        for (const std::string picture : {"spots", "blobs", "bricks"}) {
            CAPTURE(load, picture);
            const OptimizedPart part = made(load + like(picture, "volume = 0.55\n"));
            const StructureReport& report = *part.report;
            CHECK(report.densities_compliance <= 1.3 * 1.01 * report.least_compliance);
            CHECK(report.compliance <= 1.3 * 1.01 * report.least_compliance);
            CHECK(report.volume <= 0.55 * 1.005);
            CHECK(pieces(part) == 1);
            CHECK(report.appearance < 0.9 * report.stiffest_appearance);
            CHECK(report.appearance > 0);
            CHECK(report.stiffest_appearance > 0);
        }
    }
}

TEST_CASE("the more compliance is allowed, the more a plate is like its picture", "[optimization]") {
    double former = 0;
    for (const char* compliance : {"1.5", "1.1"}) {
        std::string text = cantilever + like("spots", "volume = 0.6\n");
        text.replace(text.find("compliance = 1.3"), 16, std::string("compliance = ") + compliance);
        const OptimizedPart part = made(text);
        CHECK(part.report->appearance > former);
        former = part.report->appearance;
    }
}

TEST_CASE("a plate like a picture is the same on any number of threads", "[optimization]") {
    const std::string text = half_beam + like("spots", "volume = 0.5\nsymmetry = \"x\"\n");
    const OptimizedPart one = made(text, 1), two = made(text, 2);
    const DensityBricks& densities = *one.densities;
    CHECK(densities.dense() == two.densities->dense());
    const VoxelIndex& size = densities.size();
    for (std::size_t y = 0; y < size[1]; ++y) {
        for (std::size_t x = 0; x < size[0] / 2; ++x)
            CHECK(densities.at(x, y, 0) == Approx(densities.at(size[0] - 1 - x, y, 0)).margin(1e-9));
    }
}

TEST_CASE("a plate may bear its own weight, and has the least volume that is asked for", "[optimization]") {
    const std::string held = plate +
                             "[[anchor]]\nbox = [[-48, -24, -3], [-44, -24, 3]]\n"
                             "[[anchor]]\nbox = [[44, -24, -3], [48, -24, 3]]\n";
    const OptimizedPart part =
        made(held + like("spots", "gravity = [0, -9.81, 0]\nvolume = 0.5\nvolume_min = 0.4\n"));
    CHECK(part.report->volume >= 0.4 * 0.995);
    CHECK(part.report->volume <= 0.5 * 1.005);
    CHECK(part.report->densities_compliance <= 1.3 * 1.01 * part.report->least_compliance);
}

TEST_CASE("a picture that a plate cannot show is told", "[optimization]") {
    std::string coarse = cantilever + like("spots");
    coarse.replace(coarse.find("levels = 2"), 10, "levels = 4");
    CHECK(mentions(told(coarse),
                   "windows of 10 x 10 elements do not fit the plate, 12 x 6 on the coarsest of 4"));
    std::string small = cantilever + like("spots");
    small.replace(small.find("image_size = 48"), 15, "image_size = 15");
    CHECK(mentions(told(small),
                   "do not fit the picture, 7 x 7 on the coarsest of 2 grids; accepted: smaller "
                   "windows, fewer levels, more elements, or a larger image_size"));
    CHECK(mentions(told(cantilever + like("no_such")), "no_such.png"));
    const OptimizedPart part = made(cantilever + like("spots", "volume = 0.3\nthreshold = 0.01\n"));
    REQUIRE(part.report->notes.size() == 1);
    CHECK(mentions(part.report->notes.front(), "% solid and the plate at most 30 %"));
}

TEST_CASE("a plate like a picture is kept as a plan", "[optimization]") {
    const Folder folder;
    OptimizeOptions options;
    options.plans = folder.path();
    const Recipe recipe = recipe_of(half_beam + like("spots", "volume = 0.5\n"));
    const BuiltJob first = build_job(recipe, options), second = build_job(recipe, options);
    CHECK(first.optimized->report);
    CHECK_FALSE(second.optimized->report);
    CHECK(first.optimized->densities->dense() == second.optimized->densities->dense());
}

TEST_CASE("a search for a plate like a picture that is stopped shows it, and goes on to the same result",
          "[optimization]") {
    std::string text = half_beam + like("spots", "volume = 0.5\nsharpness = 2\n");
    text.replace(text.find("iterations = 20"), 15, "iterations = 8");
    const Recipe recipe = recipe_of(text);
    const OptimizedPart whole = made(text);
    // Levels of 8 and 4 steps, each after as many for its stiffest plate and an analysis, then 2 times 10.
    struct Stop {
        int solves;
        std::size_t least, most;  ///< steps until then
    };
    for (const Stop stop :
         {Stop{9, 0, 0}, Stop{12, 1, 2}, Stop{17, 5, 8}, Stop{21, 8, 8}, Stop{26, 8, 11}, Stop{38, 13, 31}}) {
        CAPTURE(stop.solves);
        const Folder folder;
        CancelAfter cancel(stop.solves);
        OptimizeOptions options;
        options.plans = folder.path();
        options.shared = &cancel;
        options.cancel = &cancel.token();
        const OptimizedPart part = *build_job(recipe, options).optimized;
        const StructureReport& report = *part.report;
        CAPTURE(report.history.size(), report.notes);
        CHECK(report.history.size() >= stop.least);
        CHECK(report.history.size() <= stop.most);
        CHECK(part.densities->size() == whole.densities->size());
        CHECK(std::ranges::count_if(report.notes, [](const std::string& note) {
                  return mentions(note, "the search was stopped after ") &&
                         mentions(note, "; --resume goes on with it");
              }) == 1);
        CHECK(pieces(part) == 1);
        CHECK(report.compliance <= 2 * 1.3 * report.least_compliance);
        CHECK(report.volume <= 0.5 * 1.005);
        CHECK(report.volume > 0.45);
        CHECK(report.least_compliance == Approx(whole.report->least_compliance).epsilon(0.2));
        CHECK(report.stiffest_appearance == Approx(whole.report->stiffest_appearance).epsilon(0.3));
        CHECK(report.appearance <= report.stiffest_appearance);
        CHECK(report.densities_compliance >= report.least_compliance);
        CHECK(report.greyness > 0);
        CHECK(files_in(folder, ".search") == 1);
        CHECK(files_in(folder, ".bricks") == 0);

        OptimizeOptions again;
        again.plans = folder.path();
        again.resume = again.anew = true;
        const OptimizedPart resumed = *build_job(recipe, again).optimized;
        CHECK(resumed.densities->dense() == whole.densities->dense());
        CHECK(resumed.report->history.size() == whole.report->history.size());
        CHECK(resumed.report->compliance == whole.report->compliance);
        CHECK(resumed.report->appearance == whole.report->appearance);
        CHECK(resumed.report->notes == whole.report->notes);
        CHECK(files_in(folder, ".search") == 0);
        CHECK(files_in(folder, ".bricks") == 1);
        CHECK_THROWS_AS(build_job(recipe, again), InputError);
    }
}

TEST_CASE("a search that is stopped before its first plate ends without one", "[optimization]") {
    const Folder folder;
    CancelAfter cancel(4);
    OptimizeOptions options;
    options.plans = folder.path();
    options.shared = &cancel;
    options.cancel = &cancel.token();
    CHECK_THROWS_AS(build_job(recipe_of(half_beam + like("spots")), options), Interrupted);
    CHECK(files_in(folder, ".search") == 0);
}

TEST_CASE("a search that is cancelled when it has just ended is kept", "[optimization]") {
    std::string text = half_beam + like("spots", "volume = 0.5\nsharpness = 1\n");
    text.replace(text.find("iterations = 20"), 15, "iterations = 4");
    const OptimizedPart whole = made(text);
    const Folder folder;
    CancelToken cancel;
    OptimizeOptions options;
    options.plans = folder.path();
    options.cancel = &cancel;
    options.on_iteration = [&](const OptimizationStep& step, int) {
        if (step.index == static_cast<int>(whole.report->history.size())) cancel.cancel();
    };
    const OptimizedPart part = *build_job(recipe_of(text), options).optimized;
    CHECK(part.densities->dense() == whole.densities->dense());
    CHECK(part.report->compliance == whole.report->compliance);
    CHECK(files_in(folder, ".search") == 1);
    OptimizeOptions again;
    again.plans = folder.path();
    again.resume = again.anew = true;
    CHECK(build_job(recipe_of(text), again).optimized->densities->dense() == whole.densities->dense());
}

}  // namespace pictured_plate_test
