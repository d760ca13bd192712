// Loads on the nodes of finite elements: forces by closed sums.
#include "recipe/structure/structural_problem.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "recipe/build/build_body.h"
#include "tests/app/commands/recipes.h"

namespace structural_problem_test {

using namespace lamella;

TEST_CASE("a load acts on the filled elements of its place, on all if none is filled", "[optimise]") {
    const Recipe recipe = recipe_of(
        "[part]\nshape = \"box\"\nsize = [6, 4, 1]\n[optimize]\nelement = 1\ndimensions = 2\n"
        "[[load]]\nface = \"+x\"\nforce = [0, -8, 0]\n[[anchor]]\nface = \"-x\"\n",
        "p.toml");
    Gradings gradings(recipe);
    std::optional<MeshReport> mesh;
    const FieldPtr body = build_body(recipe, gradings, mesh);
    gradings.set_body(body);
    const BuiltRegions regions = build_regions(recipe, body->bounds(), gradings);
    const auto forces_with = [&](const FilledElements& filled) {
        ElementDomain domain = element_domain(recipe, *body, regions, nullptr);
        REQUIRE(domain.size == glm::ivec3(6, 4, 1));
        const auto problem = structural_problem<2>(recipe, domain, gradings, material_poisson, filled);
        const NodeGrid<2> grid(domain.size);
        const std::vector<double>& along_y = problem.topology.cases[0].forces.along[1];
        std::vector<double> forces;
        for (int y = 0; y <= 4; ++y) forces.push_back(along_y[grid.number(6, y, 0)]);
        CHECK(std::accumulate(along_y.begin(), along_y.end(), 0.0) == Approx(-8));
        return forces;
    };
    CHECK(forces_with({}) == std::vector<double>{-1, -2, -2, -2, -1});
    FilledElements filled(24, 0);
    CHECK(forces_with(filled) == std::vector<double>{-1, -2, -2, -2, -1});
    filled[5] = filled[4] = 1;  // the lowest row's last two: one of them touches the face
    CHECK(forces_with(filled) == std::vector<double>{-4, -4, 0, 0, 0});
    filled[11] = 1;
    CHECK(forces_with(filled) == std::vector<double>{-2, -4, -2, 0, 0});
}

}  // namespace structural_problem_test
