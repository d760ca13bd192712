// Bridges by forces: loads that balance, the gain of a bar, and skins that become stiffer.
#include "procedural/pattern/force_bridges.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/solids/primitives.h"
#include "engine/solids/shell.h"
#include "procedural/elasticity/direct_solver.h"
#include "procedural/optimization/topology_problem.h"
#include "procedural/pattern/surface_pattern.h"
#include "procedural/texture/body_sites.h"
#include "recipe/build/build_job.h"
#include "recipe/structure/analyse_part.h"
#include "tests/app/commands/recipes.h"
#include "tests/procedural/elasticity/dense_body.h"

namespace force_bridges_test {

using namespace lamella;

namespace {

double work_of(const NodalVector<3, double>& forces, const NodalVector<3, double>& u) {
    double sum = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        for (std::size_t i = 0; i < u.along[d].size(); ++i) sum += forces.along[d][i] * u.along[d][i];
    }
    return sum;
}

struct Ball {
    static constexpr double radius = 6, thickness = 1.2, edge = 0.6;
    FieldPtr body = make_sphere({0, 0, 0}, radius);
    FieldPtr shell = make_shell(body, thickness);
    SurfaceSites sites = sites_on_surface(*body, 0.3, 1'000'000, nullptr);
    SkinElements elements{*shell, sites, thickness, edge, nullptr};
};

}  // namespace

TEST_CASE("elements of a skin hold its volume, and that of its pattern", "[texture]") {
    const Ball ball;
    const auto volume = [&](const std::vector<float>& shares) {
        double sum = 0;
        for (const float share : shares) sum += static_cast<double>(share);
        return sum * std::pow(ball.edge, 3);
    };
    const double inner = ball.radius - ball.thickness;
    const double exact = 4 * std::numbers::pi / 3 * (std::pow(ball.radius, 3) - std::pow(inner, 3));
    CHECK(volume(ball.elements.shares({})) == Approx(exact).epsilon(0.02));
    // The part of the skin in a cone about z: a third of the sphere's height lies above z = 2.
    std::vector<float> cap;
    for (const dvec3 p : ball.sites.places) cap.push_back(static_cast<float>(p.z - 2));
    CHECK(volume(ball.elements.shares(cap)) == Approx(exact / 3).epsilon(0.04));
    const std::vector<float> shares = ball.elements.shares(cap);
    const std::vector<std::uint32_t> cubes = ball.elements.cubes_of_sites(shares, 0.05);
    std::size_t without = 0;
    for (std::size_t i = 0; i < cubes.size(); ++i) {
        if (ball.sites.places[i].z > 2.5) without += cubes[i] == SkinElements::none ? 1 : 0;
        if (ball.sites.places[i].z < 1) CHECK(cubes[i] == SkinElements::none);
    }
    CHECK(static_cast<double>(without) < 0.02 * static_cast<double>(cubes.size()));
}

TEST_CASE("squeezes of a skin balance, and are alike along all axes of a ball", "[texture]") {
    const Ball ball;
    const std::vector<float> shares = ball.elements.shares({});
    const LoadedSkin loaded = squeezed_skin(ball.elements, shares);
    REQUIRE(loaded.cases.size() == 4);
    int held = 0;
    for (const std::uint8_t fixed : loaded.body.fixed) held += (fixed & 1) + (fixed >> 1 & 1) + (fixed >> 2);
    CHECK(held == 6);
    std::vector<double> moduli(loaded.body.grid.size(), 0);
    const std::vector<std::size_t> numbers = element_numbers(loaded.body.grid);
    for (std::size_t i = 0; i < numbers.size(); ++i) moduli[numbers[i]] = static_cast<double>(shares[i]);
    ElasticSolver<3> solver(loaded.body, {.tolerance = 1e-8});
    solver.set_moduli(moduli);
    std::vector<double> compliances;
    for (const NodalVector<3, double>& forces : loaded.cases) {
        dvec3 sum(0), moment(0);
        double total = 0;
        for_each_place(loaded.body.grid.nodes(), [&](glm::ivec3 at) {
            const std::size_t node = loaded.body.grid.number(at.x, at.y, at.z);
            const dvec3 f(forces.along[0][node], forces.along[1][node], forces.along[2][node]);
            sum += f;
            moment += glm::cross(dvec3(at), f);
            total += std::sqrt(glm::dot(f, f));
        });
        CHECK(std::sqrt(glm::dot(sum, sum)) < 1e-9 * total);
        CHECK(std::sqrt(glm::dot(moment, moment)) < 1e-7 * total);
        NodalVector<3, double> u(loaded.body.grid.size());
        solver.solve(forces, u);
        compliances.push_back(work_of(forces, u));
    }
    CHECK(compliances[1] == Approx(compliances[0]).epsilon(1e-3));
    CHECK(compliances[2] == Approx(compliances[0]).epsilon(1e-3));
    CHECK(compliances[3] > 0);
}

TEST_CASE("the gain of a bar is what a second solve tells", "[texture]") {
    // A clamped beam of random moduli, and a bar between two of its nodes.
    ElasticBody<3> body(NodeGrid<3>({5, 2, 2}), make_solid_element({1, 0.3}));
    std::vector<double> moduli(body.grid.size(), 0);
    NodalVector<3, double> forces(body.grid.size());
    for_each_place({5, 2, 2}, [&](glm::ivec3 at) {
        moduli[body.grid.number(at.x, at.y, at.z)] = 0.2 + 0.13 * at.x + 0.3 * at.y * at.z;
    });
    std::vector<Eigen::Index> rows;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(dense_size(body.grid));
    for_each_place(body.grid.nodes(), [&](glm::ivec3 at) {
        const std::size_t node = body.grid.number(at.x, at.y, at.z);
        if (at.x == 0) body.fixed[node] = 7;
        for (Eigen::Index d = 0; d < 3; ++d) {
            const Eigen::Index row = 3 * dense_node(body.grid, at) + d;
            if (at.x > 0) rows.push_back(row);
            f[row] = forces.along[static_cast<std::size_t>(d)][node] =
                0.1 * (at.x - 2.0 * at.y + static_cast<double>(d));
        }
    });
    const glm::ivec3 from(1, 0, 2), to(4, 2, 0);
    const dvec3 way = glm::normalize(dvec3(to - from));
    Eigen::VectorXd bar = Eigen::VectorXd::Zero(f.size());
    NodalVector<3, double> pull(body.grid.size());
    for (int d = 0; d < 3; ++d) {
        bar[3 * dense_node(body.grid, from) + d] = -way[d];
        bar[3 * dense_node(body.grid, to) + d] = way[d];
        auto& along = pull.along[static_cast<std::size_t>(d)];
        along[body.grid.number(from.x, from.y, from.z)] = -way[d];
        along[body.grid.number(to.x, to.y, to.z)] = way[d];
    }
    const auto solver = DirectSolver::make(body, moduli, 1e12);
    REQUIRE(solver);
    const double stretch = work_of(pull, solver->solve(forces)),
                 flexibility = work_of(pull, solver->solve(pull));
    for (const double stiffness : {1e-3, 0.2, 50.0}) {
        Eigen::MatrixXd k = dense_stiffness(body, moduli);
        const auto compliance = [&] { return f(rows).dot(k(rows, rows).ldlt().solve(f(rows))); };
        const double without = compliance();
        k += stiffness * bar * bar.transpose();
        CHECK(gain_of_bar(stiffness, stretch, flexibility) ==
              Approx(without - compliance()).epsilon(1e-6).margin(1e-9 * without));
    }
}

TEST_CASE("a skin reinforced by forces gives way at most half as far", "[texture]") {
    // A squeezed shell of round spots, which hang on bridges: by elements of the finished part.
    const auto compliance = [](const std::string& reinforce, PatternReport* report) {
        const Recipe recipe = recipe_of(
            "[part]\nshape = \"sphere\"\nradius = 7\n[skin]\nthickness = 1\npattern = \"by-example\"\n"
            "image = \"" LAMELLA_SOURCE_DIR
            "/examples/inputs/spots.png\"\nimage_size = 34\n"
            "invert = true\nstrut = 0.8\nreinforce = \"" +
            reinforce +
            "\"\n"
            "[[anchor]]\nbox = [[-20, -20, -20], [20, 20, -5]]\n"
            "[[load]]\nbox = [[-20, -20, 5], [20, 20, 20]]\nforce = [0, 0, -1]\n");
        const BuiltJob job = build_job(recipe);
        *report = *job.pattern;
        AnalysisOptions options;
        options.model = AnalysisModel::elements;
        options.elements = 48;
        return analyse_part(recipe, job, options).compliance;
    };
    PatternReport joined, reinforced;
    const double before = compliance("none", &joined), after = compliance("forces", &reinforced);
    CHECK(after < 0.5 * before);
    CHECK(joined.bridges == 0);
    CHECK(reinforced.bridges > 0);
    CHECK(reinforced.softness > 1);
    CHECK(reinforced.softness <= reinforced.softness_before);
}

TEST_CASE("reinforcement by forces needs a skin", "[texture]") {
    const Ball ball;
    SurfacePatternSettings settings;
    settings.example.size = 24;
    settings.example.reinforce = Reinforcement::forces;
    const Volume picture = read_picture(LAMELLA_SOURCE_DIR "/examples/inputs/net.png");
    CHECK_THROWS_AS(synthesise_on_surface(picture, *ball.body, settings), InputError);
}

TEST_CASE("a skin reinforced by forces is the same on any number of threads", "[texture]") {
    const Ball ball;
    const auto made = [&](int threads) {
        ThreadArena arena(threads);
        return arena.execute([&] {
            SurfacePatternSettings settings;
            settings.example.size = 24;
            settings.example.reinforce = Reinforcement::forces;
            settings.shell = ball.shell;
            settings.depth = ball.thickness;
            return synthesise_on_surface(read_picture(LAMELLA_SOURCE_DIR "/examples/inputs/net.png"),
                                         *ball.body, settings);
        });
    };
    const SurfaceBricks one = made(1), four = made(4);
    CHECK(one.bridges == four.bridges);
    CHECK(one.softness == four.softness);
    REQUIRE(one.bricks.size() == four.bricks.size());
    for (std::size_t i = 0; i < one.bricks.size(); ++i) CHECK(one.bricks[i].steps == four.bricks[i].steps);
}

}  // namespace force_bridges_test
