// The points along outlines and under ceilings against a brute-force twin, in random scenes.
#include "engine/surveys/overhang_paths.h"

#include <catch2/catch.hpp>
#include <random>

#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "tests/engine/surveys/overhang_scenes.h"

namespace overhang_paths_test {

using namespace lamella;
using overhangs::disc_meets;
using overhangs::height;
using overhangs::near_point;

namespace {

struct Sampled {
    std::vector<dvec2> at;  ///< about a step apart along a closed outline
};

std::vector<Sampled> outlines(const Job& job, int layer, double step) {
    std::vector<Sampled> sampled;
    for (const Contour& contour : Layer(job, layer).contours(0.02)) {
        Sampled s;
        const std::size_t n = contour.points.size();
        for (std::size_t k = 0; k < n; ++k) {
            const dvec2 a = contour.points[k], b = contour.points[(k + 1) % n];
            const int parts = std::max(1, static_cast<int>(std::ceil(glm::length(b - a) / step)));
            for (int p = 0; p < parts; ++p) s.at.push_back(a + (b - a) * (double(p) / parts));
        }
        sampled.push_back(std::move(s));
    }
    return sampled;
}

/// Whether a stretch of an outline may be left hanging.
bool may_hang(const std::vector<dvec2>& stretch, const OverhangLimits& limits, double slack) {
    double length = 0;
    for (std::size_t k = 1; k < stretch.size(); ++k) length += glm::length(stretch[k] - stretch[k - 1]);
    if (length <= limits.free_stretch + slack) return true;
    const dvec2 chord = stretch.back() - stretch.front();
    const double span = glm::length(chord);
    if (span > limits.bridge + slack || span == 0) return false;
    return std::all_of(stretch.begin(), stretch.end(), [&](dvec2 p) {
        const dvec2 d = p - stretch.front();
        return std::abs(chord.x * d.y - chord.y * d.x) / span <= limits.width / 2 + slack;
    });
}

}  // namespace

TEST_CASE("by brute force, all that hangs in random scenes is held, and nothing else is") {
    std::mt19937 random(20);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto between = [&](double lo, double hi) { return lo + (hi - lo) * unit(random); };
    const OverhangSurveyOptions options = overhangs::without_stability();
    const OverhangLimits& limits = options.limits;
    constexpr double step = 0.15, slack = 0.4, band = 0.12;
    std::size_t hanging = 0, points = 0, left_hanging = 0;
    for (int scene = 0; scene < 8; ++scene) {
        std::vector<FieldPtr> solids;
        for (int k = 0; k < 6; ++k) {
            const dvec3 p(between(0, 14), between(0, 14), between(0, 10));
            const dvec3 q(between(0, 14), between(0, 14), between(0, 10));
            switch (k % 3) {
                case 0:
                    solids.push_back(make_sphere(p, between(1, 4)));
                    break;
                case 1:
                    solids.push_back(make_round_cone({p, between(0.4, 1.5), q, between(0.4, 1.5)}));
                    break;
                default:
                    solids.push_back(make_box({p, p + dvec3(between(1, 9), between(1, 9), between(1, 4))}));
            }
        }
        const FieldPtr part = make_union(solids);
        const Job job = scenes::job_of(part, {{-5, -5, 0}, {24, 24, 12}}, height);
        const OverhangSurvey survey = survey_overhangs(job, options);
        points += survey.points.size();
        INFO("scene " << scene << ", " << survey.points.size() << " points");
        for (int layer = 1; layer < job.layers.count(); ++layer) {
            const double z = layer * height;
            std::vector<dvec2> overhanging;  // by a bit less than the allowance, or more
            for (const Sampled& outline : outlines(job, layer, step)) {
                std::vector<std::uint8_t> free(outline.at.size());
                for (std::size_t k = 0; k < free.size(); ++k) {
                    const dvec2 p = outline.at[k];
                    if (disc_meets(*part, p, job.plane(layer - 1), limits.overhang - band)) continue;
                    overhanging.push_back(p);
                    if (disc_meets(*part, p, job.plane(layer - 1), limits.overhang + 0.03)) continue;
                    ++hanging;
                    free[k] = near_point(survey, {p, z}, limits.spacing + limits.width) ? 0 : 1;
                }
                const auto held = std::find(free.begin(), free.end(), 0);
                const auto from = static_cast<std::size_t>(held - free.begin());
                std::vector<dvec2> stretch;
                for (std::size_t k = 0; k <= free.size(); ++k) {
                    const std::size_t at = (from + k) % free.size();
                    if (k < free.size() && free[at] != 0) {
                        stretch.push_back(outline.at[at]);
                        continue;
                    }
                    if (stretch.empty()) continue;
                    left_hanging += stretch.size();
                    INFO("layer " << layer << " at " << stretch[0].x << ", " << stretch[0].y);
                    REQUIRE(may_hang(stretch, limits, slack));
                    stretch.clear();
                }
            }
            for (const SupportPoint& p : survey.points) {
                if (std::abs(p.at.z - z) > 1e-6) continue;
                INFO("point at " << p.at.x << ", " << p.at.y << ", " << p.at.z);
                REQUIRE(part->value({p.at.x, p.at.y, job.plane(layer)}) < 0.03);
                if (p.reason == SupportReason::overhang) {
                    REQUIRE(std::any_of(overhanging.begin(), overhanging.end(), [&](dvec2 q) {
                        return glm::length(q - dvec2(p.at)) < limits.width / 2 + step;
                    }));
                } else {
                    REQUIRE_FALSE(
                        disc_meets(*part, dvec2(p.at), job.plane(layer - 1), limits.overhang - band));
                }
            }
        }
    }
    REQUIRE(hanging > 5000);
    REQUIRE(points > 100);
    REQUIRE(left_hanging > 0);
}

}  // namespace overhang_paths_test
