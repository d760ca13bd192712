// Thinness across layers: the same, to the unit, as when every place where the ball fits is looked for.
#include "engine/morphology/thin_feature_search.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/layers/survey_rows.h"
#include "engine/morphology/sampled_ball.h"
#include "engine/runs/row_sets.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/foam/voronoi_foam.h"
#include "tests/engine/morphology/through_layers.h"

namespace thin_feature_search_test {

using namespace lamella;
using namespace lamella::test;

namespace {

using Stack = std::vector<RunRows>;

/// Layers all about each of a stack's.
class About {
  public:
    About(const Stack& stack, const BallLines& ball) : stack_(stack), reach_(ball.layers()) {}
    std::vector<const RunRows*> operator()(int layer) const {
        std::vector<const RunRows*> about;
        for (int k = layer - reach_; k <= layer + reach_; ++k) {
            const bool is_there = k >= 0 && k < static_cast<int>(stack_.size());
            about.push_back(is_there ? &stack_[static_cast<std::size_t>(k)] : nullptr);
        }
        return about;
    }

  private:
    const Stack& stack_;
    int reach_;
};

Stack without_what_is_near(const Stack& from, const Stack& taken, const BallLines& ball) {
    const About about(taken, ball);
    RunDifference runs;
    Stack left(from.size());
    for (std::size_t z = 0; z < from.size(); ++z) {
        const std::vector<const RunRows*> beside = about(static_cast<int>(z));
        for (std::size_t l = 0; l < from[z].lines(); ++l) {
            runs.assign(from[z].line(l));
            for (const BallLines::Line& line : ball.lines()) {
                const RunRows* rows = beside[static_cast<std::size_t>(line.layer + ball.layers())];
                const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(l) + line.row;
                if (rows == nullptr || row < 0 || row >= static_cast<std::ptrdiff_t>(rows->lines())) continue;
                if (!runs.empty()) runs.subtract(rows->line(static_cast<std::size_t>(row)), line.reach);
            }
            left[z].append_line(runs.all());
        }
    }
    return left;
}

/// By definition, with void all about.
Stack all_thin(const Stack& stack, const LayerLattice& lattice, const Thinness& thinness, FeatureKind kind) {
    const BallLines fitting(lattice, thinness.radius), near(lattice, thinness.radius + thinness.slack);
    const auto rows = static_cast<std::size_t>(fitting.rows() + near.rows()),
               layers = static_cast<std::size_t>(fitting.layers() + near.layers());
    Stack solid(layers, empty_rows(lattice.lines + 2 * rows)), voids;
    for (const RunRows& layer : stack) {
        solid.emplace_back();
        solid.back().end_lines(rows);
        solid.back().append_lines(layer);
        solid.back().end_lines(rows);
    }
    solid.resize(solid.size() + layers, empty_rows(lattice.lines + 2 * rows));
    for (const RunRows& layer : solid) voids.push_back(complement(layer, -unbounded, unbounded));
    if (kind == FeatureKind::gap) std::swap(solid, voids);
    const Stack thin = without_what_is_near(solid, without_what_is_near(solid, voids, fitting), near);
    Stack inner(stack.size());
    for (std::size_t z = 0; z < stack.size(); ++z)
        inner[z].append_lines(thin[z + layers], rows, lattice.lines);
    return inner;
}

/// Rows 0.1 mm apart of a foam in a box, layers 0.05 mm apart.
Stack foam(double beam_radius) {
    FoamSettings settings;
    settings.cell = 4;
    settings.beam_radius = beam_radius;
    settings.seed = 7;
    settings.region = {dvec3(0), {9, 8, 3}};
    const FieldPtr solid = make_union({make_voronoi_foam(settings), make_box({{0, 0, 0}, {9, 0.8, 3}}),
                                       make_sphere({5, 5, 1.5}, 1.4), make_box({{6, 4, 1}, {9, 8, 1.4}})});
    Stack stack;
    for (int z = 0; z < 60; ++z) {
        SliceContext context;
        Scratch scratch;
        stack.push_back(
            all_rows(context.slice(*solid, (z + 0.5) * 0.05), rows_over({{0, 0}, {9, 8}}, 0.1), scratch));
    }
    return stack;
}

std::int64_t length_of(const Stack& stack) {
    std::int64_t sum = 0;
    for (const RunRows& rows : stack) sum += rows.total_length();
    return sum;
}

}  // namespace

TEST_CASE("layers of a foam are thin where no place near has room for the ball", "[morphology]") {
    for (const double beam_radius : {0.3, 0.4, 0.5}) {
        const Stack stack = foam(beam_radius);
        for (const auto& [kind, thickness] : {std::pair{FeatureKind::wall, 0.8}, {FeatureKind::gap, 0.5}}) {
            INFO("beams of " << beam_radius << ", kind " << static_cast<int>(kind));
            const RowBand band = rows_over({{0, 0}, {9, 8}}, 0.1);
            const SampledBall ball = sampled_ball(band, 0.05, thickness, thickness);
            const Thinness thinness{ball.radius, 1.5 * ball.radius + run_unit};
            const Stack thin = through(ThinFeatureSearch(ball.lattice, thinness, kind), stack);
            const Stack expected = all_thin(stack, ball.lattice, thinness, kind);
            REQUIRE(thin.size() == expected.size());
            for (std::size_t z = 0; z < thin.size(); ++z) CHECK(thin[z] == expected[z]);
            if (kind == FeatureKind::wall && beam_radius < 0.35)
                CHECK(length_of(thin) > length_of(stack) / 4);
            if (kind == FeatureKind::gap) CHECK(length_of(thin) > 0);
            CHECK(length_of(thin) < length_of(stack));
        }
    }
}

TEST_CASE("layers at random are thin where no place near has room for the ball", "[morphology]") {
    for (const unsigned seed : {1U, 2U, 3U}) {
        INFO("seed " << seed);
        std::mt19937 random(seed);
        std::uniform_int_distribution<int> gap(run_unit / 3, 4 * run_unit), run(run_unit, 30 * run_unit);
        Stack stack(25);
        for (RunRows& layer : stack) {
            for (int l = 0; l < 20; ++l) {
                for (int u = gap(random); u < 60 * run_unit;) {
                    const int end = u + run(random);
                    layer.push(u, end);
                    u = end + gap(random);
                }
                layer.end_line();
            }
        }
        for (const FeatureKind kind : {FeatureKind::wall, FeatureKind::gap}) {
            for (const double radius : {1.2, 1.7, 2.6}) {
                for (const double layer_pitch : {0.9, 100.0}) {  // balls that reach some layers, or none
                    const LayerLattice lattice{1.1 * run_unit, layer_pitch * run_unit, 20};
                    const Thinness thinness{radius * run_unit, 1.3 * run_unit};
                    const Stack thin = through(ThinFeatureSearch(lattice, thinness, kind), stack);
                    CHECK(thin == all_thin(stack, lattice, thinness, kind));
                    CHECK(length_of(thin) > 0);
                }
            }
        }
    }
}

}  // namespace thin_feature_search_test
