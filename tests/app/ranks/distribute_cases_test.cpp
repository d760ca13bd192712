// Load cases of a search over several ranks: the design is that of one process, and each case is solved once.
#include "app/ranks/distribute_cases.h"

#include <catch2/catch.hpp>

#include "app/ranks/rank_failure.h"
#include "engine/base/error.h"
#include "tests/app/ranks/mpirun.h"
#include "tests/app/ranks/ranks_inside.h"
#include "tests/procedural/optimization/topology_problems.h"

namespace distribute_cases_test {

using namespace lamella;

namespace {

/// Three cases at the free end of a cantilever.
TopologyProblem<2> three_cases(int nx, int ny) {
    TopologyProblem<2> problem = cantilever_of_two_cases(nx, ny, 0.4);
    problem.cases.push_back({"3", 0.5, NodalVector<2, double>(problem.body.grid.size())});
    problem.cases[2].forces.along[0][problem.body.grid.number(nx, ny / 2, 0)] = 1;
    return problem;
}

TopologySettings settings_with(SharedSolves* shared, const CancelToken* cancel = nullptr) {
    TopologySettings settings;
    settings.density.radius = 2;
    settings.iterations = 12;
    settings.shared = shared;
    settings.cancel = cancel;
    return settings;
}

struct Search {
    std::vector<double> design, compliances;
};

Search search(const TopologyProblem<2>& problem, const TopologySettings& settings) {
    TopologyOptimizer<2> optimizer(problem, settings);
    Search found;
    while (!optimizer.is_finished()) found.compliances.push_back(optimizer.iterate().compliance);
    found.design = optimizer.state().design;
    return found;
}

/// Counts the cases that a rank gives to the others.
class Counted : public DistributedCases {
  public:
    using DistributedCases::DistributedCases;
    void give(const SolvedCase& solved) override {
        ++given;
        DistributedCases::give(solved);
    }
    int given = 0;
};

}  // namespace

TEST_CASE("a search by several ranks has the bits of one process, and each solves its cases",
          "[ranks][optimization]") {
    const TopologyProblem<2> problem = three_cases(40, 20);
    const Search alone = search(problem, settings_with(nullptr));
    REQUIRE(alone.compliances.size() == 12);
    for (const int size : {1, 2, 3, 4}) {
        Post post;
        std::vector<Search> found(static_cast<std::size_t>(size));
        std::vector<int> given(static_cast<std::size_t>(size));
        {
            std::vector<std::jthread> threads;
            for (std::size_t rank = 0; rank < found.size(); ++rank) {
                threads.emplace_back([&, rank] {
                    RanksInside ranks(post, static_cast<int>(rank), size);
                    Counted cases(ranks, problem.cases.size(), nullptr);
                    if (!cases.is_needed()) return;
                    found[rank] = search(problem, settings_with(&cases));
                    given[rank] = cases.given;
                });
            }
        }
        for (std::size_t rank = 0; rank < std::min<std::size_t>(found.size(), 3); ++rank) {
            CHECK(found[rank].design == alone.design);
            CHECK(found[rank].compliances == alone.compliances);
            const int searching = std::min(size, 3), own = (2 - static_cast<int>(rank)) / searching + 1;
            CHECK(given[rank] == 12 * own);
        }
    }
}

TEST_CASE("a rank whose design differs fails the search, and one that waits can be stopped",
          "[ranks][optimization]") {
    Post post;
    RanksInside first(post, 0, 2), second(post, 1, 2);
    DistributedCases here(first, 2, nullptr), there(second, 2, nullptr);
    there.give({7, 3, {{1, 2}, {3, 4}}});
    const SolvedCase taken = here.take(1, 7);
    CHECK(taken.iterations == 3);
    CHECK(taken.displacements == std::vector<std::vector<double>>{{1, 2}, {3, 4}});
    there.give({8, 3, {{1, 2}, {3, 4}}});
    CHECK_THROWS_WITH(here.take(1, 7), Catch::Contains("another design than that of rank 1"));
    CancelToken cancel;
    cancel.cancel();
    DistributedCases stopped(first, 2, &cancel);
    CHECK_THROWS_AS(stopped.take(1, 7), Interrupted);
    tell_failures(second, [] { throw FaultError("no memory is left"); });
    CHECK_THROWS_WITH(here.take(1, 7), Catch::Contains("rank 1: no memory is left"));
}

#ifdef LAMELLA_MPIRUN
TEST_CASE("mpirun finds the shape that one process finds, and reports it once", "[ranks][optimization]") {
    const Folder folder;
    std::ofstream(folder / "arm.toml")
        << "[part]\nshape = \"box\"\nsize = [40, 20, 4]\n[[anchor]]\nface = \"-x\"\n"
           "[[load]]\nbox = [[19, 9, -3], [20, 10, 3]]\nforce = [0, 10, 0]\n"
           "[[load]]\nbox = [[19, -10, -3], [20, -9, 3]]\nforce = [0, -10, 0]\ncase = \"2\"\n"
           "[optimize]\ndimensions = 2\nelements = 40\niterations = 15\n";
    const auto optimize = [&](const std::string& name) {
        return "optimize " + folder / "arm.toml" + " --threads 1 --json -q --plans " + folder / name +
               " --save " + folder / (name + ".nrrd");
    };
    const Outcome alone = run_by(0, optimize("alone"), folder);
    INFO(alone.err);
    REQUIRE(alone.code == 0);
    for (const int size : {2, 3}) {  // of two cases
        const Outcome spread = run_by(size, optimize("spread"), folder);
        INFO(spread.err);
        CHECK(spread.code == 0);
        CHECK(spread.out == alone.out);
        CHECK(contents(folder / "spread.nrrd") == contents(folder / "alone.nrrd"));
    }
    const Outcome held = run_by(2, optimize("one") + " --resume", folder);
    CHECK(held.code == 2);
    CHECK(times(held.err, "keeps no search of this recipe") == 1);
    const Outcome none = run_by(2, "optimize --shape box --shape-size 40,20,4 -q", folder);
    CHECK(none.code == 2);
    CHECK(times(none.err, "[optimize] is missing") == 1);
}
#endif

}  // namespace distribute_cases_test
