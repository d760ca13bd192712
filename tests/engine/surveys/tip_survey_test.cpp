// The tip survey: drawn tips of known height, what holds pieces together, random voxels against the
// definition, threads, layers of several heights, refusals.
#include "engine/surveys/tip_survey.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "engine/base/error.h"
#include "engine/checks/print_check.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/island_scenes.h"

namespace tip_survey_test {

using namespace lamella;

namespace {

FieldPtr block(dvec3 lo, dvec3 hi) { return make_box({lo, hi}); }

TipSurvey surveyed(const Job& job, double height, double pitch = 0.05, int threads = 2,
                   double contact = 0.1) {
    TipSurveyOptions options;
    options.contact = contact;
    options.pitch = pitch;
    options.height = height;
    options.threads = threads;
    return survey_tips(job, options);
}

Job trimmed(Job job, const TipSurvey& survey) {
    job.part = make_without_layer_boxes(
        job.part, survey.removed,
        [plan = job.layers, bed = job.z0()](double z) { return plan.layer_at(z - bed); });
    return job;
}

std::size_t found(const Job& job, Check check) {
    PrintCheckOptions options;
    options.limits.verdicts[static_cast<std::size_t>(check)] = Severity::fail;
    options.pitch = 0.08;
    PrintCheck checks(job, options);
    survey_layers(job, checks, {});
    return checks.report().results.front().count;
}

double volume(const Job& job) {
    PrintCheckOptions options;
    options.pitch = 0.05;
    options.limits.verdicts[static_cast<std::size_t>(Check::islands)] = Severity::fail;
    PrintCheck checks(job, options);
    survey_layers(job, checks, {});
    return checks.report().volume;
}

/// A wall on the bed with an arm at heights of 4 to 5 mm, and a tongue of 1 mm^2 that hangs below its end.
FieldPtr wall_with_tongue(double height) {
    return make_union({block({0, 0, 0}, {2, 4, 6}), block({1, 1, 4}, {6, 3, 5}),
                       block({4.5, 1.5, 4 - height}, {5.5, 2.5, 4.5})});
}

const Box room{{-1, -1, 0}, {7, 5, 6}};

}  // namespace

TEST_CASE("a tongue that hangs is removed up to where it joins", "[tips]") {
    const Job job = scenes::job_of(wall_with_tongue(0.2), room, 0.05);
    REQUIRE(found(job, Check::islands) == 1);
    const TipSurvey survey = surveyed(job, 0.2);
    CHECK(survey.trimmed == 1);
    CHECK(survey.higher == 0);
    CHECK(survey.holding == 0);
    CHECK(survey.kept.empty());
    REQUIRE(survey.on_bed.size() == 1);
    CHECK(survey.on_bed.front().z == Approx(0.025));
    CHECK(glm::distance(dvec2(survey.on_bed.front()), dvec2(1, 2)) < 2.1);
    CHECK(survey.volume == Approx(0.2).epsilon(0.06));
    const Job after = trimmed(job, survey);
    CHECK(found(after, Check::islands) == 0);
    CHECK(found(after, Check::connectivity) == 0);
    CHECK(volume(job) - volume(after) == Approx(0.2).epsilon(0.06));
    // Nothing but the tongue: the arm keeps its lower side.
    SliceContext context;
    Scratch scratch;
    RunRows rows;
    const RowBand band{.along_pitch = 0.1, .across_pitch = 0.1, .first = 0, .count = 40, .lo = -10, .hi = 70};
    for (const double z : {3.775, 3.825, 3.975, 4.025}) {
        context.slice(*after.part, z).runs(band, scratch, rows);
        const double area = static_cast<double>(rows.total_length()) / run_unit * 0.01;
        CHECK(area == Approx(z < 4 ? 8 : 16).epsilon(1e-6));
        CHECK(after.part->value({5, 2, z}) * (z < 4 ? 1 : -1) > 0);
    }
}

TEST_CASE("a tongue too high to trim stays and is counted", "[tips]") {
    const Job job = scenes::job_of(wall_with_tongue(0.5), room, 0.05);
    const TipSurvey survey = surveyed(job, 0.2);
    CHECK(survey.trimmed == 0);
    CHECK(survey.removed->empty());
    CHECK(survey.higher == 1);
    REQUIRE(survey.kept.size() == 1);
    CHECK(survey.kept.front().height == Approx(0.5));
    CHECK(survey.kept.front().first_layer == 70);
    CHECK(survey.kept.front().end_layer == 80);
    CHECK(survey.kept.front().area == Approx(1).epsilon(0.06));
    CHECK(glm::distance(dvec2(survey.kept.front().at), dvec2(5, 2)) < 0.5);
    CHECK(surveyed(job, 0.5).trimmed == 1);
}

TEST_CASE("a tongue of a single layer is removed, however high that is", "[tips]") {
    for (const double h : {0.025, 0.05, 0.1, 0.2, 0.25}) {
        const Job job = scenes::job_of(wall_with_tongue(h), room, h);
        const TipSurvey survey = surveyed(job, 0.01);
        CAPTURE(h);
        CHECK(survey.trimmed == 1);
        CHECK(found(trimmed(job, survey), Check::islands) == 0);
    }
}

TEST_CASE("a lip joins its wall where they meet", "[tips]") {
    // The lower side of a roof rises from 3.55 mm at its edge, x = 3.5, to 3.9 mm at the wall, x = 1.
    const dvec3 normal(-0.14, 0, -1);
    const FieldPtr roof = make_intersection(
        {block({1, 0.5, 3}, {3.5, 3.5, 5}), make_half_space(normal, -4.04 / glm::length(normal))});
    const Job job = scenes::job_of(make_union({block({0, 0, 0}, {1, 4, 6}), roof}), room, 0.05);
    REQUIRE(found(job, Check::islands) == 1);
    const TipSurvey stays = surveyed(job, 0.3);
    REQUIRE(stays.higher == 1);
    CHECK(stays.kept.front().height == Approx(0.35));
    const TipSurvey survey = surveyed(job, 0.4);
    CHECK(survey.trimmed == 1);
    // A wedge: 2.5 mm long, 3 mm wide, 0.35 mm high.
    CHECK(survey.volume == Approx(0.5 * 2.5 * 3 * 0.35).epsilon(0.06));
    CHECK(found(trimmed(job, survey), Check::islands) == 0);
}

TEST_CASE("a tip that joins a higher one is removed, and the higher one stays", "[tips]") {
    const FieldPtr part = make_union({wall_with_tongue(1.5), block({4.5, 1.5, 3.5}, {5.5, 3.4, 4}),
                                      block({4.6, 3, 3.4}, {5.4, 3.4, 3.6})});
    const Job job = scenes::job_of(part, room, 0.05);
    REQUIRE(found(job, Check::islands) == 2);
    const TipSurvey survey = surveyed(job, 0.2);
    CHECK(survey.trimmed == 1);
    CHECK(survey.higher == 1);
    CHECK(found(trimmed(job, survey), Check::islands) == 1);
}

TEST_CASE("what alone holds pieces together is not removed", "[tips]") {
    // Two posts with arms, and a plate below the ends of both.
    const FieldPtr posts = make_union({block({0, 0, 0}, {1, 1, 5}), block({5, 0, 0}, {6, 1, 5}),
                                       block({0, 0, 3.1}, {2, 1, 4}), block({4, 0, 3.1}, {6, 1, 4})});
    const FieldPtr part = make_union({posts, block({1.5, 0, 3}, {4.5, 1, 3.1})});
    const Job job = scenes::job_of(part, room, 0.05);
    REQUIRE(found(job, Check::connectivity) == 0);
    const TipSurvey survey = surveyed(job, 0.2);
    CHECK(survey.trimmed == 0);
    CHECK(survey.holding == 1);
    CHECK(found(trimmed(job, survey), Check::connectivity) == 0);
    // A beam higher up holds both as well.
    const Job with_beam = scenes::job_of(make_union({part, block({0, 0, 4.5}, {6, 1, 5})}), room, 0.05);
    const TipSurvey free = surveyed(with_beam, 0.2);
    CHECK(free.trimmed == 1);
    CHECK(free.holding == 0);
    CHECK(found(trimmed(with_beam, free), Check::connectivity) == 0);
}

TEST_CASE("tips are found in layers of several heights", "[tips]") {
    Job job = scenes::job_of(wall_with_tongue(0.2), room, 0.05);
    job.layers = LayerPlan({EqualLayers{1, 0.3}, EqualLayers{7, 0.5}, EqualLayers{22, 0.1}});
    const TipSurvey survey = surveyed(job, 0.2);
    CHECK(survey.trimmed == 1);
    CHECK(survey.volume == Approx(0.2).epsilon(0.06));
    CHECK(found(trimmed(job, survey), Check::islands) == 0);
}

namespace {

/// Voxels of 0.1 mm: whether each is solid, and who owns its piece of the layer.
struct Voxels {
    static constexpr int n = 14, layers = 12;
    std::array<std::array<std::array<int, n>, n>, layers> solid{}, piece{}, owner{};
};

constexpr double voxel = 0.1;

Job job_of(const Voxels& voxels) {
    std::vector<PlacedRun> runs;
    for (int k = 0; k < Voxels::layers; ++k) {
        for (int j = 0; j < Voxels::n; ++j) {
            for (int i = 0; i < Voxels::n; ++i) {
                if (voxels.solid[k][j][i] != 0) runs.push_back({k, j, i * run_unit, (i + 1) * run_unit});
            }
        }
    }
    const auto boxes = std::make_shared<RunBoxes>(SurveyGrid{{0, 0}, voxel, 0, voxel}, std::move(runs));
    const double side = Voxels::n * voxel;
    return scenes::job_of(make_box_solid(boxes), {dvec3(0), {side, side, Voxels::layers * voxel}}, voxel);
}

Voxels voxels_of(const Job& job) {
    Voxels voxels;
    for (int k = 0; k < Voxels::layers; ++k) {
        for (int j = 0; j < Voxels::n; ++j) {
            for (int i = 0; i < Voxels::n; ++i)
                voxels.solid[k][j][i] = job.part->value((dvec3(i, j, k) + 0.5) * voxel) < 0 ? 1 : 0;
        }
    }
    return voxels;
}

template <typename Visit>
void for_near(int j, int i, Visit visit) {
    for (int v = std::max(j - 1, 0); v <= std::min(j + 1, Voxels::n - 1); ++v) {
        for (int u = std::max(i - 1, 0); u <= std::min(i + 1, Voxels::n - 1); ++u) visit(v, u);
    }
}

/// Spreads numbers over the solid of a layer until each piece has the greatest of its voxels'.
void number_pieces(Voxels& voxels, int k) {
    for (int j = 0; j < Voxels::n; ++j) {
        for (int i = 0; i < Voxels::n; ++i)
            voxels.piece[k][j][i] = voxels.solid[k][j][i] * (1 + j * Voxels::n + i);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int j = 0; j < Voxels::n; ++j) {
            for (int i = 0; i < Voxels::n; ++i) {
                if (voxels.solid[k][j][i] == 0) continue;
                for_near(j, i, [&](int v, int u) {
                    if (voxels.piece[k][v][u] <= voxels.piece[k][j][i]) return;
                    voxels.piece[k][j][i] = voxels.piece[k][v][u];
                    changed = true;
                });
            }
        }
    }
}

struct Tip {
    int first, last;
};

/// Sets the owner of every voxel by the definition: 1 for what is held, from 2 on for tips, by age. Tips that
/// begin in the same layer are numbered by their first voxels.
std::vector<Tip> find_tips(Voxels& voxels) {
    std::vector<Tip> tips;
    bool any = false;
    for (int k = 0; k < Voxels::layers; ++k) {
        number_pieces(voxels, k);
        std::set<int> pieces;
        for (const auto& row : voxels.piece[k]) pieces.insert(row.begin(), row.end());
        pieces.erase(0);
        std::vector<std::pair<int, int>> by_first;  // first voxel, piece
        for (const int piece : pieces) {
            for (int at = 0; at < Voxels::n * Voxels::n; ++at) {
                if (voxels.piece[k][at / Voxels::n][at % Voxels::n] != piece) continue;
                by_first.emplace_back(at, piece);
                break;
            }
        }
        std::ranges::sort(by_first);
        for (const auto& [first, piece] : by_first) {
            int owner = any ? 1000000 : 1;
            for (int j = 0; j < Voxels::n; ++j) {
                for (int i = 0; i < Voxels::n; ++i) {
                    if (voxels.piece[k][j][i] != piece || k == 0) continue;
                    for_near(j, i, [&](int v, int u) {
                        if (voxels.owner[k - 1][v][u] > 0) owner = std::min(owner, voxels.owner[k - 1][v][u]);
                    });
                }
            }
            if (owner == 1000000) {
                owner = static_cast<int>(tips.size()) + 2;
                tips.push_back({k, k});
            }
            if (owner > 1) tips[static_cast<std::size_t>(owner - 2)].last = k;
            for (int j = 0; j < Voxels::n; ++j) {
                for (int i = 0; i < Voxels::n; ++i) {
                    if (voxels.piece[k][j][i] == piece) voxels.owner[k][j][i] = owner;
                }
            }
        }
        any |= !pieces.empty();
    }
    return tips;
}

/// Numbers the voxels' connected components over all 26 neighbours: the greatest number of their voxels'.
Voxels components_of(const Voxels& voxels) {
    Voxels found = voxels;
    int number = 0;
    for (auto& layer : found.solid) {
        for (auto& row : layer) {
            for (int& v : row) v *= ++number;
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int k = 0; k < Voxels::layers; ++k) {
            for (int j = 0; j < Voxels::n; ++j) {
                for (int i = 0; i < Voxels::n; ++i) {
                    int& here = found.solid[k][j][i];
                    if (here == 0) continue;
                    for (int w = std::max(k - 1, 0); w <= std::min(k + 1, Voxels::layers - 1); ++w) {
                        for_near(j, i, [&](int v, int u) {
                            if (found.solid[w][v][u] <= here) return;
                            here = found.solid[w][v][u];
                            changed = true;
                        });
                    }
                }
            }
        }
    }
    return found;
}

/// Returns pairs of components before and after, of voxels that are left: one for each component before that
/// is left, if none was parted.
std::set<std::pair<int, int>> parted(const Voxels& before, const Voxels& after) {
    const Voxels a = components_of(before), b = components_of(after);
    std::set<std::pair<int, int>> pairs;
    for (int k = 0; k < Voxels::layers; ++k) {
        for (int j = 0; j < Voxels::n; ++j) {
            for (int i = 0; i < Voxels::n; ++i) {
                if (b.solid[k][j][i] != 0) pairs.emplace(a.solid[k][j][i], b.solid[k][j][i]);
            }
        }
    }
    return pairs;
}

}  // namespace

TEST_CASE("tips of random voxels are those of the definition", "[tips]") {
    std::mt19937 random(41);
    std::size_t trims = 0, holds = 0, highs = 0;
    for (int round = 0; round < 150; ++round) {
        Voxels voxels;
        const auto dense = 10 + random() % 25;
        for (auto& layer : voxels.solid) {
            for (auto& row : layer) {
                for (int& v : row) v = random() % 100 < dense ? 1 : 0;
            }
        }
        const Job job = job_of(voxels);
        constexpr int most_layers = 2;
        const TipSurvey survey = surveyed(job, most_layers * voxel, voxel, 2, 0);
        const Job after_job = trimmed(job, survey);
        Voxels after = voxels_of(after_job);
        const std::vector<Tip> tips = find_tips(voxels);
        std::size_t low = 0;
        for (const Tip& tip : tips) low += tip.last - tip.first < most_layers ? 1 : 0;
        CAPTURE(round, dense);
        CHECK(survey.higher == tips.size() - low);
        CHECK(survey.trimmed + survey.holding == low);
        // Of each tip all voxels stay or none, those of high ones and all that is held stay.
        std::set<int> gone, left;
        for (int k = 0; k < Voxels::layers; ++k) {
            for (int j = 0; j < Voxels::n; ++j) {
                for (int i = 0; i < Voxels::n; ++i) {
                    const int owner = voxels.owner[k][j][i];
                    if (owner == 0) REQUIRE(after.solid[k][j][i] == 0);
                    if (owner > 0) (after.solid[k][j][i] != 0 ? left : gone).insert(owner);
                }
            }
        }
        CHECK(gone.size() == survey.trimmed);
        for (const int owner : gone) {
            CHECK(left.count(owner) == 0);
            REQUIRE(owner > 1);
            const Tip& tip = tips[static_cast<std::size_t>(owner - 2)];
            CHECK(tip.last - tip.first < most_layers);
        }
        // No new tips, and nothing parted.
        CHECK(find_tips(after).size() == survey.higher + survey.holding);
        std::set<int> before;
        const auto pairs = parted(voxels, after);
        for (const auto& pair : pairs) before.insert(pair.first);
        CHECK(pairs.size() == before.size());
        trims += survey.trimmed;
        holds += survey.holding;
        highs += survey.higher;
    }
    CHECK(trims > 500);
    CHECK(holds > 20);
    CHECK(highs > 20);
}

TEST_CASE("once tips are removed, there are none, and the others stay as they were", "[tips]") {
    std::mt19937 random(5);
    std::size_t trims = 0;
    for (int round = 0; round < 60; ++round) {
        Voxels voxels;
        const auto dense = 40 + random() % 30;
        for (auto& layer : voxels.solid) {
            for (auto& row : layer) {
                for (int& v : row) v = random() % 100 < dense ? 1 : 0;
            }
        }
        const Job job = job_of(voxels);
        const auto survey = surveyed(job, 2 * voxel, voxel, 2, voxel);
        const auto again = surveyed(trimmed(job, survey), 2 * voxel, voxel, 2, voxel);
        CAPTURE(round, dense);
        CHECK(again.trimmed == 0);
        CHECK(again.higher == survey.higher);
        CHECK(again.holding == survey.holding);
        trims += survey.trimmed;
    }
    CHECK(trims > 100);
}

TEST_CASE("a hair holds nothing", "[tips]") {
    const FieldPtr hair = block({4.9, 1.9, 0}, {4.95, 1.95, 4}), foot = block({0, 0, 0}, {6, 4, 0.5});
    const FieldPtr part = make_union({wall_with_tongue(0.2), hair, foot});
    const Job job = scenes::job_of(part, room, 0.05);
    CHECK(surveyed(job, 0.2, 0.04, 2, 0).trimmed == 0);
    const TipSurvey survey = surveyed(job, 0.2, 0.04);
    CHECK(survey.trimmed == 1);
    // Of the hair, what is beside the tongue goes.
    CHECK(survey.volume == Approx(0.2).epsilon(0.06));
    CHECK(trimmed(job, survey).part->value({5.2, 2, 3.9}) > 0);
    CHECK(trimmed(job, survey).part->value({4.925, 1.925, 2}) < 0);
}

TEST_CASE("the tip survey is the same on any number of threads", "[tips]") {
    std::mt19937 random(7);
    Voxels voxels;
    for (auto& layer : voxels.solid) {
        for (auto& row : layer) {
            for (int& v : row) v = random() % 100 < 22 ? 1 : 0;
        }
    }
    const Job job = job_of(voxels);
    const TipSurvey one = surveyed(job, 0.2, 0.06, 1, 0.05);
    for (const int threads : {2, 5}) {
        const TipSurvey other = surveyed(job, 0.2, 0.06, threads, 0.05);
        CHECK(*one.removed == *other.removed);
        CHECK(one.trimmed == other.trimmed);
        CHECK(one.higher == other.higher);
        CHECK(one.volume == other.volume);
        REQUIRE(one.kept.size() == other.kept.size());
        for (std::size_t i = 0; i < one.kept.size(); ++i) CHECK(one.kept[i].at == other.kept[i].at);
    }
    REQUIRE(one.trimmed > 5);
}

TEST_CASE("what the tip survey cannot do is refused", "[tips]") {
    const Job job = scenes::job_of(wall_with_tongue(0.2), room, 0.05);
    CHECK_THROWS_AS(surveyed(job, 0.2, 0), InputError);
    CHECK_THROWS_AS(surveyed(job, 0.2, 100), InputError);
    TipSurveyOptions options;
    options.max_kept = 3;
    CHECK_THROWS_WITH(survey_tips(job, options), Catch::Contains("accepted: lower tips"));
}

}  // namespace tip_survey_test
