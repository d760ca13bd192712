// The solid of a scaffold is the union of its pieces, layer by layer and point by point.
#include "procedural/scaffold/scaffold_field.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/runs/plane_runs.h"

namespace scaffold_field_test {

using namespace lamella;

namespace {

/// A scaffold of pieces anywhere, joined to nothing.
Scaffold scattered(bool round_pillars, int pieces, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-12, 12), height(1, 14), radius(0.2, 0.9);
    Scaffold scaffold;
    scaffold.shape.round_pillars = round_pillars;
    for (int k = 0; k < pieces; ++k) {
        const double bottom = k % 2 == 0 ? 0 : height(random) / 2;
        scaffold.pillars.push_back({{place(random), place(random)},
                                    bottom,
                                    bottom + height(random),
                                    k % 2 == 0 ? 1.3 + radius(random) : 0});
        const double z = height(random);
        scaffold.bars.push_back({{place(random), place(random), z}, {place(random), place(random), z}});
        scaffold.connectors.push_back({{place(random), place(random), height(random)},
                                       radius(random),
                                       {place(random), place(random), height(random)},
                                       radius(random)});
    }
    return scaffold;
}

FieldPtr upright_box(dvec2 at, dvec2 half, double lo, double hi) {
    return make_box({dvec3(at - half, lo), dvec3(at + half, hi)});
}

/// Every piece as a field of its own, made of the engine's primitives.
std::vector<FieldPtr> pieces_of(const Scaffold& scaffold) {
    const ScaffoldShape& shape = scaffold.shape;
    std::vector<FieldPtr> pieces;
    for (const ScaffoldPillar& pillar : scaffold.pillars) {
        const double half = shape.pillar / 2, wall = shape.wall / 2;
        const auto disc = [&](double radius, double top) {
            return make_cylinder({pillar.at, pillar.bottom}, {pillar.at, top}, radius);
        };
        if (shape.round_pillars) {
            pieces.push_back(disc(half, pillar.top));
        } else {
            pieces.push_back(upright_box(pillar.at, {half, wall}, pillar.bottom, pillar.top));
            pieces.push_back(upright_box(pillar.at, {wall, half}, pillar.bottom, pillar.top));
        }
        if (pillar.foot > 0) {
            pieces.push_back(disc(pillar.foot, std::min(pillar.bottom + shape.foot_height, pillar.top)));
        }
    }
    for (const ScaffoldBar& bar : scaffold.bars) {
        const dvec3 way = bar.b - bar.a;
        const double length = std::sqrt(glm::dot(way, way));
        const dvec3 u = way / length;
        const FieldPtr flat =
            upright_box({0, 0}, dvec2(length + shape.bar_width, shape.bar_width) * 0.5, -shape.bar_height, 0);
        pieces.push_back(
            make_transform(flat, glm::dmat3(u, dvec3(-u.y, u.x, 0), dvec3(0, 0, 1)), (bar.a + bar.b) * 0.5));
    }
    for (const Beam& beam : scaffold.connectors) pieces.push_back(make_round_cone(beam));
    return pieces;
}

double min_value(const std::vector<FieldPtr>& pieces, dvec3 p) {
    double least = infinity;
    for (const FieldPtr& piece : pieces) least = std::min(least, piece->value(p));
    return least;
}

}  // namespace

TEST_CASE("a scaffold's value is the least over all its pieces", "[scaffold]") {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-16, 16), height(-3, 20), limit(0.05, 4);
    for (const bool round : {false, true}) {
        for (const int count : {1, 3, 25}) {
            const Scaffold scaffold = scattered(round, count, 10 + static_cast<unsigned>(count));
            const FieldPtr field = make_scaffold_field(scaffold);
            const std::vector<FieldPtr> pieces = pieces_of(scaffold);
            int inside = 0;
            for (int k = 0; k < 6000; ++k) {
                const dvec3 p(place(random), place(random), height(random));
                const double least = min_value(pieces, p);
                REQUIRE(field->value(p) == Approx(least).margin(1e-9));
                const double most = limit(random), within = field->value_within(p, most);
                if (std::abs(least) < most) {
                    REQUIRE(within == Approx(least).margin(1e-9));
                } else {
                    REQUIRE(std::abs(within) >= most);
                    REQUIRE((within < 0) == (least < 0));
                }
                inside += least < 0 ? 1 : 0;
            }
            CHECK(inside > 5 * count);
        }
    }
}

TEST_CASE("a scaffold's slices are those of its pieces, and its bounds hold them", "[scaffold]") {
    for (const bool round : {false, true}) {
        const Scaffold scaffold = scattered(round, 12, 3);
        const FieldPtr field = make_scaffold_field(scaffold), pieces = make_union(pieces_of(scaffold));
        const Box bounds = field->bounds();
        const RowBand band = band_over(grown(bounds, 1), 0.11);
        std::int64_t solid = 0;
        for (double z = bounds.lo.z - 0.53; z < bounds.hi.z + 0.5; z += 0.31) {
            RunRows only, other;
            const RunRows made = runs_at(*field, z, band), expected = runs_at(*pieces, z, band);
            subtract(made, expected, only);
            subtract(expected, made, other);
            for (const RunRows* rest : {&only, &other}) {
                // Turned boxes have runs read off samples, which end within a hundredth of a millimetre.
                for (std::size_t l = 0; l < rest->lines(); ++l) {
                    for (const Run& run : rest->line(l)) {
                        const double middle = band.along((run.begin + run.end) * 0.5);
                        REQUIRE(std::abs(pieces->value({middle, band.line(static_cast<int>(l)), z})) < 0.01);
                    }
                }
            }
            solid += made.total_length();
            if (z < bounds.lo.z || z > bounds.hi.z) REQUIRE(made.runs().empty());
        }
        CHECK(solid > 0);
    }
}

TEST_CASE("layers of a bar and of a foot are as many as their heights have", "[scaffold]") {
    Scaffold scaffold;
    scaffold.shape.bar_height = 0.6;
    scaffold.shape.foot_height = 0.4;
    // Heights as sums of layers, which no number of the machine holds exactly.
    const double top = 17 * 0.2;
    scaffold.bars = {{{0, 0, top}, {6, 0, top}}};
    scaffold.pillars = {{{0, 0}, 0, top - 0.6, 3.5}};
    const FieldPtr field = make_scaffold_field(scaffold);
    const auto length_at = [&](int layer) {
        const RowBand band = band_over({{-5, -0.05, 0}, {10, 0.05, 1}}, 0.1);
        const RunRows rows = runs_at(*field, (layer + 0.5) * 0.2, band);
        return static_cast<double>(rows.total_length()) / run_unit * 0.1;
    };
    for (int layer = 0; layer < 20; ++layer) {
        INFO("layer " << layer);
        const double expected = layer < 2 ? 7 : layer < 14 ? 2.5 : layer < 17 ? 6.9 : 0;
        CHECK(length_at(layer) == Approx(expected).margin(0.01));
    }
}

}  // namespace scaffold_field_test
