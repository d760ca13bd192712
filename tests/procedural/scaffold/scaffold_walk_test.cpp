// The walks of the tests can fail: what is broken in a scaffold is found, one thing after the other.
#include "tests/procedural/scaffold/scaffold_walk.h"

#include <catch2/catch.hpp>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/scaffold/scaffold_synthesis.h"
#include "tests/engine/surveys/overhang_scenes.h"
#include "tests/procedural/scaffold/part_walk.h"

namespace scaffold_walk_test {

using namespace lamella;

namespace {

constexpr double plate_height = 16;

/// A plate on a column.
FieldPtr table() {
    return make_union({make_box({{-12, -12, plate_height}, {12, 12, plate_height + 2}}),
                       make_box({{-2, -2, 0}, {2, 2, plate_height + 1}})});
}

OverhangSurvey surveyed(const FieldPtr& part) {
    return survey_overhangs(scenes::job_of(part, part->bounds(), overhangs::height),
                            overhangs::without_stability());
}

/// What the walk says of a table on a scaffold that was changed.
template <typename Change>
ScaffoldFindings walk_changed(const Scaffold& whole, const Change& change) {
    Scaffold changed = whole;
    change(changed);
    return walk_scaffold(changed, *table(), 0.225, 0.2);
}

/// The part's walk over a part on a scaffold.
PartFindings walk_part(const FieldPtr& part, const Scaffold& scaffold, const OverhangLimits& limits = {}) {
    const LayerGrid grid(grown(part->bounds(), 1), 0, overhangs::height, 0.15);
    const std::vector<LayerPicture> layers = pictures_of(*part, grid);
    return PartWalk(grid, layers, limits).run(held_places(scaffold));
}

}  // namespace

TEST_CASE("whatever is broken in a scaffold is found", "[scaffold]") {
    const Scaffold whole = build_scaffold(surveyed(table()).points, *table(), {});
    REQUIRE(whole.bars.size() >= 5);
    REQUIRE(whole.unheld.empty());
    REQUIRE(walk_scaffold(whole, *table(), 0.225, 0.2).total() == 0);
    const auto index = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };

    for (std::size_t k = 0; k < whole.pillars.size(); ++k) {
        INFO("without pillar " << k);
        const ScaffoldFindings found =
            walk_changed(whole, [&](Scaffold& s) { s.pillars.erase(s.pillars.begin() + index(k)); });
        CHECK(found.loose_bars + found.hanging > 0);
    }
    std::size_t ends_in_the_air = 0;
    for (std::size_t k = 0; k < whole.bars.size(); ++k) {
        const dvec3 way = whole.bars[k].b - whole.bars[k].a;
        const double length = std::sqrt(glm::dot(way, way));
        const dvec3 along = way / length, across(-along.y, along.x, 0);
        {
            INFO("bar " << k << " made longer than allowed");
            const ScaffoldFindings found = walk_changed(
                whole, [&](Scaffold& s) { s.bars[k].b = s.bars[k].a + along * (s.shape.bridge + 0.5); });
            CHECK(found.long_bars == 1);
            ends_in_the_air += found.loose_bars;
        }
        {
            INFO("bar " << k << " moved sideways");
            const ScaffoldFindings found = walk_changed(whole, [&](Scaffold& s) {
                s.bars[k].a += across * 1.5;
                s.bars[k].b += across * 1.5;
            });
            CHECK(found.loose_bars > 0);
            CHECK(found.hanging > 0);
        }
        {
            INFO("without bar " << k);
            const ScaffoldFindings found =
                walk_changed(whole, [&](Scaffold& s) { s.bars.erase(s.bars.begin() + index(k)); });
            CHECK(found.hanging > 0);
        }
    }
    CHECK(ends_in_the_air > whole.bars.size() / 2);
    for (std::size_t k = 0; k < whole.connectors.size(); k += 5) {
        INFO("connector " << k);
        const Beam& beam = whole.connectors[k];
        // Cut off its bar, it hangs on the part alone.
        const ScaffoldFindings cut_off =
            walk_changed(whole, [&](Scaffold& s) { s.connectors[k].b = (beam.a * 3.0 + beam.b) / 4.0; });
        CHECK(cut_off.hanging > 0);
        const ScaffoldFindings without =
            walk_changed(whole, [&](Scaffold& s) { s.connectors.erase(s.connectors.begin() + index(k)); });
        if (beam.ra == whole.shape.tip / 2) CHECK(without.not_reached == 1);
        CHECK(without.total() > 0);
    }
    const ScaffoldFindings through = walk_changed(whole, [&](Scaffold& s) {
        s.connectors.push_back({{-6, 0.5, 12}, 0.45, {6, 0.5, 4}, 0.45});
    });
    CHECK(through.in_part > 0);
    const ScaffoldFindings foot = walk_changed(whole, [&](Scaffold& s) {
        s.pillars.push_back({{4.5, 0.5}, 0, 3, 3.5});
    });
    CHECK(foot.in_part > 0);
    CHECK(foot.hanging == 0);
    const ScaffoldFindings floating = walk_changed(whole, [&](Scaffold& s) {
        s.connectors.push_back({{20, 0, 8}, 0.45, {20, 0, 5}, 0.45});
    });
    CHECK(floating.floating == 1);
}

TEST_CASE("a part that hangs anywhere is found hanging", "[scaffold]") {
    const FieldPtr part = table();
    const Scaffold whole = build_scaffold(surveyed(part).points, *part, {});
    const PartFindings fine = walk_part(part, whole);
    CHECK(fine.unheld == 0);
    CHECK(fine.hanging > 600);
    CHECK(walk_part(part, {}).unheld == fine.hanging);
    // Without the tips of one corner, of any corner.
    for (const dvec2 corner : {dvec2(1, 1), dvec2(-1, 1), dvec2(1, -1), dvec2(-1, -1)}) {
        Scaffold broken = whole;
        std::erase_if(broken.connectors,
                      [&](const Beam& beam) { return beam.a.x * corner.x > 6 && beam.a.y * corner.y > 6; });
        CHECK(walk_part(part, broken).unheld > 0);
    }
    // Tips above what hangs hold nothing.
    Scaffold lifted = whole;
    for (SupportPoint& point : lifted.points) point.at.z += 1;
    for (Beam& beam : lifted.connectors) beam.a.z += 1;
    CHECK(walk_part(part, lifted).unheld == fine.hanging);
}

TEST_CASE("a part may bridge what is short, and no more", "[scaffold]") {
    const auto gate = [](double gap) {
        return make_union({make_box({{-14, -2, 0}, {-gap / 2, 2, 10}}),
                           make_box({{gap / 2, -2, 0}, {14, 2, 10}}), make_box({{-14, -2, 8}, {14, 2, 10}})});
    };
    const PartFindings near = walk_part(gate(8), {});
    CHECK(near.unheld == 0);
    CHECK(near.own_bridges == 2);
    CHECK(walk_part(gate(14), {}).unheld > 0);
    OverhangLimits shorter;
    shorter.bridge = 6;
    CHECK(walk_part(gate(8), {}, shorter).unheld > 0);
    // An arm without an end held is no bridge, however short it is.
    const FieldPtr arm =
        make_union({make_box({{-2, -2, 0}, {2, 2, 10}}), make_box({{-2, -2, 8}, {6, 2, 10}})});
    CHECK(walk_part(arm, {}).unheld > 0);
}

TEST_CASE("dense support fills the columns under what hangs", "[scaffold]") {
    const FieldPtr part = table();
    const LayerGrid grid(grown(part->bounds(), 1), 0, overhangs::height, 0.1);
    const std::vector<LayerPicture> layers = pictures_of(*part, grid);
    const OverhangLimits limits;
    const double side = 4 + 2 * limits.overhang;
    CHECK(DenseSupport(grid, layers, limits).volume() ==
          Approx((24 * 24 - side * side) * plate_height).epsilon(0.01));
    // Over a floor the columns end there.
    const FieldPtr stepped = make_union({part, make_box({{-12, -12, 0}, {12, 12, 6}})});
    CHECK(DenseSupport(grid, pictures_of(*stepped, grid), limits).volume() ==
          Approx((24 * 24 - side * side) * (plate_height - 6)).epsilon(0.01));
    OverhangLimits long_bridges;
    long_bridges.bridge = 1;
    long_bridges.free_stretch = 40;
    CHECK(DenseSupport(grid, layers, long_bridges).volume() == 0);
}

}  // namespace scaffold_walk_test
