// Searches for an appearance that are stopped: what they show, and that they go on to the same bits.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "engine/base/error.h"
#include "tests/procedural/appearance/half_beams.h"

namespace appearance_state_test {

using namespace lamella;
using namespace half_beams;

namespace {

/// Stops a search once, after a number of solves.
class StopAfter : public SharedSolves {
  public:
    explicit StopAfter(int solves) : left_(solves) {}
    bool is_solved_here(std::size_t) const override { return true; }
    void give(const SolvedCase&) override {
        if (left_-- == 0) throw Interrupted("stopped");
    }
    SolvedCase take(std::size_t, std::uint64_t) override { throw FaultError("there is no other process"); }
    bool has_stopped() const { return left_ < 0; }

  private:
    int left_;
};

}  // namespace

TEST_CASE("a search that was stopped anywhere goes on to the same bits", "[optimization]") {
    AppearanceSettings settings = quick(1.3);
    settings.levels = 3;
    settings.steps = 5;
    settings.steps_a_sharpness = 2;
    settings.sharpness = 2;
    settings.match.neighbourhood = 4;
    const glm::ivec3 size(37, 21, 1);
    const auto made = [&](const AppearanceSettings& with) {
        return std::make_unique<AppearanceOptimizer>(half_beam_at, size, rings(), exemplar_width, with);
    };
    const Found whole = optimized(*made(settings));
    std::map<int, int> stops;  // by level
    bool stopped_in_search_for_stiffest = false, stopped_in_projection = false;
    for (int solves = 0;; ++solves) {
        CAPTURE(solves);
        StopAfter stop(solves);
        AppearanceSettings stopping = settings;
        stopping.shared = &stop;
        const auto broken = made(stopping);
        std::size_t steps = 0;
        try {
            for (; !broken->is_finished(); ++steps) broken->iterate();
        } catch (const Interrupted&) {
        }
        if (!stop.has_stopped()) break;
        const AppearanceState state = broken->state();
        ++stops[state.level];
        stopped_in_search_for_stiffest |= state.level > 0 && !state.has_stiffest;
        stopped_in_projection |= state.stage > 0;
        CHECK(broken->has_result() == (state.level > 0 || state.has_stiffest));
        if (broken->has_result()) {
            const AppearanceResult so_far = broken->result();
            CHECK(so_far.use.size() == whole.use.size());
            CHECK(so_far.filtered.size() == whole.filtered.size());
            CHECK(mean(so_far.stiffest) == Approx(0.4).epsilon(0.05));
        } else {
            CHECK_THROWS_AS(broken->result(), FaultError);
        }
        const auto resumed = made(settings);
        resumed->set_state(state);
        const Found rest = optimized(*resumed);
        check_same(rest, whole);
        CHECK(steps + rest.history.size() == whole.history.size());
        if (solves % 4 == 0) check_same(optimized(*broken), whole);  // what was broken off leaves no trace
    }
    CHECK(stops[0] > 5);
    CHECK(stops[1] > 3);
    CHECK(stops[2] > 10);
    CHECK(stopped_in_search_for_stiffest);
    CHECK(stopped_in_projection);
    // One that had ended does not begin anew.
    const auto ended = made(settings), again = made(settings);
    optimized(*ended);
    again->set_state(ended->state());
    REQUIRE(again->is_finished());
    check_same(optimized(*again), whole);
}

TEST_CASE("a design of a coarse grid is shown on the finest one", "[optimization]") {
    AppearanceSettings settings = quick(1.5);
    const glm::ivec3 size(60, 30, 1);
    AppearanceOptimizer optimizer(half_beam_at, size, rings(), exemplar_width, settings);
    for (int k = 0; k < settings.steps; ++k) CHECK(optimizer.iterate().level == 0);
    const AppearanceResult coarse = optimizer.result();
    const Found fine = optimized(optimizer);
    // Of the same share and likeness, and as stiff as interpolated grey can be.
    CHECK(mean(coarse.density) == Approx(coarse.volume).epsilon(0.03));
    CHECK(likeness(coarse.density, size, rings()) < 1.5 * fine.appearance);
    CHECK(likeness(coarse.density, size, rings()) < likeness(coarse.stiffest, size, rings()));
    CHECK(compliance_of(coarse.density, half_beam(size)) < 1.5 * 1.5 * fine.least_compliance);
    CHECK(compliance_of(coarse.stiffest, half_beam(size)) < 1.3 * fine.least_compliance);
}

TEST_CASE("the state of another search is refused", "[optimization]") {
    const AppearanceSettings settings = quick(1.5);
    AppearanceOptimizer optimizer(half_beam_at, {48, 24, 1}, stripes(), exemplar_width, settings);
    const AppearanceState begun = optimizer.state();
    for (int k = 0; k < 3; ++k) optimizer.iterate();
    const AppearanceState state = optimizer.state();
    AppearanceOptimizer other(half_beam_at, {50, 24, 1}, stripes(), exemplar_width, settings);
    CHECK_THROWS_AS(other.set_state(begun), InputError);
    CHECK_THROWS_AS(other.set_state(state), InputError);
    const auto refused = [&](const auto& change) {
        AppearanceState wrong = state;
        change(wrong);
        CHECK_THROWS_AS(optimizer.set_state(wrong), InputError);
    };
    refused([](AppearanceState& s) { s.level = 2; });
    refused([](AppearanceState& s) { s.level = -1; });
    refused([](AppearanceState& s) { s.stage = 1; });  // of the finest grid alone
    refused([](AppearanceState& s) { s.stage_steps = 41; });
    refused([](AppearanceState& s) { s.stage_steps = -1; });
    refused([](AppearanceState& s) { s.least_compliance = std::nan(""); });
    refused([](AppearanceState& s) { s.pictured.design.pop_back(); });
    refused([](AppearanceState& s) { s.stiffest.design.pop_back(); });
    refused([](AppearanceState& s) { s.pictured.found.compliance_gradient.clear(); });
    refused([](AppearanceState& s) { s.pictured.displacements.pop_back(); });
    refused([](AppearanceState& s) { s.pictured.mma.former.pop_back(); });
    refused([](AppearanceState& s) { s.pictured.matches.matches[0].x = 1000; });
    CHECK_NOTHROW(optimizer.set_state(state));
}

TEST_CASE("cancelling interrupts at once", "[optimization]") {
    for (const int after : {0, 3, 25}) {
        CancelToken cancel;
        AppearanceSettings settings = quick(1.5);
        settings.steps = 20;
        settings.cancel = &cancel;
        AppearanceOptimizer optimizer(half_beam_at, {48, 24, 1}, stripes(), exemplar_width, settings);
        for (int k = 0; k < after; ++k) optimizer.iterate();
        cancel.cancel();
        CHECK_THROWS_AS(optimizer.iterate(), Interrupted);
        REQUIRE(optimizer.has_result() == (after > 0));
        if (after > 0) CHECK(optimizer.result().design.size() == 48 * 24);
    }
}

}  // namespace appearance_state_test
