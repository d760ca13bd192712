// Parts that [optimize] makes: volumes, symmetry, prescribed regions, foams, plans, and what cannot be
// solved.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "procedural/volume/density_bricks.h"
#include "recipe/structure/analyse_part.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace optimize_part_test {

using namespace lamella;

namespace {

const std::string material = "[material]\nyoung = 2000\npoisson = 0.3\ndensity = 1.2\n";
/// A cantilever of 40 x 20 x 4 mm, held on the left, with a load in the middle of the right side.
const std::string plate =
    "[part]\nshape = \"box\"\nsize = [40, 20, 4]\n" + material +
    "[[load]]\nbox = [[19.9, -0.1, -3], [20.1, 0.1, 3]]\nforce = [0, -10, 0]\n[[anchor]]\nface = \"-x\"\n";
const std::string in_plane = "[optimize]\ndimensions = 2\nelements = 40\niterations = 40\n";
const std::string block = "[part]\nshape = \"box\"\nsize = [24, 12, 12]\n" + material +
                          "[[load]]\nface = \"+x\"\nforce = [0, 0, -10]\n[[anchor]]\nface = \"-x\"\n";
const std::string in_space = "[optimize]\nelements = 24\niterations = 25\nsharpness = 4\n";
const std::string in_black_and_white = "[optimize]\nelements = 24\niterations = 60\n";

BuiltJob built(const std::string& text) { return build_job(recipe_of(text)); }

/// The solid area of a section at a height, mm^2, by rows 0.02 mm apart.
double area(const Field& field, double z, const Box& box) {
    constexpr double pitch = 0.02;
    RowBand band;
    band.along_origin = box.lo.x;
    band.across_origin = box.lo.y;
    band.along_pitch = band.across_pitch = pitch;
    band.count = static_cast<int>(box.size().y / pitch);
    band.hi = static_cast<int>(box.size().x / pitch);
    SliceContext context;
    Scratch scratch;
    const auto rows = scratch.rows();
    context.slice(field, z).runs(band, scratch, *rows);
    return static_cast<double>(rows->total_length()) / run_unit * pitch * pitch;
}

StructureReport analysed(const std::string& text, AnalysisModel model = AnalysisModel::automatic) {
    const Recipe recipe = recipe_of(text);
    AnalysisOptions options;
    options.model = model;
    return analyse_part(recipe, build_job(recipe), options);
}

}  // namespace

TEST_CASE("an optimised plate fills the asked share of the part, and every layer is the same",
          "[optimization]") {
    for (const double volume : {0.3, 0.5}) {
        const BuiltJob job = built(plate + in_plane + "volume = " + std::to_string(volume) + "\n");
        const Box box = job.job.bounds;
        CHECK(area(*job.job.part, 0, box) == Approx(volume * 40 * 20).epsilon(0.005));
        CHECK(area(*job.job.part, -1.9, box) == area(*job.job.part, 1.9, box));
        const StructureReport& report = *job.optimized->report;
        CHECK(report.volume == Approx(volume).epsilon(0.005));
        CHECK(report.compliance > report.full_compliance);
        CHECK(report.compliance < 4 * report.full_compliance);
        CHECK(report.greyness < 0.1);
    }
}

TEST_CASE("an optimised plate is stiffer than one that is thinner all over by as much", "[optimization]") {
    const StructureReport report = *built(plate + in_plane + "volume = 0.4\n").optimized->report;
    // A plate of 40 % of the thickness has 1 / 0.4 times the compliance.
    CHECK(report.compliance < 0.8 * report.full_compliance / 0.4);
}

TEST_CASE("symmetry and prescribed regions of an optimised part are kept", "[optimization]") {
    const std::string regions =
        "[[field]]\nname = \"pad\"\nkind = \"box\"\nsize = [6, 6, 10]\nat = [0, 7, 0]\n"
        "[[field]]\nname = \"hole\"\nkind = \"cylinder\"\nradius = 3\nheight = 10\nat = [10, 0, 0]\n"
        "[[region]]\nfield = \"pad\"\nmake = \"solid\"\n[[region]]\nfield = \"hole\"\nmake = \"empty\"\n";
    const BuiltJob job = built(plate + regions + in_plane + "volume = 0.4\nsymmetry = \"y\"\n");
    const OptimizedPart& part = *job.optimized;
    const VoxelIndex& size = part.densities->size();
    REQUIRE(size == VoxelIndex{120, 60, 1});
    // The middle of an element's three parts has its density; those beside it see the pad, which is on one
    // side.
    for (std::size_t y = 1; y < size[1]; y += 3) {
        for (std::size_t x = 1; x < size[0]; x += 3) {
            const std::size_t mirrored = size[1] - 1 - y;
            const bool is_free = part.use[y * size[0] + x] == ElementUse::free &&
                                 part.use[mirrored * size[0] + x] == ElementUse::free;
            if (is_free) CHECK(part.densities->at(x, y, 0) == Approx(part.densities->at(x, mirrored, 0)));
        }
    }
    CHECK(job.job.part->value({0, 7, 0}) < 0);
    CHECK(job.job.part->value({10, 0, 0}) > 0);
    CHECK(job.job.part->value({11.9, 0, 0}) > 0);
}

TEST_CASE("an optimised block is the same bytes on one thread and two", "[optimization]") {
    const Recipe recipe = recipe_of(block + in_space + "volume = 0.3\n");
    OptimizeOptions one, two;
    one.threads = 1;
    two.threads = 2;
    const BuiltJob a = build_job(recipe, one), b = build_job(recipe, two);
    CHECK(a.optimized->densities->dense() == b.optimized->densities->dense());
    CHECK(a.optimized->report->volume == Approx(0.3).epsilon(0.005));
}

TEST_CASE("a kept result is the shape that was optimised", "[optimization]") {
    const Folder folder;
    const Recipe recipe = recipe_of(block + in_space + "volume = 0.3\n");
    OptimizeOptions options;
    options.plans = folder / "plans";
    int iterations = 0;
    options.on_iteration = [&](const TopologyIteration&, int) { ++iterations; };
    const BuiltJob first = build_job(recipe, options);
    REQUIRE(iterations > 0);
    iterations = 0;
    const BuiltJob second = build_job(recipe, options);
    CHECK(iterations == 0);
    CHECK(second.optimized->report == nullptr);
    CHECK(second.optimized->densities->dense() == first.optimized->densities->dense());
    CHECK(second.optimized->densities->box().lo == first.optimized->densities->box().lo);
    CHECK(second.optimized->densities->box().hi == first.optimized->densities->box().hi);
    for (const double z : {-5.0, 0.0, 5.0})
        CHECK(area(*first.job.part, z, first.job.bounds) == area(*second.job.part, z, second.job.bounds));
    // A damaged file is no result.
    for (const auto& file : std::filesystem::directory_iterator(folder / "plans"))
        std::filesystem::resize_file(file.path(), 200);
    build_job(recipe, options);
    CHECK(iterations > 0);
    // Another layer height is the same problem, another load is not.
    iterations = 0;
    build_job(recipe_of(block + in_space + "volume = 0.3\n[layers]\nheight = 0.2\n"), options);
    CHECK(iterations == 0);
}

TEST_CASE("a driven foam has the asked mean density, and beams within the printer's limits",
          "[optimization]") {
    const std::string foam = "[foam]\ncell = 2\nbeam = 0.2\nbeam_min = 0.15\nbeam_max = 0.4\n";
    const BuiltJob job =
        built(block + foam + "[optimize]\nresult = \"beam\"\nelements = 24\nvolume = 0.15\n");
    const StructureReport& report = *job.optimized->report;
    CHECK(report.volume == Approx(0.15).epsilon(0.005));
    double least = 1, most = 0;
    for (const double x : {-11.0, -6.0, 0.0, 6.0, 11.0}) {
        for (const double z : {-5.5, 0.0, 5.5}) {
            const double beam = job.foam->member.made->at({x, 0, z});
            least = std::min(least, beam);
            most = std::max(most, beam);
        }
    }
    CHECK(least >= 0.15);
    CHECK(most <= 0.4);
    CHECK(most > 1.3 * least);
    // What the report predicts is what the analysis of the built foam's law finds.
    const StructureReport again = analysed(
        block + foam + "[optimize]\nresult = \"beam\"\nelements = 24\nvolume = 0.15\n", AnalysisModel::law);
    CHECK(again.compliance == Approx(report.compliance).epsilon(0.1));
}

TEST_CASE("a skin on an optimised shape is as thick as asked, and the rest is foam", "[optimization]") {
    constexpr double thickness = 0.6;
    const BuiltJob job =
        built(block + in_space + "volume = 0.6\n[skin]\nthickness = 0.6\n[foam]\ncell = 3\nbeam = 0.2\n");
    const OptimizedPart& part = *job.optimized;
    CHECK(mentions(part.report->notes.back(), "compliance is that of the solid shape"));
    const auto is_solid = [&](dvec3 p) {
        return part.density->at(p) > 0.5 && Box{{-12, -6, -6}, {12, 6, 6}}.contains(p);
    };
    const auto is_clear = [&](dvec3 p, double distance) {
        for (int k = 0; k < 300; ++k) {
            const double z = 1 - (2 * k + 1) / 300.0, r = std::sqrt(1 - z * z), turn = 2.399963 * k;
            const dvec3 way(r * std::cos(turn), r * std::sin(turn), z);
            for (const double share : {0.25, 0.5, 0.75, 1.0}) {
                if (!is_solid(p + way * (share * distance))) return false;
            }
        }
        return true;
    };
    int skin = 0, deep = 0;
    for (double x = -11.7; x < 12; x += 0.9) {
        for (double y = -5.6; y < 6; y += 0.8) {
            for (double z = -5.7; z < 6; z += 0.7) {
                const dvec3 p(x, y, z);
                const double density = part.density->at(p);
                if (density < 0.45) CHECK(job.job.part->value(p) > 0);
                if (density < 0.55) continue;
                if (!is_clear(p, 0.75 * thickness)) {
                    // The mesh of the surface is right to a tenth of an element.
                    CHECK(job.job.part->value(p) < 0.1);
                    ++skin;
                } else if (is_clear(p, 1.25 * thickness)) {
                    CHECK((job.job.part->value(p) < 0) == (job.foam->field->value(p) < 0));
                    ++deep;
                }
            }
        }
    }
    CHECK(skin > 500);
    CHECK(deep > 100);
}

TEST_CASE("the depth in an optimised shape is the distance to its surface", "[optimization]") {
    const BuiltJob job = built(block + in_space + "volume = 0.4\n[foam]\ncell = \"2 + d\"\nbeam = 0.2\n");
    const GradingPtr& cell = job.foam->cell.asked;
    double most = 0;
    for (double x = -11.7; x < 12; x += 0.9) {
        for (double z = -5.7; z < 6; z += 0.7) most = std::max(most, cell->at({x, 0.1, z}) - 2);
    }
    CHECK(most > 1);
    CHECK(most < 3);
    CHECK(cell->at({-11.8, -4, 5.5}) - 2 == Approx(0.2).margin(0.05));
}

TEST_CASE("the lightest part keeps its compliance, and is the stiffest of its volume", "[optimization]") {
    std::string arm = block;  // loaded along an edge
    arm.replace(arm.find("face = \"+x\""), 11, "box = [[12, -6, -6], [12, 6, -6]]");
    for (const std::string& part : {plate + in_plane, arm + in_black_and_white}) {
        const StructureReport light =
            *built(part + "kind = \"lightness\"\ncompliance = 2\n").optimized->report;
        CHECK(light.compliance == Approx(2 * light.full_compliance).epsilon(0.01));
        CHECK(light.volume < 0.7);
        CHECK(light.volume > 0.2);
        CHECK(light.notes.empty());
        const StructureReport stiff =
            *built(part + "volume = " + std::to_string(light.volume) + "\n").optimized->report;
        CHECK(stiff.compliance == Approx(light.compliance).epsilon(0.03));
    }
}

TEST_CASE("the lightest foam keeps its compliance", "[optimization]") {
    const std::string foam = "[foam]\ncell = 2\nbeam = 0.2\nbeam_min = 0.15\nbeam_max = 0.4\n";
    const StructureReport light =
        *built(block + foam +
               "[optimize]\nresult = \"beam\"\nelements = 24\nkind = \"lightness\"\ncompliance = 20\n")
             .optimized->report;
    CHECK(light.compliance == Approx(20 * light.full_compliance).epsilon(0.01));
    CHECK(light.volume < 0.3);
}

TEST_CASE("the lightest foam may lie in a skin, which counts as solid", "[optimization]") {
    const std::string foam =
        "[foam]\ncell = 2\nbeam = 0.2\nbeam_min = 0.15\nbeam_max = 0.4\n[skin]\nthickness = 1\n";
    const StructureReport light =
        *built(block + foam +
               "[optimize]\nresult = \"beam\"\nelements = 24\nkind = \"lightness\"\ncompliance = 2.2\n")
             .optimized->report;
    CHECK(light.compliance == Approx(2.2 * light.full_compliance).epsilon(0.01));
    CHECK(light.notes.empty());
}

TEST_CASE("the lightest part has the least sizes that are asked for, and keeps its compliance",
          "[optimization]") {
    const StructureReport light =
        *built(plate +
               "[optimize]\ndimensions = 2\nelements = 80\nkind = \"lightness\"\ncompliance = "
               "2\nmember = 2\n")
             .optimized->report;
    CHECK(light.compliance < 2.02 * light.full_compliance);
    CHECK(light.volume < 0.7);
}

TEST_CASE("bare foam is told of unless its cut cells are known or covered", "[optimization]") {
    const auto notes = [&](const std::string& kind, const std::string& cover) {
        return built(block + "[foam]\ncell = 2\nbeam = 0.2\nbeam_min = 0.15\nbeam_max = 0.4\nkind = \"" +
                     kind + "\"\n" + cover +
                     "[optimize]\nresult = \"beam\"\nelements = 24\nvolume = 0.15\niterations = 2\n")
            .optimized->report->notes;
    };
    REQUIRE(notes("kelvin", "").size() == 1);
    CHECK(mentions(notes("kelvin", "").front(), "the foam is bare"));
    CHECK(notes("kelvin", "[frame]\nbeam = 0.3\n").empty());
    CHECK(notes("kelvin", "[skin]\nthickness = 0.5\n").empty());
    CHECK(notes("voronoi", "").empty());
}

TEST_CASE("a compliance that the largest volume does not reach is told", "[optimization]") {
    const StructureReport report =
        *built(plate + in_plane + "kind = \"lightness\"\ncompliance = 1.5\nvolume = 0.3\n").optimized->report;
    CHECK(report.compliance > 1.5 * report.full_compliance);
    CHECK(report.volume == Approx(0.3).epsilon(0.005));
    REQUIRE(report.notes.size() == 1);
    CHECK(mentions(report.notes.front(), "the compliance is above its bound"));
}

TEST_CASE("a bar that is analysed stretches as the textbook says", "[optimization]") {
    // F L / (E A) with a pull of 100 N on 20 x 4 mm over 40 mm, and C = F u.
    const std::string bar =
        "[part]\nshape = \"box\"\nsize = [40, 20, 4]\n[material]\nyoung = 2000\npoisson = 0\n"
        "[[load]]\nface = \"+x\"\nforce = [100, 0, 0]\n[[anchor]]\nface = \"-x\"\n";
    const double stretch = 100.0 * 40 / (2000 * 20 * 4);
    for (const char* dimensions : {"", "--"}) {
        Recipe recipe = recipe_of(bar);
        OptimizeRecipe elements;
        elements.dimensions = *dimensions == 0 ? 3 : 2;
        elements.elements = 40;
        recipe.optimize = elements;
        const BuiltJob job = build_job(recipe_of(bar));
        const StructureReport report = analyse_part(recipe, job, {});
        REQUIRE(report.cases.size() == 1);
        CHECK(report.cases[0].largest_displacement == Approx(stretch).epsilon(1e-4));
        CHECK(report.compliance == Approx(100 * stretch).epsilon(1e-4));
        CHECK(report.cases[0].peak_stress == Approx(100.0 / (20 * 4)).epsilon(1e-3));
    }
}

TEST_CASE("a bar whose height no cube divides bends as the textbook says", "[optimization]") {
    // Timoshenko: F L^3 / (3 E I) + F L / (k G A). The bar is 6.4 elements of the longest side high.
    const double length = 64, width = 5.3, height = 6.4, young = 2000, force = 3;
    const std::string bar =
        "[part]\nshape = \"box\"\nsize = [64, 5.3, 6.4]\n[material]\nyoung = 2000\npoisson = 0\n"
        "[[load]]\nface = \"+x\"\nforce = [0, 0, -3]\n[[anchor]]\nface = \"-x\"\n";
    const double inertia = width * std::pow(height, 3) / 12;
    const double sunk = force * std::pow(length, 3) / (3 * young * inertia) +
                        force * length / (5.0 / 6 * young / 2 * width * height);
    AnalysisOptions options;
    options.elements = 64;
    const Recipe recipe = recipe_of(bar);
    const StructureReport report = analyse_part(recipe, build_job(recipe), options);
    CHECK(report.size == glm::ivec3(64, 5, 6));
    CHECK(report.element.z == Approx(6.4 / 6));
    CHECK(report.body_volume == Approx(length * width * height));
    CHECK(report.compliance == Approx(force * sunk).epsilon(0.02));
    // The stress of the outermost elements' middles, half an element from the wall.
    const double arm = height / 2 * 5 / 6;
    CHECK(report.cases[0].peak_stress == Approx(force * (length - 0.5) * arm / inertia).epsilon(0.02));
    // Turned, the same bar bends the same way.
    std::string turned = bar;
    turned.replace(turned.find("[64, 5.3, 6.4]"), 14, "[5.3, 6.4, 64]");
    turned.replace(turned.find("+x"), 2, "+z");
    turned.replace(turned.find("[0, 0, -3]"), 10, "[0, -3, 0]");
    turned.replace(turned.find("-x"), 2, "-z");
    const Recipe other = recipe_of(turned);
    CHECK(analyse_part(other, build_job(other), options).compliance ==
          Approx(report.compliance).epsilon(1e-4));
}

TEST_CASE("a load on a whole face acts on material everywhere", "[optimization]") {
    const BuiltJob job = built(block + in_black_and_white + "volume = 0.3\n");
    const StructureReport& report = *job.optimized->report;
    // Void under a part of the load would make the shape many times softer than its densities.
    CHECK(report.greyness < 0.02);
    CHECK(report.compliance == Approx(report.densities_compliance).epsilon(0.05));
    CHECK(report.volume == Approx(0.3).epsilon(0.01));
    int voids = 0;
    for (double y = -5.5; y < 6; ++y) {
        for (double z = -5.5; z < 6; ++z) voids += job.optimized->shape->value({11.5, y, z}) > 0;
    }
    CHECK(voids == 0);
    const std::string thin = "volume = 0.04\n";
    CHECK(mentions(complaint_about(block + in_space + thin),
                   "the elements under loads fill 0.0417 of the part"));
}

TEST_CASE("an analysis takes other elements than the search, of the part as it was made", "[optimization]") {
    const Recipe recipe = recipe_of(plate + in_plane + "volume = 0.4\n");
    const BuiltJob job = build_job(recipe);
    AnalysisOptions finer;
    finer.elements = 80;
    const StructureReport report = analyse_part(recipe, job, finer);
    CHECK(report.size == glm::ivec3(80, 40, 1));
    // The shape of the search, twice as fine and cut into whole elements.
    CHECK(report.compliance == Approx(job.optimized->report->compliance).epsilon(0.1));
    CHECK(report.elements == Approx(0.4 * 80 * 40).epsilon(0.02));
}

TEST_CASE("a foam is as stiff by its law as its struts are by elements", "[optimization]") {
    // 6 x 3 x 3 cells in a skin, two elements a beam's radius.
    const std::string coupon =
        "[part]\nshape = \"box\"\nsize = [15, 7.5, 7.5]\n[material]\nname = \"pla\"\n"
        "[foam]\ncell = 2.5\nbeam = 0.3\n[skin]\nthickness = 0.3\n"
        "[[load]]\nface = \"+x\"\nforce = [0, 0, -5]\n[[anchor]]\nface = \"-x\"\n";
    const Recipe recipe = recipe_of(coupon);
    const BuiltJob job = build_job(recipe);
    AnalysisOptions options;
    options.elements = 100;
    options.model = AnalysisModel::law;
    const StructureReport law = analyse_part(recipe, job, options);
    CHECK(law.notes.empty());
    const double by_law = law.compliance;
    options.model = AnalysisModel::elements;
    const double by_elements = analyse_part(recipe, job, options).compliance;
    CAPTURE(by_law, by_elements);
    CHECK(by_elements == Approx(by_law).epsilon(0.1));
}

TEST_CASE("a pressure on a face is its area's force, and a body's weight is its mass's", "[optimization]") {
    const std::string bar =
        "[part]\nshape = \"box\"\nsize = [20, 10, 10]\n[material]\nyoung = 1000\npoisson = 0\ndensity = 2\n"
        "[[anchor]]\nface = \"-x\"\n";
    const StructureReport pushed = analysed(bar + "[[load]]\nface = \"+x\"\npressure = 0.5\n");
    const StructureReport forced = analysed(bar + "[[load]]\nface = \"+x\"\nforce = [-50, 0, 0]\n");
    CHECK(pushed.compliance == Approx(forced.compliance).epsilon(1e-9));
    // A hanging bar: u = rho g L^2 / (2 E), in t/mm^3 and mm/s^2.
    const Recipe recipe = recipe_of(bar + "[optimize]\nelements = 20\ngravity = [9.81, 0, 0]\n");
    const BuiltJob job = build_job(recipe_of(bar));
    const StructureReport hung = analyse_part(recipe, job, {});
    CHECK(hung.cases.at(0).largest_displacement == Approx(2e-9 * 9810 * 20 * 20 / (2 * 1000)).epsilon(0.01));
}

TEST_CASE("a problem without a solution is told", "[optimization]") {
    const auto told = [](const std::string& text) { return complaint_about(text); };
    const std::string body = "[part]\nshape = \"box\"\nsize = [40, 20, 4]\n";
    const std::string load = "[[load]]\nface = \"+x\"\nforce = [0, -10, 0]\n";
    const std::string far = "[[load]]\nbox = [[100, 0, 0], [101, 1, 1]]\nforce = [0, -10, 0]\n";
    const std::string held = "[[anchor]]\nface = \"-x\"\n",
                      point = "[[anchor]]\nbox = [[-21, -1, -3], [-19, 1, 3]]\n";
    CHECK(mentions(told(body + far + held + in_plane), "its place holds nothing of the part"));
    CHECK(mentions(told(body + load + "[[anchor]]\nbox = [[100, 0, 0], [101, 1, 1]]\n" + in_plane),
                   "its place holds nothing of the part"));
    CHECK(mentions(told(body + load + "[[anchor]]\nbox = [[-20.2, -0.2, -3], [-19.8, 0.2, 3]]\n" + in_plane),
                   "1 of the part's 3 rigid motions are free"));
    CHECK(
        mentions(told(body + load + held + "[optimize]\ndimensions = 2\nelement = 0.001\n"), "at most 2048"));
    CHECK(mentions(told(body + load + held + "[optimize]\nelement = 0.02\n"), "GB of memory"));
    CHECK(mentions(
        told(body + load + held + "[material]\nyoung = 1000\ndensity = 1\n" + in_plane + "mass = 50\n"),
        "no less than the whole part's 3.2 g"));
    const std::string apart =
        "[part]\nfield = \"two\"\n[[field]]\nname = \"two\"\nformula = \"max(abs(abs(x) - 8) - 4, abs(y) - "
        "4, abs(z) - 4)\"\n";
    CHECK(mentions(told(apart + load + held + in_space),
                   "a piece of the part is loaded that no [[anchor]] holds"));
}

TEST_CASE("an analysis stops at once when it is cancelled", "[optimization]") {
    const Recipe recipe = recipe_of(block + "[optimize]\nelements = 24\n");
    const BuiltJob job = build_job(recipe_of(block));
    CancelToken cancel;
    cancel.cancel();
    AnalysisOptions options;
    options.cancel = &cancel;
    CHECK_THROWS_AS(analyse_part(recipe, job, options), Interrupted);
}

}  // namespace optimize_part_test
