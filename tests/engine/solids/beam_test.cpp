// Beams: distance, cut, and the SIMD kernel against each other and against dense sampling.
#include "engine/solids/beam.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/base/simd_target.h"
#include "engine/field/slice_context.h"
#include "engine/solids/beam_slice.h"

namespace beam_test {

using namespace lamella;

namespace {

Beam random_beam(std::mt19937& random) {
    std::uniform_real_distribution<double> at(-3, 3), radius(0.05, 0.9);
    return {{at(random), at(random), at(random)},
            radius(random),
            {at(random), at(random), at(random)},
            radius(random)};
}

/// Distance to the hull of two balls as the least distance to any ball between them.
double sampled_distance(const Beam& beam, dvec3 p) {
    double best = infinity;
    constexpr int steps = 4000;
    for (int k = 0; k <= steps; ++k) {
        const double s = k / static_cast<double>(steps);
        best = std::min(
            best, glm::length(p - (beam.a + (beam.b - beam.a) * s)) - (beam.ra + (beam.rb - beam.ra) * s));
    }
    return best;
}

class OneBeam : public Field {
  public:
    explicit OneBeam(const Beam& beam) : beam_(beam) {}
    double value(dvec3 p) const override { return signed_distance(beam_, p); }
    Box bounds() const override { return lamella::bounds(beam_); }

  private:
    Beam beam_;
};

}  // namespace

TEST_CASE("the distance to a beam is the least distance to the balls between its ends") {
    const unsigned seed = 21;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-4, 4);
    for (int round = 0; round < 60; ++round) {
        const Beam beam = random_beam(random);
        for (int k = 0; k < 10; ++k) {
            const dvec3 p(at(random), at(random), at(random));
            REQUIRE(signed_distance(beam, p) == Approx(sampled_distance(beam, p)).margin(2e-6));
        }
    }
}

TEST_CASE("a line cuts a beam exactly where the distance is negative") {
    const unsigned seed = 22;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-3, 3);
    int hits = 0;
    for (int round = 0; round < 4000; ++round) {
        Beam beam = random_beam(random);
        dvec3 direction(at(random), at(random), at(random));
        if (round % 3 == 0) direction = beam.b - beam.a;            // along the axis
        if (round % 7 == 0) beam.b = beam.a + dvec3(0.1, 0.05, 0);  // ball within ball, often
        direction = direction / glm::length(direction);
        const dvec3 p = beam.a + dvec3(at(random), at(random), at(random)) * (round % 3 == 0 ? 0.2 : 0.6);
        const auto solid = cut(beam, p, direction);
        if (solid) ++hits;
        for (int k = 0; k < 60; ++k) {
            const double t = at(random) * 2;
            const double v = signed_distance(beam, p + direction * t);
            if (std::abs(v) < 1e-7) continue;
            INFO("round " << round << ", t " << t << ", distance " << v);
            REQUIRE((v < 0) == (solid && solid->lo < t && t < solid->hi));
        }
    }
    REQUIRE(hits > 1000);
}

TEST_CASE("the row kernel equals the exact cut to a run unit, on rows and columns, whichever way they run") {
    const unsigned seed = 23;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(-1, 1);
    Scratch scratch;
    for (int round = 0; round < 1500; ++round) {
        Beam beam = random_beam(random);
        if (round % 2 == 0) beam.rb = beam.ra;
        if (round % 5 == 0) beam.b.y = beam.a.y + 0.01 * at(random);
        if (round % 10 == 0) beam.b.z = beam.a.z;
        const double z = (beam.a.z + beam.b.z) * 0.5 + 0.5 * at(random);
        const OneBeam field(beam);
        const BeamSlice slice(field, {beam}, z);
        RowBand band{round % 3 == 0 ? Axis::y : Axis::x, -5, 0.05, -5, 0.05, 0, 200, 2, 0, 200};
        if (round % 4 == 1) band.along_origin = 5, band.along_pitch = -0.05;
        if (round % 4 == 2) band.across_origin = 5, band.across_pitch = -0.05;
        RunRows rows;
        slice.runs(band, scratch, rows);
        const dvec3 direction = band.axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        for (int l = 0; l < band.lines(); ++l) {
            const double v = band.line(l);
            const auto exact = cut(beam, band.axis == Axis::x ? dvec3(0, v, z) : dvec3(v, 0, z), direction);
            const auto line = rows.line(static_cast<std::size_t>(l));
            REQUIRE(line.size() <= 1);
            INFO("round " << round << ", line " << l);
            if (!exact) {
                REQUIRE((line.empty() || line[0].end - line[0].begin < 40));
                continue;
            }
            const double u0 = band.coordinate(exact->lo), u1 = band.coordinate(exact->hi);
            // A grazing line has a short run whose ends are ill-conditioned: its depth is what is exact.
            const double slack = 1.01 + (std::abs(u1 - u0) < 200 ? 20 : 0);
            if (line.empty()) {
                REQUIRE(std::abs(u1 - u0) < 40);
            } else {
                REQUIRE(line[0].begin == Approx(std::min(u0, u1)).margin(slack));
                REQUIRE(line[0].end == Approx(std::max(u0, u1)).margin(slack));
            }
        }
    }
}

TEST_CASE("every SIMD target gives the same bits") {
    const unsigned seed = 24;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::vector<Beam> beams;
    for (int k = 0; k < 400; ++k) beams.push_back(random_beam(random));
    const OneBeam field(beams[0]);
    const RowBand band{Axis::x, -5, 0.01, -5, 0.01, 0, 1000, 3, 0, 1000};
    std::vector<RunRows> results;
    const auto targets = simd_targets();
    REQUIRE(targets.size() >= 2);
    for (const std::string& target : targets) {
        force_simd_target(target);
        Scratch scratch;
        results.emplace_back();
        BeamSlice(field, beams, 0.1).runs(band, scratch, results.back());
    }
    force_simd_target("");
    for (std::size_t k = 0; k < results.size(); ++k) {
        INFO("target " << targets[k]);
        REQUIRE(results[k].runs().size() > 1000);
        REQUIRE(results[k] == results[0]);
    }
}

}  // namespace beam_test
