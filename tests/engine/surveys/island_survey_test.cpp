// The island survey: known scenes, random balls against a flood fill, foam cut by a ball, threads, refusals.
#include "engine/surveys/island_survey.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "engine/base/error.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "procedural/foam/voronoi_foam.h"
#include "tests/engine/surveys/island_scenes.h"

namespace island_survey_test {

using namespace lamella;

namespace {

IslandSurvey surveyed(const Job& job, const FieldPtr& body = nullptr, double pitch = 0.1, int threads = 2) {
    IslandSurveyOptions options;
    options.pitch = pitch;
    options.threads = threads;
    return survey_islands(job, body, options);
}

Job without(Job job, const IslandSurvey& survey) {
    job.part = make_without_boxes(job.part, survey.dropped);
    return job;
}

FieldPtr beam(dvec3 a, dvec3 b, double radius) { return make_round_cone({a, radius, b, radius}); }

/// A solid as voxels, and the components of a flood fill over them, numbered from 0; -1 is empty.
struct Voxels {
    int n = 0;
    double size = 0;  ///< mm
    dvec3 origin{0};
    std::vector<int> label;
    std::vector<std::size_t> sizes;

    std::size_t index(int i, int j, int k) const { return static_cast<std::size_t>((k * n + j) * n + i); }
    dvec3 place(int i, int j, int k) const { return origin + (dvec3(i, j, k) + 0.5) * size; }
    int at(dvec3 p) const {
        const dvec3 v = (p - origin) / size;
        return label[index(static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z))];
    }
    int largest() const {
        return static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    }
    template <typename Visit>
    void each(Visit visit) const {
        for (int k = 0; k < n; ++k) {
            for (int j = 0; j < n; ++j) {
                for (int i = 0; i < n; ++i) visit(i, j, k);
            }
        }
    }
};

/// Labels one component from a voxel on, over all 26 neighbours.
void flood(Voxels& voxels, std::array<int, 3> from, int unseen) {
    const int id = static_cast<int>(voxels.sizes.size());
    voxels.sizes.push_back(0);
    std::vector<std::array<int, 3>> open{from};
    voxels.label[voxels.index(from[0], from[1], from[2])] = id;
    while (!open.empty()) {
        const auto at = open.back();
        open.pop_back();
        ++voxels.sizes.back();
        std::array<int, 3> lo{}, hi{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lo[axis] = std::max(at[axis] - 1, 0);
            hi[axis] = std::min(at[axis] + 1, voxels.n - 1);
        }
        for (int w = lo[2]; w <= hi[2]; ++w) {
            for (int v = lo[1]; v <= hi[1]; ++v) {
                for (int u = lo[0]; u <= hi[0]; ++u) {
                    int& label = voxels.label[voxels.index(u, v, w)];
                    if (label != unseen) continue;
                    label = id;
                    open.push_back({u, v, w});
                }
            }
        }
    }
}

Voxels flooded(const Field& part, const Box& cube, int n) {
    constexpr int unseen = -2;
    Voxels voxels{n, cube.size().x / n, cube.lo, {}, {}};
    voxels.each([&](int i, int j, int k) {
        voxels.label.push_back(part.value(voxels.place(i, j, k)) < 0 ? unseen : -1);
    });
    voxels.each([&](int i, int j, int k) {
        if (voxels.label[voxels.index(i, j, k)] == unseen) flood(voxels, {i, j, k}, unseen);
    });
    return voxels;
}

/// All runs of a job in rows a pitch apart, layer by layer, row by row.
std::vector<PlacedRun> all_runs(const Job& job, double pitch) {
    std::vector<PlacedRun> runs;
    const int n = static_cast<int>(job.bounds.size().x / pitch) + 1;
    const RowBand band{Axis::x, job.bounds.lo.x, pitch, job.bounds.lo.y, pitch, 0, n, 1, 0, n};
    for (int layer = 0; layer < job.layers.count(); ++layer) {
        RunRows rows;
        Layer(job, layer).runs(band, rows);
        for (int r = 0; r < n; ++r) {
            for (const Run& run : rows.line(static_cast<std::size_t>(r))) {
                runs.push_back({layer, r, run.begin, run.end});
            }
        }
    }
    return runs;
}

/// The runs' components, every pair compared: joined within two pitches, two rows and two layers between
/// them. The number of a component is its first run's.
std::vector<std::size_t> joined_pair_by_pair(const std::vector<PlacedRun>& runs) {
    std::vector<std::size_t> parents(runs.size());
    const auto root = [&](std::size_t i) {
        while (parents[i] != i) i = parents[i] = parents[parents[i]];
        return i;
    };
    std::size_t oldest = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        parents[i] = i;
        while (runs[i].layer - runs[oldest].layer > 3) ++oldest;
        for (std::size_t k = oldest; k < i; ++k) {
            const PlacedRun &a = runs[k], &b = runs[i];
            const bool near = std::abs(b.row - a.row) <= 3 && a.begin <= b.end + 2 * run_unit &&
                              b.begin <= a.end + 2 * run_unit;
            if (!near) continue;
            const std::size_t p = root(k), q = root(i);
            parents[std::max(p, q)] = std::min(p, q);
        }
    }
    for (std::size_t i = 0; i < runs.size(); ++i) parents[i] = root(i);
    return parents;
}

}  // namespace

TEST_CASE("balls beside a block are islands, with their volumes and boxes") {
    const FieldPtr block = make_box({{0, 0, 0}, {6, 6, 6}});
    const FieldPtr scene = make_union(
        {block, make_sphere({8, 3, 3}, 1), make_sphere({3, 3, 8}, 0.7), make_sphere({-3, 2, 1}, 0.5)});
    const Job job = scenes::job_of(scene, {{-4, -1, 0}, {10, 7, 9}}, 0.05);
    const IslandSurvey survey = surveyed(job);
    const IslandReport& report = survey.report;
    REQUIRE(report.components == 4);
    REQUIRE(report.count == 3);
    REQUIRE(report.bodies == 1);
    REQUIRE(report.too_large == 0);
    REQUIRE(report.largest.size() == 3);
    const double radii[] = {1, 0.7, 0.5};
    const dvec3 centers[] = {{8, 3, 3}, {3, 3, 8}, {-3, 2, 1}};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double volume = 4 * pi / 3 * radii[i] * radii[i] * radii[i];
        sum += volume;
        REQUIRE(report.largest[i].volume == Approx(volume).epsilon(0.03));
        REQUIRE(report.largest[i].dropped);
        for (int k = 0; k < 3; ++k) {
            REQUIRE(report.largest[i].box.lo[k] == Approx(centers[i][k] - radii[i]).margin(0.11));
            REQUIRE(report.largest[i].box.hi[k] == Approx(centers[i][k] + radii[i]).margin(0.11));
        }
    }
    REQUIRE(report.volume == Approx(sum).epsilon(0.02));
    REQUIRE(report.part_volume == Approx(216 + sum).epsilon(0.02));
    REQUIRE(report.largest[1].first_layer == Approx(7.3 / 0.05).margin(2));
    REQUIRE(report.largest[1].end_layer == Approx(8.7 / 0.05).margin(2));

    const IslandSurvey second = surveyed(without(job, survey));
    REQUIRE(second.report.count == 0);
    REQUIRE(second.report.part_volume == Approx(report.part_volume - report.volume).epsilon(1e-9));
    // Nothing of the balls was left between the rows.
    REQUIRE(surveyed(without(job, survey), nullptr, 0.025).report.count == 0);
}

TEST_CASE("a bar through the hole of a ring that it does not touch is an island; touching, it is none") {
    const FieldPtr ring = make_torus({0, 0, 3}, 2, 0.5);
    const Box bounds{{-3, -3, 0}, {3, 3, 6}};
    const IslandSurvey free =
        surveyed(scenes::job_of(make_union({ring, beam({0, 0, 1}, {0, 0, 5}, 0.4)}), bounds, 0.05));
    REQUIRE(free.report.count == 1);
    REQUIRE(free.report.largest[0].volume < 4);
    const IslandSurvey held =
        surveyed(scenes::job_of(make_union({ring, beam({0, 0, 3}, {1.4, 0, 3}, 0.4)}), bounds, 0.05));
    REQUIRE(held.report.count == 0);
    REQUIRE(held.report.components == 1);
    REQUIRE(held.dropped->empty());
}

TEST_CASE("what is joined at the top only, or by way of a spiral, is one") {
    const FieldPtr legs = make_union({beam({0, 0, 0.5}, {0, 0, 6}, 0.4), beam({4, 0, 0.5}, {4, 0, 6}, 0.4),
                                      beam({0, 0, 6}, {4, 0, 6}, 0.4)});
    REQUIRE(surveyed(scenes::job_of(legs, {{-1, -1, 0}, {5, 1, 7}}, 0.05)).report.components == 1);
    std::vector<FieldPtr> turns;
    const auto point = [](int i) {
        const double t = i * pi / 8;
        return dvec3(2 * std::cos(t), 2 * std::sin(t), 0.5 + i * 0.12);
    };
    for (int i = 0; i < 48; ++i) turns.push_back(beam(point(i), point(i + 1), 0.3));
    const Box bounds{{-3, -3, 0}, {3, 3, 7}};
    REQUIRE(surveyed(scenes::job_of(make_union(turns), bounds, 0.05)).report.components == 1);
    // A spiral with a gap is two, and the shorter part is the island.
    turns.erase(turns.begin() + 30, turns.begin() + 34);
    const IslandSurvey broken = surveyed(scenes::job_of(make_union(turns), bounds, 0.05));
    REQUIRE(broken.report.count == 1);
    REQUIRE(broken.report.largest[0].box.lo.z > 4);
}

TEST_CASE("each component of the body keeps its largest piece, however close bodies stand") {
    const FieldPtr left = make_box({{0, 0, 0}, {4, 4, 4}}), right = make_box({{4.1, 0, 0}, {8, 4, 4}});
    const FieldPtr far = make_box({{12, 0, 0}, {15, 4, 4}});
    const FieldPtr body = make_union({left, right, far});
    const FieldPtr part = make_union({make_sphere({1.5, 1.5, 1.5}, 1.2), make_sphere({3.3, 3.3, 3.3}, 0.4),
                                      make_sphere({6.5, 2, 2}, 0.9), make_sphere({13, 1, 1}, 0.3),
                                      make_sphere({14, 3, 3}, 0.5)});
    const Job job = scenes::job_of(part, {{-1, -1, 0}, {16, 5, 5}}, 0.05);
    const IslandSurvey survey = surveyed(job, body);
    REQUIRE(survey.report.bodies == 3);
    REQUIRE(survey.report.components == 5);
    REQUIRE(survey.report.count == 2);
    const auto& largest = survey.report.largest;
    REQUIRE(largest[0].box.center().x == Approx(3.3).margin(0.1));
    REQUIRE(largest[1].box.center().x == Approx(13).margin(0.1));
    const FieldPtr cleared = without(job, survey).part;
    REQUIRE(cleared->value({6.5, 2, 2}) < 0);
    REQUIRE(cleared->value({14, 3, 3}) < 0);
    REQUIRE(cleared->value({13, 1, 1}) > 0);
    // Without a body all five are one group.
    REQUIRE(surveyed(job).report.count == 4);
}

TEST_CASE("a component that spans two bodies is no island when it is the largest of one") {
    const FieldPtr body = make_union({make_box({{0, 0, 0}, {4, 4, 4}}), make_box({{5, 0, 0}, {9, 4, 4}})});
    const FieldPtr part = make_union({beam({3, 1, 1}, {6, 1, 1}, 0.4), make_sphere({7, 3, 2}, 0.9)});
    const IslandSurvey survey = surveyed(scenes::job_of(part, {{-1, -1, 0}, {10, 5, 5}}, 0.05), body);
    REQUIRE(survey.report.components == 2);
    REQUIRE(survey.report.count == 0);
}

TEST_CASE("an island that is too large to be debris is reported and left alone") {
    const FieldPtr scene = make_union({make_box({{0, 0, 0}, {6, 6, 6}}), make_sphere({9, 3, 3}, 2)});
    const Job job = scenes::job_of(scene, {{-1, -1, 0}, {12, 7, 7}}, 0.1);
    IslandSurveyOptions options;
    options.max_runs = 200;
    const IslandSurvey survey = survey_islands(job, nullptr, options);
    REQUIRE(survey.report.count == 1);
    REQUIRE(survey.report.too_large == 1);
    REQUIRE_FALSE(survey.report.largest[0].dropped);
    REQUIRE(survey.report.largest[0].volume == Approx(4 * pi / 3 * 8).epsilon(0.02));
    REQUIRE(survey.dropped->empty());
    options.max_kept = 10;
    REQUIRE_THROWS_AS(survey_islands(job, nullptr, options), InputError);
}

TEST_CASE("random balls fall into the components of a flood fill over voxels") {
    const unsigned seed = 8;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> at(1, 9), radius(0.35, 1.1);
    std::size_t islands = 0;
    for (int round = 0; round < 6; ++round) {
        // Balls overlap well or stand well apart, so that the voxels' own resolution does not matter.
        std::vector<std::pair<dvec3, double>> balls;
        std::vector<FieldPtr> solids;
        for (int attempt = 0; attempt < 400; ++attempt) {
            const dvec3 center(at(random), at(random), at(random));
            const double r = radius(random);
            const bool clear = std::all_of(balls.begin(), balls.end(), [&](const auto& ball) {
                const double gap = glm::length(center - ball.first) - r - ball.second;
                return gap > 0.7 || gap < -0.25;
            });
            if (!clear) continue;
            balls.emplace_back(center, r);
            solids.push_back(make_sphere(center, r));
        }
        INFO("round " << round << ", " << balls.size() << " balls");
        const Job job = scenes::job_of(make_union(solids), {dvec3(-0.5), dvec3(10.5)}, 0.125);
        const Voxels voxels = flooded(*job.part, job.bounds, 88);
        const IslandSurvey survey = surveyed(job, nullptr, 0.125);
        REQUIRE(survey.report.components == voxels.sizes.size());
        REQUIRE(survey.report.count == voxels.sizes.size() - 1);
        auto sizes = voxels.sizes;
        std::sort(sizes.rbegin(), sizes.rend());
        for (std::size_t i = 0; i < std::min<std::size_t>(survey.report.largest.size(), 3); ++i) {
            REQUIRE(survey.report.largest[i].volume ==
                    Approx(static_cast<double>(sizes[i + 1]) * 0.125 * 0.125 * 0.125).epsilon(0.05));
        }
        islands += survey.report.count;
        const Job cleared = without(job, survey);
        for (const auto& [center, r] : balls) {
            REQUIRE((cleared.part->value(center) < 0) == (voxels.at(center) == voxels.largest()));
        }
        REQUIRE(surveyed(cleared, nullptr, 0.125).report.count == 0);
    }
    REQUIRE(islands > 20);
}

TEST_CASE("of a foam cut by its body, what floats free is dropped and nothing else is touched") {
    const FieldPtr ball = make_sphere({0, 0, 0}, 3);
    const FieldPtr rind = make_difference(ball, make_sphere({0, 0, 0}, 2.6));
    for (const FieldPtr& body : {ball, rind}) {
        FoamSettings settings;
        settings.cell = 1.4;
        settings.beam_radius = 0.1;
        settings.seed = 4;
        settings.region = body->bounds();
        const FieldPtr part = make_intersection({body, make_voronoi_foam(settings)});
        const Job job = scenes::job_of(part, body->bounds(), 0.05);
        constexpr double pitch = 0.05;
        const IslandSurvey survey = surveyed(job, body, pitch);
        INFO((body == ball ? "ball" : "rind") << ", " << survey.report.count << " islands");
        REQUIRE(survey.report.bodies == 1);
        REQUIRE(survey.report.count >= (body == ball ? 1 : 8));
        REQUIRE(survey.report.too_large == 0);
        const Job cleared = without(job, survey);
        const IslandSurvey second = surveyed(cleared, body, pitch);
        REQUIRE(second.report.count == 0);
        REQUIRE(second.report.components == 1);
        REQUIRE(second.report.part_volume ==
                Approx(survey.report.part_volume - survey.report.volume).epsilon(1e-9));

        const std::vector<PlacedRun> runs = all_runs(job, pitch);
        const std::vector<std::size_t> component = joined_pair_by_pair(runs);
        std::map<std::size_t, std::int64_t> lengths;
        for (std::size_t i = 0; i < runs.size(); ++i) lengths[component[i]] += runs[i].end - runs[i].begin;
        const auto shorter = [](const auto& a, const auto& b) { return a.second < b.second; };
        const std::size_t largest = std::max_element(lengths.begin(), lengths.end(), shorter)->first;
        std::vector<PlacedRun> expected;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            if (component[i] == largest) expected.push_back(runs[i]);
        }
        REQUIRE(survey.report.components == lengths.size());
        REQUIRE(all_runs(cleared, pitch) == expected);
    }
}

TEST_CASE("the plan does not depend on the number of threads") {
    const FieldPtr ball = make_sphere({0, 0, 0}, 5);
    FoamSettings settings;
    settings.cell = 2.4;
    settings.beam_radius = 0.2;
    settings.region = ball->bounds();
    const Job job =
        scenes::job_of(make_intersection({ball, make_voronoi_foam(settings)}), ball->bounds(), 0.05);
    const IslandSurvey one = surveyed(job, ball, 0.1, 1);
    REQUIRE(one.report.count > 0);
    for (const int threads : {2, 4, 7}) {
        const IslandSurvey many = surveyed(job, ball, 0.1, threads);
        REQUIRE(*many.dropped == *one.dropped);
        REQUIRE(many.report.volume == one.report.volume);
        REQUIRE(many.report.part_volume == one.report.part_volume);
        REQUIRE(many.report.largest.size() == one.report.largest.size());
        for (std::size_t i = 0; i < one.report.largest.size(); ++i) {
            REQUIRE(many.report.largest[i].volume == one.report.largest[i].volume);
            REQUIRE(many.report.largest[i].box.lo == one.report.largest[i].box.lo);
        }
    }
}

TEST_CASE("a survey tells how far it is, and stops when asked") {
    const Job job = scenes::job_of(make_sphere({0, 0, 2}, 2), {{-2, -2, 0}, {2, 2, 4}}, 0.1);
    IslandSurveyOptions options;
    std::vector<int> done;
    double volume = 0;
    options.on_progress = [&](const Progress& progress) {
        done.push_back(progress.done);
        volume = progress.volume;
        REQUIRE(progress.total == 40);
    };
    REQUIRE(survey_islands(job, nullptr, options).report.count == 0);
    REQUIRE(done.size() == 40);
    REQUIRE(done.back() == 40);
    REQUIRE(volume == Approx(4 * pi / 3 * 8).epsilon(0.01));
    CancelToken cancel;
    options.cancel = &cancel;
    options.on_progress = [&](const Progress& progress) {
        if (progress.done == 5) cancel.cancel();
    };
    REQUIRE_THROWS_AS(survey_islands(job, nullptr, options), Interrupted);
}

TEST_CASE("a pitch that does not suit the job is refused with what would") {
    const Job job = scenes::job_of(make_sphere({0, 0, 2}, 2), {{-2, -2, 0}, {2, 2, 4}}, 0.1);
    for (const double pitch : {0.0, -1.0, static_cast<double>(NAN), infinity, 1e-9, 1.7}) {
        IslandSurveyOptions options;
        options.pitch = pitch;
        REQUIRE_THROWS_AS(survey_islands(job, nullptr, options), InputError);
    }
    Job endless = job;
    endless.bounds.hi.x = infinity;
    REQUIRE_THROWS_AS(survey_islands(endless, nullptr, {}), InputError);
}

TEST_CASE("a part without a solid has no components and no islands") {
    const IslandSurvey survey = surveyed(scenes::job_of(make_empty(), {dvec3(0), dvec3(1)}, 0.1));
    REQUIRE(survey.report.components == 0);
    REQUIRE(survey.report.count == 0);
    REQUIRE(survey.report.part_volume == 0);
    REQUIRE(survey.dropped->empty());
}

}  // namespace island_survey_test
