// Scaffolds hold what they are asked to, keep clear of the part, and can be printed themselves.
#include "procedural/scaffold_synthesis.h"

#include <catch2/catch.hpp>

#include "engine/csg.h"
#include "engine/error.h"
#include "engine/primitives.h"
#include "tests/procedural/scaffold_walk.h"

using namespace lamella;

namespace {

/// Points under a square ceiling, `spacing` mm apart.
std::vector<SupportPoint> under_ceiling(double side, double z, double spacing) {
    std::vector<SupportPoint> points;
    for (double y = -side / 2 + 1; y <= side / 2 - 1; y += spacing) {
        for (double x = -side / 2 + 1; x <= side / 2 - 1; x += spacing) {
            points.push_back({{x, y, z}, SupportReason::span});
        }
    }
    return points;
}

ScaffoldFindings walk(const Scaffold& scaffold, const Field& part) {
    const ScaffoldFindings found = walk_scaffold(scaffold, part);
    INFO(found.where);
    CHECK(found.total() == 0);
    return found;
}

}  // namespace

TEST_CASE("a ceiling stands on bridges", "[scaffold]") {
    const FieldPtr part =
        make_union({make_box({{-20, -20, 30}, {20, 20, 34}}), make_box({{-2, -2, 0}, {2, 2, 31}})});
    const auto points = under_ceiling(40, 30, 3);
    ScaffoldShape shape;
    const Scaffold bridges = build_scaffold(points, *part, shape);
    CHECK(bridges.bars.size() > 10);
    const ScaffoldFindings with_bridges = walk(bridges, *part);
    shape.bridges = false;
    const Scaffold pillars = build_scaffold(points, *part, shape);
    const ScaffoldFindings with_pillars = walk(pillars, *part);
    CHECK(with_bridges.volume < 0.7 * with_pillars.volume);
}
