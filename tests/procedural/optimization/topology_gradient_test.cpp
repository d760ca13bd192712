// Gradients of compliance and volume through the whole chain from variables to displacements, against
// differences.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "procedural/optimization/compliance.h"
#include "tests/procedural/optimization/topology_problems.h"

namespace topology_gradient_test {

using namespace lamella;
using Role = DensityMap::Role;

namespace {

/// Compares g . d with the differences of f along d, by a formula of fourth order.
double relative_error(const std::function<double(const std::vector<double>&)>& f,
                      const std::vector<double>& x, const std::vector<double>& gradient,
                      const std::vector<double>& d, double scale) {
    constexpr double step = 2e-5;
    const auto at = [&](double t) {
        std::vector<double> moved(x);
        for (std::size_t i = 0; i < x.size(); ++i) moved[i] += t * d[i];
        return f(moved);
    };
    const double difference = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
    double product = 0;
    for (std::size_t i = 0; i < x.size(); ++i) product += gradient[i] * d[i];
    return std::abs(product - difference) / scale;
}

/// Checks single variables and random directions, relative to the largest component of the gradient.
void check_gradient(const std::function<double(const std::vector<double>&)>& f, const std::vector<double>& x,
                    const std::vector<double>& gradient, unsigned seed) {
    double largest = 0;
    for (const double g : gradient) largest = std::max(largest, std::abs(g));
    REQUIRE(largest > 0);
    std::mt19937 random(seed);
    for (int trial = 0; trial < 8; ++trial) {
        std::vector<double> d(x.size());
        if (trial < 5) {
            d[random() % x.size()] = 1;
        } else {
            for (double& along : d) along = random() % 2 == 0 ? 1 : -1;
        }
        double scale = 0;  // what is large for this direction
        for (std::size_t i = 0; i < d.size(); ++i) scale += d[i] * d[i] * gradient[i] * gradient[i];
        scale = std::max(std::sqrt(scale), 0.1 * largest);
        CAPTURE(trial);
        CHECK(relative_error(f, x, gradient, d, scale) < 1e-6);
    }
}

template <std::size_t Dim>
void check_chain(const TopologyProblem<Dim>& problem, const DensitySettings& settings, double sharpness,
                 unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.2, 0.9);
    std::vector<double> x(problem.use.size());
    for (double& v : x) v = share(random);
    REQUIRE(settings.limits.size() == problem.limits.size());
    DensityMap map(problem.body.grid.elements(), problem.use, settings);
    Compliance<Dim> compliance(problem, {.tolerance = 1e-13});
    std::vector<double> counted(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) counted[i] = 0.3 + share(random);

    const auto stiffness = [&](const std::vector<double>& design) {
        map.forward(design, sharpness);
        return compliance.evaluate(map.density(Role::stiffness));
    };
    const auto of_volume = [&](Role role) {
        return [&, role](const std::vector<double>& design) {
            map.forward(design, sharpness);
            double sum = 0;
            for (std::size_t i = 0; i < design.size(); ++i) sum += counted[i] * map.density(role)[i];
            return sum;
        };
    };
    const std::vector<double> energies = stiffness(x).gradient;
    const std::vector<double> by_stiffness = map.backward(Role::stiffness, energies);
    check_gradient([&](const std::vector<double>& design) { return stiffness(design).total; }, x,
                   by_stiffness, seed);
    for (const Role role : {Role::volume, Role::result}) {
        map.forward(x, sharpness);
        const std::vector<double> gradient = map.backward(role, counted);
        check_gradient(of_volume(role), x, gradient, seed + 1);
    }
}

template <std::size_t Dim>
TopologyProblem<Dim> small_problem() {
    if constexpr (Dim == 2) {
        return plane_cantilever(9, 7, 0.5, 2);
    } else {
        return solid_cantilever(5, 4, 3, 0.5, 1e-6);
    }
}

/// Some elements are solid, empty or outside.
template <std::size_t Dim>
void prescribe_some(TopologyProblem<Dim>& problem) {
    const std::size_t n = problem.use.size();
    problem.use[n / 2] = ElementUse::solid;
    problem.use[n / 2 + 1] = ElementUse::empty;
    problem.use[n - 1] = ElementUse::outside;
    problem.use[3] = ElementUse::solid;
}

/// Elements have their own limits, around the designs that are tried, and one of two laws; two are kept.
template <std::size_t Dim>
void limit_each(TopologyProblem<Dim>& problem) {
    problem.laws = {problem.law, make_penalty_law({.exponent = 1.5, .least = 1e-3})};
    for (std::size_t i = 0; i < problem.use.size(); ++i) {
        problem.limits.push_back(
            {0.015 * static_cast<double>(7 * i % 10), 1 - 0.015 * static_cast<double>(3 * i % 5)});
        problem.law_of.push_back(i % 3 == 1);
    }
    for (const std::size_t kept : {std::size_t{5}, problem.use.size() / 2 + 2}) {
        problem.use[kept] = ElementUse::kept;
        problem.limits[kept] = {0.37, 0.37};
    }
}

template <std::size_t Dim>
void add_second_case(TopologyProblem<Dim>& problem) {
    problem.cases.push_back({"2", 0.3, NodalVector<Dim, double>(problem.body.grid.size())});
    const glm::ivec3 n = problem.body.grid.elements();
    problem.cases[1].forces.along[0][problem.body.grid.number(n.x, n.y - 1, 1 % n.z)] = 2;
}

/// The law of some foam, its points chosen at random but smooth enough.
std::shared_ptr<const ModulusLaw> gyroid_law() {
    std::ifstream file(LAMELLA_SOURCE_DIR "/materials/foam_laws.csv");
    std::stringstream text;
    text << file.rdbuf();
    for (const FoamLawTable& table : read_foam_laws(text.str(), "foam_laws.csv")) {
        if (table.foam == "gyroid") return make_foam_modulus_law(FoamLaw(table, law_poisson), 1e-6);
    }
    return nullptr;
}

template <std::size_t Dim>
void check_all() {
    const TopologyProblem<Dim> plain = small_problem<Dim>();
    const DensitySettings filter{.radius = 1.8};
    const int up = Dim == 2 ? 1 : 2;
    SECTION("filter alone, cut and mirrored") {
        check_chain(plain, filter, 0, 1);
        check_chain(plain, {.radius = 2.3, .padding = FilterPadding::mirror}, 0, 2);
    }
    SECTION("projection") {
        check_chain(plain, filter, 2, 3);
        check_chain(plain, filter, 8, 4);
    }
    SECTION("three fields") {
        check_chain(plain, {.padding = FilterPadding::mirror, .length_scale = LengthScale{.radius = 2.2}}, 4,
                    5);
    }
    SECTION("three fields with open borders") {
        std::vector<std::uint8_t> open(plain.use.size());
        for (std::size_t i = 0; i < open.size(); ++i) open[i] = i % 3 != 0;
        check_chain(plain, {.length_scale = LengthScale{.radius = 2.2}, .open = open}, 4, 15);
    }
    SECTION("overhang") {
        check_chain(plain, {.radius = 1.8, .overhang = OverhangSettings{.axis = up}}, 0, 6);
        check_chain(plain, {.radius = 1.8, .overhang = OverhangSettings{.axis = up}}, 4, 7);
    }
    SECTION("symmetry") { check_chain(plain, {.radius = 1.8, .mirrored = {true, true, false}}, 2, 8); }
    SECTION("prescribed elements") {
        TopologyProblem<Dim> problem = plain;
        prescribe_some(problem);
        check_chain(problem, filter, 3, 9);
        check_chain(
            problem,
            {.radius = 1.8, .mirrored = {false, true, false}, .overhang = OverhangSettings{.axis = up}}, 3,
            10);
        check_chain(problem,
                    {.length_scale = LengthScale{.radius = 2.2}, .overhang = OverhangSettings{.axis = up}}, 3,
                    11);
    }
    SECTION("weight") {
        TopologyProblem<Dim> problem = plain;
        problem.weight[static_cast<std::size_t>(up)] = -0.2;
        problem.weight[0] = 0.1;
        check_chain(problem, filter, 0, 12);
        problem.law = make_penalty_law({.exponent = 3, .least = 1e-6, .linear_to = 0.3});
        prescribe_some(problem);
        add_second_case(problem);
        check_chain(problem, filter, 2, 13);
    }
    SECTION("two cases") {
        TopologyProblem<Dim> problem = plain;
        add_second_case(problem);
        check_chain(problem, filter, 0, 14);
    }
    SECTION("limits and laws by element") {
        TopologyProblem<Dim> problem = plain;
        prescribe_some(problem);
        limit_each(problem);
        DensitySettings limited{.radius = 1.8, .limits = problem.limits};
        check_chain(problem, limited, 0, 16);
        check_chain(problem, limited, 3, 17);
        limited.mirrored = {false, true, false};
        limited.overhang = OverhangSettings{.axis = up};
        check_chain(problem, limited, 0, 18);
        check_chain(problem, {.length_scale = LengthScale{.radius = 2.2}, .limits = problem.limits}, 3, 19);
    }
    SECTION("the law of a foam") {
        TopologyProblem<Dim> problem = plain;
        problem.law = gyroid_law();
        REQUIRE(problem.law != nullptr);
        check_chain(problem, filter, 0, 15);
    }
}

}  // namespace

TEST_CASE("gradients of designs in the plane equal differences", "[optimization]") { check_all<2>(); }
TEST_CASE("gradients of designs in space equal differences", "[optimization]") { check_all<3>(); }

}  // namespace topology_gradient_test
