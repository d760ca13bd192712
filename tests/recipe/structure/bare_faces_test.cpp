// Depths below bare faces against those of a box, and the stiffness of bare foam against its struts.
#include "recipe/structure/bare_faces.h"

#include <catch2/catch.hpp>

#include "procedural/optimization/density_shape.h"
#include "recipe/structure/analyse_part.h"
#include "recipe/structure/optimize_part.h"
#include "tests/app/commands/recipes.h"

namespace bare_faces_test {

using namespace lamella;

namespace {

double compliance(const std::string& text, AnalysisModel model, int elements) {
    const Recipe recipe = recipe_of(text);
    AnalysisOptions options;
    options.model = model;
    options.elements = elements;
    return analyse_part(recipe, build_job(recipe), options).compliance;
}

}  // namespace

TEST_CASE("elements lie below the nearest face of a box unless something covers it", "[optimization]") {
    Recipe recipe = recipe_of("[part]\nshape = \"box\"\nsize = [8, 6, 6]\n");
    const BuiltJob job = build_job(recipe);
    recipe.optimize.emplace();
    recipe.optimize->element = 1;
    ElementDomain domain = element_domain(recipe, *job.body, job.regions, nullptr);
    REQUIRE(domain.size == glm::ivec3(8, 6, 6));
    const DensityGrid grid{domain.size, {}, {}};
    std::vector<std::uint8_t> held(domain.use.size());
    const auto depths = [&](double most) { return depths_below_faces(*job.body, domain, held, most); };
    const auto is_unaffected = [&](glm::ivec3 at) { return depths(9)[grid.place(at)].lo == infinity; };
    for (std::size_t i = 0; i < held.size(); ++i) {
        const glm::ivec3 at = grid.element(i), across = glm::min(at, domain.size - 1 - at);
        const double depth = std::min({across.x, across.y, across.z});
        CHECK(depths(9)[i].lo == Approx(depth).margin(1e-9));
        CHECK(depths(9)[i].hi == Approx(depth + 1).margin(1e-9));
        CHECK((depths(1)[i].lo == infinity) == (depth + 0.5 > 1));
    }
    // An anchor at one place of a face, and a solid plate at another one.
    for (const int z : {2, 3}) held[grid.place({0, 3, z})] = 1;
    CHECK(is_unaffected({0, 3, 3}));
    CHECK(is_unaffected({1, 3, 3}));
    CHECK(!is_unaffected({0, 1, 3}));
    domain.use[grid.place({7, 3, 3})] = ElementUse::solid;
    CHECK(is_unaffected({7, 3, 3}));
    CHECK(is_unaffected({6, 3, 3}));
    CHECK(!is_unaffected({7, 4, 3}));
}

TEST_CASE("the elements of a plate reach from its middle to its faces", "[optimization]") {
    Recipe recipe = recipe_of("[part]\nshape = \"box\"\nsize = [40, 20, 4]\n");
    const BuiltJob job = build_job(recipe);
    recipe.optimize.emplace();
    recipe.optimize->element = 1;
    recipe.optimize->dimensions = 2;
    const ElementDomain domain = element_domain(recipe, *job.body, job.regions, nullptr);
    const DensityGrid grid{domain.size, {}, {}};
    const std::vector<std::uint8_t> held(domain.use.size());
    for (const double most : {0.5, 9.0}) {
        const std::vector<Interval> depths = depths_below_faces(*job.body, domain, held, most);
        CHECK(depths[grid.place({20, 10, 0})].lo == 0);
        CHECK(depths[grid.place({20, 10, 0})].hi == Approx(2));
        CHECK(depths[grid.place({0, 10, 0})].hi == Approx(1));
    }
}

TEST_CASE("bare foam is as stiff by its law as its struts are by elements", "[optimization]") {
    // 6 x 5 x 5 cells between solid ends, two elements a beam's radius. Without cut cells, the law is a fifth
    // too stiff in tension and a quarter in bending.
    const std::string coupon =
        "[part]\nshape = \"box\"\nsize = [15, 12.5, 12.5]\n[material]\nname = \"pla\"\n"
        "[foam]\ncell = 2.5\nbeam = 0.3\n[[field]]\nname = \"ends\"\nformula = \"6.9 - abs(x)\"\n"
        "[[region]]\nfield = \"ends\"\nmake = \"solid\"\n[[anchor]]\nface = \"-x\"\n[[load]]\nface = "
        "\"+x\"\n";
    for (const std::string force : {"[50, 0, 0]", "[0, 0, -5]"}) {
        CAPTURE(force);
        const std::string text = coupon + "force = " + force + "\n";
        CHECK(compliance(text, AnalysisModel::elements, 100) ==
              Approx(compliance(text, AnalysisModel::law, 100)).epsilon(0.1));
    }
}

TEST_CASE("a search and an analysis see the same bare faces", "[optimization]") {
    const std::string bar =
        "[part]\nshape = \"box\"\nsize = [24, 12, 12]\n[material]\nyoung = 2000\npoisson = 0.3333333\n"
        "[[load]]\nface = \"+x\"\nforce = [0, 0, -10]\n[[anchor]]\nface = \"-x\"\n"
        "[foam]\ncell = 2\nbeam = 0.2\n";
    const std::string beams = "beam_min = 0.15\nbeam_max = 0.4\n[optimize]\nresult = \"beam\"\n",
                      cells = "cell_min = 1\ncell_max = 2.5\n[optimize]\nresult = \"cell\"\n",
                      search = "elements = 24\nvolume = 0.15\niterations = 4\n";
    // The search's modulus between two points of the law is not quite that of an analysis.
    struct Compliances {
        double found, analysed;
    };
    const auto compliances = [&](const std::string& text) {
        const Recipe recipe = recipe_of(text);
        const BuiltJob job = build_job(recipe);
        AnalysisOptions options;
        options.model = AnalysisModel::law;
        return Compliances{job.optimized->report->compliance, analyse_part(recipe, job, options).compliance};
    };
    for (const std::string& optimize : {beams, cells}) {
        const Compliances bare = compliances(bar + optimize + search),
                          covered = compliances(bar + optimize + search + "[frame]\nbeam = 0.2\n");
        CAPTURE(optimize, bare.found, bare.analysed, covered.found, covered.analysed);
        CHECK(bare.found > 1.1 * covered.found);
        CHECK(bare.analysed / bare.found == Approx(covered.analysed / covered.found).epsilon(0.01));
    }
}

}  // namespace bare_faces_test
