// Scaffolds hold what they are asked to, keep clear of the part, and can be printed themselves.
#include "procedural/scaffold/scaffold_synthesis.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_parser.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/procedural/scaffold/scaffold_walk.h"

namespace scaffold_synthesis_test {

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

FieldPtr box(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }

/// A ceiling on a column beside which a ball lies.
FieldPtr hall() {
    return make_union(
        {box({-12, -12, 20}, {12, 12, 22}), box({-2, -2, 0}, {2, 2, 21}), make_sphere({6, 5, 4}, 3)});
}

std::vector<SupportPoint> points_of_hall() {
    std::vector<SupportPoint> points = under_ceiling(24, 20, 3);
    std::erase_if(points,
                  [](const SupportPoint& p) { return std::max(std::abs(p.at.x), std::abs(p.at.y)) < 3; });
    return points;
}

ScaffoldFindings walk(const Scaffold& scaffold, const Field& part) {
    const ScaffoldFindings found = walk_scaffold(scaffold, part);
    INFO(found.where);
    CHECK(found.total() == 0);
    return found;
}

bool same(const Scaffold& a, const Scaffold& b) {
    return a.bars == b.bars && a.pillars == b.pillars && a.connectors == b.connectors && a.unheld == b.unheld;
}

bool whole_layers(double z, const ScaffoldShape& shape) {
    const double layers = (z - shape.bed) / shape.layer_height;
    return std::abs(layers - std::round(layers)) < 1e-6;
}

}  // namespace

TEST_CASE("a ceiling stands on bridges", "[scaffold]") {
    const FieldPtr part = make_union({box({-20, -20, 30}, {20, 20, 34}), box({-2, -2, 0}, {2, 2, 31})});
    const auto points = under_ceiling(40, 30, 3);
    ScaffoldShape shape;
    const Scaffold bridges = build_scaffold(points, *part, shape);
    CHECK(bridges.bars.size() > 10);
    // The point in the column needs nothing, and nothing can be led to it.
    REQUIRE(bridges.unheld.size() == 1);
    CHECK(part->value(points[bridges.unheld[0]].at - dvec3(0, 0, 1)) < 0);
    const ScaffoldFindings with_bridges = walk(bridges, *part);
    shape.bridges = false;
    const Scaffold pillars = build_scaffold(points, *part, shape);
    CHECK(pillars.bars.empty());
    const ScaffoldFindings with_pillars = walk(pillars, *part);
    CHECK(with_bridges.volume < with_pillars.volume / 3);
}

TEST_CASE("scaffolds of many shapes hold and can be printed", "[scaffold]") {
    const auto points = points_of_hall();
    const auto holds = [&](const char* name, auto change) {
        INFO(name);
        ScaffoldShape shape;
        change(shape);
        const Scaffold scaffold = build_scaffold(points, *hall(), shape);
        CHECK(scaffold.unheld.empty());
        CHECK(scaffold.bars.size() >= 4);
        walk(scaffold, *hall());
        for (const ScaffoldBar& bar : scaffold.bars) {
            CHECK(whole_layers(bar.a.z, shape));
            CHECK(whole_layers(bar.a.z - scaffold.shape.bar_height, shape));
            CHECK(bar.a.z == bar.b.z);
        }
        for (const ScaffoldPillar& pillar : scaffold.pillars) {
            CHECK(whole_layers(pillar.bottom, shape));
            CHECK(whole_layers(pillar.top, shape));
            CHECK(pillar.top > pillar.bottom);
            CHECK((pillar.foot > 0) == (pillar.bottom == shape.bed));
        }
        CHECK(whole_layers(shape.bed + scaffold.shape.foot_height, shape));
        CHECK(scaffold.shape.bar_height >= shape.bar_height - 1e-6);
        CHECK(scaffold.shape.bar_height < shape.bar_height + shape.layer_height);
        CHECK(scaffold.shape.foot_height >= shape.foot_height - 1e-6);
    };
    holds("as it is", [](ScaffoldShape&) {});
    holds("round pillars", [](ScaffoldShape& s) { s.round_pillars = true; });
    holds("heights between layers", [](ScaffoldShape& s) {
        s.bar_height = 0.5;
        s.foot_height = 0.3;
    });
    holds("a bed below", [](ScaffoldShape& s) { s.bed = -1.37; });
    holds("short bars", [](ScaffoldShape& s) { s.bridge = 6; });
    holds("long bars", [](ScaffoldShape& s) { s.bridge = 20; });
    holds("no clearance to speak of", [](ScaffoldShape& s) { s.clearance = 0.1; });
    holds("much clearance", [](ScaffoldShape& s) { s.clearance = 1.5; });
    holds("thin layers", [](ScaffoldShape& s) { s.layer_height = 0.15; });
    holds("steep connectors", [](ScaffoldShape& s) { s.lean = 0.6; });
    holds("low connectors", [](ScaffoldShape& s) { s.connector = 1; });
}

TEST_CASE("a gap between tips and part leaves no contact", "[scaffold]") {
    ScaffoldShape shape;
    shape.gap = 0.3;
    const Scaffold scaffold = build_scaffold(points_of_hall(), *hall(), shape);
    CHECK(scaffold.unheld.empty());
    const FieldPtr field = make_scaffold_field(scaffold);
    for (double x = -11.5; x < 12; x += 0.13) {
        for (double y = -11.5; y < 12; y += 0.13) CHECK(field->value({x, y, 19.75}) > 0);
    }
}

TEST_CASE("a scaffold does not depend on the number of threads", "[scaffold]") {
    const auto points = points_of_hall();
    SynthesisOptions options;
    options.threads = 1;
    const Scaffold one = build_scaffold(points, *hall(), {}, options);
    CHECK(one.bars.size() >= 4);
    CHECK(one.connectors.size() >= points.size());
    for (const int threads : {2, 4}) {
        options.threads = threads;
        CHECK(same(build_scaffold(points, *hall(), {}, options), one));
    }
}

TEST_CASE("planning a scaffold tells how far it is, and stops when asked", "[scaffold]") {
    const auto points = points_of_hall();
    SynthesisOptions options;
    CancelToken cancel;
    options.cancel = &cancel;
    std::size_t last = 0;
    options.on_progress = [&](std::size_t bars) {
        CHECK(bars == last + 1);
        last = bars;
    };
    CHECK(build_scaffold(points, *hall(), {}, options).bars.size() == last);
    options.on_progress = [&](std::size_t bars) {
        CHECK(bars <= 2);
        if (bars == 2) cancel.cancel();
    };
    CHECK_THROWS_AS(build_scaffold(points, *hall(), {}, options), Interrupted);
    ScaffoldShape pillars;
    pillars.bridges = false;
    CHECK_THROWS_AS(build_scaffold(points, *hall(), pillars, options), Interrupted);
}

TEST_CASE("shapes that make no sense are refused", "[scaffold]") {
    const auto points = points_of_hall();
    const auto refused = [&](auto change) {
        ScaffoldShape shape;
        change(shape);
        CHECK_THROWS_AS(build_scaffold(points, *hall(), shape), InputError);
    };
    for (const double wrong : {0.0, -1.0, 1e-300, 1e300, infinity, static_cast<double>(NAN)}) {
        refused([&](ScaffoldShape& s) { s.layer_height = wrong; });
        refused([&](ScaffoldShape& s) { s.bridge = wrong; });
        refused([&](ScaffoldShape& s) { s.reach = wrong; });
        refused([&](ScaffoldShape& s) { s.lean = wrong; });
        refused([&](ScaffoldShape& s) { s.connector = wrong; });
        refused([&](ScaffoldShape& s) { s.longest_connector = wrong; });
        refused([&](ScaffoldShape& s) { s.tip = wrong; });
        refused([&](ScaffoldShape& s) { s.pillar = wrong; });
        refused([&](ScaffoldShape& s) { s.wall = wrong; });
        refused([&](ScaffoldShape& s) { s.bar_width = wrong; });
        refused([&](ScaffoldShape& s) { s.bar_height = wrong; });
        refused([&](ScaffoldShape& s) { s.foot = wrong; });
        refused([&](ScaffoldShape& s) { s.foot_height = wrong; });
    }
    for (const double wrong : {-1.0, 1e300, infinity, static_cast<double>(NAN)}) {
        refused([&](ScaffoldShape& s) { s.clearance = wrong; });
        refused([&](ScaffoldShape& s) { s.gap = wrong; });
    }
    for (const double wrong : {-1e300, infinity, static_cast<double>(NAN)}) {
        refused([&](ScaffoldShape& s) { s.bed = wrong; });
        const std::vector<SupportPoint> lost{{{0, wrong, 0}, SupportReason::span}};
        CHECK_THROWS_AS(build_scaffold(lost, *hall(), {}), InputError);
    }
    refused([&](ScaffoldShape& s) { s.longest_connector = s.connector; });
    refused([&](ScaffoldShape& s) { s.wall = s.pillar + 0.1; });
}

TEST_CASE("without points there is no scaffold", "[scaffold]") {
    const Scaffold none = build_scaffold({}, *hall(), {});
    CHECK(none.bars.empty());
    CHECK(none.pillars.empty());
    CHECK(none.connectors.empty());
    CHECK(none.unheld.empty());
    const FieldPtr field = make_scaffold_field(none);
    CHECK(field->value({0, 0, 0}) > 0);
    CHECK(field->bounds().size().x <= 0);
}

TEST_CASE("what cannot be reached is told, and does not disturb the rest", "[scaffold]") {
    const FieldPtr part = hall();
    auto points = points_of_hall();
    const std::vector<dvec3> lost{{0, 0, 10}, {1, 1, 21}, {6, 5, 4}, {-11, 11, 21.5}, {0, 0, -3}};
    const std::size_t first = points.size();
    for (const dvec3 at : lost) points.push_back({at, SupportReason::island});
    const Scaffold scaffold = build_scaffold(points, *part, {});
    CHECK(scaffold.unheld == std::vector<std::size_t>{first, first + 1, first + 2, first + 3});
    walk(scaffold, *part);
}

TEST_CASE("the vault of a closed cavity is held from its floor", "[scaffold]") {
    const FieldPtr part = make_difference(box({-16, -16, 0}, {16, 16, 24}), box({-12, -12, 4}, {12, 12, 20}));
    const Scaffold scaffold = build_scaffold(under_ceiling(24, 20, 4), *part, {});
    CHECK(scaffold.unheld.empty());
    CHECK(scaffold.bars.size() > 2);
    for (const ScaffoldPillar& pillar : scaffold.pillars) CHECK(pillar.bottom > 4);
    walk(scaffold, *part);
}

TEST_CASE("points close above the bed stand on posts", "[scaffold]") {
    for (const double z : {0.1, 0.2, 0.4, 0.6, 1.0}) {
        INFO(z << " mm above the bed");
        const FieldPtr part = box({-8, -8, z}, {8, 8, z + 4});
        const Scaffold scaffold = build_scaffold(under_ceiling(16, z, 3), *part, {});
        CHECK(scaffold.unheld.empty());
        CHECK(scaffold.bars.empty());
        const ScaffoldFindings found = walk_scaffold(scaffold, *part, 0.225, 0.1);
        INFO(found.where);
        CHECK(found.hanging == 0);
        CHECK(found.not_reached == 0);
        CHECK(found.floating == 0);
    }
}

TEST_CASE("points over a slot are held through it where it is wide enough", "[scaffold]") {
    // A ceiling over a slab with a slot in it.
    const auto over_slot = [](double width) {
        return make_union({box({-10, -10, 14}, {10, 10, 16}),
                           make_difference(box({-10, -10, 0}, {10, 10, 9}),
                                           box({-width / 2, -11, -1}, {width / 2, 11, 10}))});
    };
    std::vector<SupportPoint> points;
    for (double y = -8; y <= 8; y += 2) points.push_back({{0, y, 14}, SupportReason::span});
    for (const double width : {0.5, 1.0, 2.2, 4.5}) {
        INFO("a slot " << width << " mm wide");
        const FieldPtr part = over_slot(width);
        const Scaffold scaffold = build_scaffold(points, *part, {});
        CHECK(scaffold.unheld.empty());
        walk(scaffold, *part);
    }
}

TEST_CASE("a part of which signs alone are known is kept clear of", "[scaffold]") {
    const FieldPtr part = make_union({make_sphere({0, 0, 16}, 6), make_sphere({3, 2, 4}, 2.5)});
    const std::vector<std::string> names{"x", "y", "z"};
    const FieldPtr signs =
        make_formula_field(parse_formula("(hypot(x,y,z-16) < 6 or hypot(x-3,y-2,z-4) < 2.5) ? -1 : 1", names),
                           {}, part->bounds(), Metric::sign);
    std::vector<SupportPoint> points;
    for (const double r : {0.0, 1.5, 3.0}) {
        for (int k = 0; k < (r == 0 ? 1 : 8); ++k) {
            const double a = k * 0.7853981633974483;
            points.push_back(
                {{r * std::cos(a), r * std::sin(a), 16 - std::sqrt(36 - r * r)}, SupportReason::overhang});
        }
    }
    const Scaffold scaffold = build_scaffold(points, *signs, {});
    CHECK(scaffold.unheld.size() <= 2);
    CHECK(scaffold.connectors.size() >= points.size() - 2);
    walk(scaffold, *part);
}

}  // namespace scaffold_synthesis_test
