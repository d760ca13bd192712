// Foams that are optimised with [[region]]s of other cells, beams and walls: densities, sizes and compliance
// by the foam's law, plans, and what is told.
#include "recipe/structure/optimized_foam.h"

#include <catch2/catch.hpp>

#include "procedural/volume/density_bricks.h"
#include "recipe/shipped_texts.h"
#include "recipe/structure/analyse_part.h"
#include "recipe/structure/optimize_part.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"

namespace optimized_foam_test {

using namespace lamella;

namespace {

const std::string block =
    "[part]\nshape = \"box\"\nsize = [24, 12, 12]\n[material]\nyoung = 2000\npoisson = 0.3333333\n"
    "[[load]]\nface = \"+x\"\nforce = [0, 0, -10]\n[[anchor]]\nface = \"-x\"\n";
const std::string foam = "[foam]\ncell = 2\nbeam = 0.2\nbeam_min = 0.15\nbeam_max = 0.4\n";
const std::string drives_beams = "[optimize]\nresult = \"beam\"\nelements = 24\n";
const std::string right_half = "[[field]]\nname = \"half\"\nformula = \"-x\"\n";

std::string region(const std::string& numbers, const std::string& field = "half") {
    return "[[region]]\nfield = \"" + field + "\"\nmake = \"foam\"\n" + numbers;
}

FoamLaw law_named(std::string_view text, const std::string& name) {
    for (const FoamLawTable& table : read_foam_laws(text, "laws")) {
        if (table.foam == name) return FoamLaw(table, law_poisson);
    }
    throw InputError("no such law");
}

FoamLaw voronoi_law() { return law_named(shipped_foam_laws(), "voronoi"); }

StructureReport analysed(const std::string& text, const OptimizeOptions& options = {}) {
    const Recipe recipe = recipe_of(text);
    AnalysisOptions analysis;
    analysis.model = AnalysisModel::law;
    analysis.elements = 24;
    return analyse_part(recipe, build_job(recipe, options), analysis);
}

/// Calls visit(centre, density, use, cell, member) for the elements of the foam as it is built.
template <typename Visit>
void visit_foam(const BuiltJob& job, const Visit& visit) {
    const OptimizedPart& part = *job.optimized;
    const VoxelIndex& size = part.densities->size();
    const std::vector<dvec3> centres = element_centres({size[0], size[1], size[2]}, part.densities->box());
    const std::vector<float> densities = part.densities->dense();
    for (std::size_t i = 0; i < centres.size(); ++i)
        visit(centres[i], static_cast<double>(densities[i]), part.use[i], job.foam->cell.made->at(centres[i]),
              job.foam->member.made->at(centres[i]));
}

/// Checks that the foam as it is built has the densities that were found, by its law.
void check_sizes(const BuiltJob& job) {
    const FoamLaw law = voronoi_law();
    visit_foam(job, [&](dvec3 p, double density, ElementUse, double cell, double member) {
        CAPTURE(p.x, p.y, p.z, cell, member);
        CHECK(law.at(member / cell).density == Approx(density).epsilon(1e-4));
    });
}

}  // namespace

TEST_CASE("halves of a bar with other cells have the densities that their beams can give", "[optimization]") {
    const std::string text =
        block + foam + drives_beams + "volume = 0.15\n" + right_half + region("cell = 4\n");
    const BuiltJob job = build_job(recipe_of(text));
    const FoamLaw law = voronoi_law();
    const Interval fine{law.at(0.15 / 2).density, law.at(0.4 / 2).density},
        coarse{law.at(0.15 / 4).density, law.at(0.4 / 4).density};
    double thickest_on_the_right = 0;
    visit_foam(job, [&](dvec3 p, double density, ElementUse, double cell, double member) {
        CHECK(cell == (p.x > 0 ? 4 : 2));
        // Densities are kept in single precision.
        const Interval& limits = p.x > 0 ? coarse : fine;
        CHECK(density >= limits.lo * (1 - 1e-6));
        CHECK(density <= limits.hi * (1 + 1e-6));
        if (p.x > 0) thickest_on_the_right = std::max(thickest_on_the_right, member);
    });
    CHECK(thickest_on_the_right > 0.35);
    check_sizes(job);
    const StructureReport& report = *job.optimized->report;
    CHECK(report.volume == Approx(0.15).epsilon(0.005));
    // Without the region the search took 3.5 N mm for what is 21.5.
    CHECK(analysed(text).compliance == Approx(report.compliance).epsilon(0.05));
}

TEST_CASE("a region that sets the driven beams has their density, and the search goes on around it",
          "[optimization]") {
    const std::string text =
        block + foam + drives_beams + "volume = 0.28\n" + right_half + region("beam = 0.35\n");
    const BuiltJob job = build_job(recipe_of(text));
    const double kept = voronoi_law().at(0.35 / 2).density;
    Interval searched;
    visit_foam(job, [&](dvec3 p, double density, ElementUse use, double, double member) {
        CHECK((use == ElementUse::kept) == (p.x > 0));
        if (p.x > 0) {
            CHECK(density == Approx(kept));
            CHECK(member == 0.35);
        } else {
            searched = {std::min(searched.lo, member), std::max(searched.hi, member)};
        }
    });
    CHECK(searched.width() > 0.15);
    check_sizes(job);
    CHECK(analysed(text).compliance == Approx(job.optimized->report->compliance).epsilon(0.05));
}

TEST_CASE("numbers of regions may be graded and blend", "[optimization]") {
    const std::string ball = "[[field]]\nname = \"ball\"\nkind = \"sphere\"\nradius = 4\nat = [3, 0, 0]\n";
    for (const std::string& numbers :
         {std::string("cell = \"3 + 0.05*x\"\nblend = 4\n"), std::string("beam = 0.3\nblend = 6\n"),
          std::string("beam = \"0.08*cell + 0.005*y\"\ncell = 3\n")}) {
        CAPTURE(numbers);
        const Recipe recipe = recipe_of(block + foam + drives_beams + "volume = 0.15\niterations = 8\n" +
                                        ball + region(numbers, "ball"));
        OptimizeOptions one, two;
        one.threads = 1;
        two.threads = 2;
        const BuiltJob job = build_job(recipe, one), other = build_job(recipe, two);
        CHECK(job.optimized->report->volume == Approx(0.15).epsilon(0.01));
        CHECK(job.optimized->densities->dense() == other.optimized->densities->dense());
        check_sizes(job);
    }
}

TEST_CASE("cells are driven around a region that sets them", "[optimization]") {
    const std::string cells = "[foam]\ncell = 2\nbeam = 0.2\ncell_min = 1\ncell_max = 4\n";
    const BuiltJob job =
        build_job(recipe_of(block + cells + "[optimize]\nresult = \"cell\"\nelements = 24\nvolume = 0.18\n" +
                            right_half + region("cell = 1.5\n")));
    Interval searched;
    visit_foam(job, [&](dvec3 p, double, ElementUse, double cell, double member) {
        CHECK(member == 0.2);
        if (p.x > 0) {
            CHECK(cell == 1.5);
        } else {
            searched = {std::min(searched.lo, cell), std::max(searched.hi, cell)};
        }
    });
    CHECK(searched.width() > 1);
    check_sizes(job);
}

TEST_CASE("foam that regions set nearly everywhere is as stiff as even foam", "[optimization]") {
    // The last elements have beams between 0.299 and 0.301 mm.
    const std::string narrow = "[foam]\ncell = 3\nbeam = 0.3\nbeam_min = 0.299\nbeam_max = 0.301\n";
    const std::string most = "[[field]]\nname = \"most\"\nformula = \"x - 11\"\n";
    const std::string volume = "volume = " + std::to_string(voronoi_law().at(0.3 / 3).density) + "\n";
    const StructureReport report =
        *build_job(recipe_of(block + narrow + drives_beams + volume + most + region("beam = 0.3\n", "most")))
             .optimized->report;
    const double even = analysed(block + narrow).compliance;
    CHECK(report.compliance == Approx(even).epsilon(0.03));
    CHECK(complaint_about(block + narrow + drives_beams + volume +
                          "[[field]]\nname = \"all\"\nformula = \"x - 20\"\n" + region("beam = 0.3\n", "all"))
              .find("regions leave no foam to the search") != std::string::npos);
}

TEST_CASE("closed cells have the law of the proportion that a region gives them", "[optimization]") {
    const Folder folder;
    const std::string path = folder / "laws.csv";
    {
        std::ofstream file(path);
        file << law_heading();
        for (const auto& [name, factor] :
             {std::pair("closed/wall=1beam/window=0", 1.0), std::pair("closed/wall=2beam/window=0", 1.5)}) {
            for (const double ratio : {0.05, 0.1, 0.2})
                file << law_row(name,
                                {.ratio = ratio, .density = factor * 3 * ratio, .young = factor * ratio});
        }
    }
    const std::string closed =
                          "[foam]\nkind = \"closed\"\ncell = 2\nbeam = 0.15\nwall = 0.15\ncell_min = 1\n"
                          "cell_max = 2.5\nlaw = \"" +
                          path + "\"\n",
                      search = "[optimize]\nresult = \"cell\"\nelements = 12\niterations = 6\nvolume = 0.4\n";
    const BuiltJob job = build_job(recipe_of(block + closed + search + right_half + region("wall = 0.3\n")));
    visit_foam(job, [&](dvec3 p, double density, ElementUse, double cell, double) {
        CAPTURE(p.x);
        // Between its points a law is linear in the logarithm of the ratio; points are enough here.
        const FoamLaw law =
            law_named(contents(path), p.x > 0 ? "closed/wall=2beam/window=0" : "closed/wall=1beam/window=0");
        CHECK(law.at(0.15 / cell).density == Approx(density).epsilon(1e-4));
    });
    CHECK(mentions(complaint_about(block + closed + search + right_half + region("wall = 0.2\n")),
                   "region.wall: there is no stiffness law for the foam of this region "
                   "(closed/wall=1.333beam/window=0)"));
    CHECK(mentions(complaint_about(block + closed + search + right_half + region("wall = 0.3\nblend = 2\n")),
                   "region.wall: the law of closed cells is that of one proportion"));
}

TEST_CASE("foam regions belong to the problem of a driven foam, and to no other", "[optimization]") {
    const std::string text = block + foam + right_half;
    const std::string volume = "volume = 0.25\n";
    const auto hash = [&](const std::string& more) { return optimize_hash(recipe_of(text + more)); };
    const std::string driven = drives_beams + volume;
    CHECK(hash(driven + region("cell = 4\n")) != hash(driven));
    CHECK(hash(driven + region("cell = 4\n")) != hash(driven + region("cell = 3\n")));
    CHECK(hash(driven + region("cell = 4\n")) != hash(driven + region("beam = 0.3\n")));
    const std::string solid = "[optimize]\nelements = 24\n" + volume;
    CHECK(hash(solid + region("cell = 4\n")) == hash(solid));

    const Folder folder;
    OptimizeOptions options;
    options.plans = folder / "plans";
    int iterations = 0;
    options.on_iteration = [&](const OptimizationStep&, int) { ++iterations; };
    const Recipe recipe = recipe_of(text + driven + "iterations = 4\n" + region("beam = 0.3\nblend = 3\n"));
    const BuiltJob first = build_job(recipe, options);
    REQUIRE(iterations > 0);
    iterations = 0;
    const BuiltJob second = build_job(recipe, options);
    CHECK(iterations == 0);
    visit_foam(first, [&](dvec3 p, double, ElementUse, double, double member) {
        CHECK(second.foam->member.made->at(p) == member);
    });
}

TEST_CASE("foam regions that a search cannot know are told", "[optimization]") {
    const std::string driven = block + foam + drives_beams + "volume = 0.15\n" + right_half;
    CHECK(mentions(complaint_about(driven + region("cell = 20\n")),
                   "region.cell: gives the foam members of 0.0075 to 0.02 of its cells, for which its "
                   "stiffness law is not known; accepted: numbers that give 0.03 to 0.26"));
    CHECK(mentions(complaint_about(driven + region("beam = 0.4\ncell = 1.2\n")), "0.3333 to 0.3333"));
    CHECK(mentions(complaint_about(driven + region("beam = 0.4\n")),
                   "optimize.volume / --optimize-volume: 0.15 is not a mean density of this part"));
    CHECK(mentions(complaint_about(driven + "[[field]]\nname = \"late\"\nkind = \"optimized\"\n" +
                                   region("beam = 0.3\n", "late")),
                   "field: `late` depends on the result of the search, which has to know the foam"));
    CHECK(mentions(complaint_about(driven + "[[grading]]\nname = \"late\"\nkind = \"optimized\"\n" +
                                   region("cell = \"2 + late\"\n")),
                   "region.cell: `late` depends on the result of the search"));
    CHECK(mentions(complaint_about(block + foam + "cell_max = 5\n[optimize]\nresult = \"cell\"\n" +
                                   right_half + region("beam = \"0.1*cell\"\n")),
                   "region.beam: `cell` is what the search drives"));
    CHECK(mentions(complaint_about(driven + region("modulus = 20\n")), "region.modulus: does not apply"));
}

}  // namespace optimized_foam_test
