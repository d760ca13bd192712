// Files of searches that were stopped: read back as written, and refused when damaged.
#include "recipe/structure/stopped_search.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "engine/base/error.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/mentions.h"

namespace stopped_search_test {

using namespace lamella;

namespace {

TopologyState topology_state() {
    TopologyState state;
    state.design = {0.1, 0.2, 0.3};
    state.mma = {2, {0.4}, {0.5, 0.6}, {{0.7}, {0.8, 0.9}}};
    state.iteration = 7;
    state.phase = 1;
    state.phase_began = 5;
    state.first_compliance = 1.5;
    state.volume = 0.25;
    state.finished = true;
    state.displacements = {{1, 2}, {}, {3}};
    return state;
}

AppearanceState appearance_state() {
    AppearanceState state;
    state.level = 1;
    state.has_stiffest = true;
    state.stiffest = topology_state();
    state.least_compliance = 3.5;
    state.stage = 2;
    state.stage_steps = 4;
    state.pictured.design = {0.5, 0.25};
    state.pictured.found = {1, 2, 3, 4, 5, {6, 7}, {8}};
    state.pictured.mma = {1, {0.4}, {}, {{0.7}, {0.8}}};
    state.pictured.matches = {9, {{1, 2}, {-1, -1}, {3, 4}}, {10, 11}};
    state.pictured.displacements = {{5}, {6, 7}};
    state.pictured.steps = 12;
    state.pictured.first_appearance = 13;
    state.finished = true;
    return state;
}

void check_same(const MmaState& a, const MmaState& b) {
    CHECK(a.steps == b.steps);
    CHECK(a.former == b.former);
    CHECK(a.before == b.before);
    CHECK(a.asymptotes.low == b.asymptotes.low);
    CHECK(a.asymptotes.upp == b.asymptotes.upp);
}

void check_same(const TopologyState& a, const TopologyState& b) {
    CHECK(a.design == b.design);
    check_same(a.mma, b.mma);
    CHECK(a.iteration == b.iteration);
    CHECK(a.phase == b.phase);
    CHECK(a.phase_began == b.phase_began);
    CHECK(a.first_compliance == b.first_compliance);
    CHECK(a.volume == b.volume);
    CHECK(a.finished == b.finished);
    CHECK(a.displacements == b.displacements);
}

void check_same(const AppearanceState& a, const AppearanceState& b) {
    CHECK(a.level == b.level);
    CHECK(a.has_stiffest == b.has_stiffest);
    check_same(a.stiffest, b.stiffest);
    CHECK(a.least_compliance == b.least_compliance);
    CHECK(a.stage == b.stage);
    CHECK(a.stage_steps == b.stage_steps);
    CHECK(a.finished == b.finished);
    const LevelState &x = a.pictured, &y = b.pictured;
    CHECK(x.design == y.design);
    CHECK(x.found.compliance == y.found.compliance);
    CHECK(x.found.appearance == y.found.appearance);
    CHECK(x.found.volume == y.found.volume);
    CHECK(x.found.greyness == y.found.greyness);
    CHECK(x.found.solver_iterations == y.found.solver_iterations);
    CHECK(x.found.compliance_gradient == y.found.compliance_gradient);
    CHECK(x.found.appearance_gradient == y.found.appearance_gradient);
    check_same(x.mma, y.mma);
    CHECK(x.matches.sweeps == y.matches.sweeps);
    CHECK(x.matches.matches == y.matches.matches);
    CHECK(x.matches.use == y.matches.use);
    CHECK(x.displacements == y.displacements);
    CHECK(x.steps == y.steps);
    CHECK(x.first_appearance == y.first_appearance);
}

/// Writes the state with two steps and reads it, all of it and less. `Other` is the other kind.
template <typename Other, typename State>
void check_file(const State& state) {
    const Folder folder;
    const std::filesystem::path file = folder.path() / "plans" / "a.search";
    StructureReport report, again;
    report.history.resize(2);
    report.history[1].index = 2;
    report.history[1].appearance = 6.5;
    REQUIRE(keep_search(file, state, report));
    CHECK(report.notes.empty());
    check_same(kept_search<State>(file, again), state);
    REQUIRE(again.history.size() == 2);
    CHECK(again.history[1].index == 2);
    CHECK(again.history[1].appearance == 6.5);
    CHECK_FALSE(read_search<Other>(file));

    const std::string whole = contents(file.string());
    for (std::size_t size = 0; size < whole.size(); ++size) {
        CAPTURE(size);
        write(file.string(), whole.substr(0, size));
        CHECK_FALSE(read_search<State>(file));
    }
    write(file.string(), whole + "x");
    CHECK_FALSE(read_search<State>(file));
    // A length that no file can have: lists are not made before it is known.
    for (std::size_t at = 16; at + 8 <= whole.size(); ++at) {
        std::string damaged = whole;
        const std::uint64_t huge = std::uint64_t{1} << 60U;
        std::memcpy(damaged.data() + at, &huge, sizeof huge);
        write(file.string(), damaged);
        CHECK_NOTHROW(read_search<State>(file));
    }
}

}  // namespace

TEST_CASE("a search that was stopped is read as it was written, or not at all", "[optimization]") {
    check_file<AppearanceState>(topology_state());
    check_file<TopologyState>(appearance_state());
}

TEST_CASE("a search is not kept without a file, and what prevents it is told", "[optimization]") {
    const Folder folder;
    StructureReport report;
    CHECK_FALSE(keep_search({}, topology_state(), report));
    CHECK(report.notes.empty());
    write(folder / "file", "");
    CHECK_FALSE(keep_search(folder.path() / "file" / "a.search", topology_state(), report));
    REQUIRE(report.notes.size() == 1);
    CHECK(mentions(report.notes.front(), "the search cannot be resumed"));
    CHECK_THROWS_AS(kept_search<TopologyState>(folder.path() / "none.search", report), InputError);
}

}  // namespace stopped_search_test
