// Surveys the void, and drills one or two holes into each cavity.
#include "recipe/build/place_drains.h"
#include "recipe/build/json_triple.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/layers/survey_rows.h"
#include "engine/surveys/island_survey.h"

namespace lamella {

namespace {

constexpr std::size_t max_cavities = 1000;

double survey_pitch(const Recipe& recipe, const Job& job, double depth) {
    const Interval suited = survey_pitch_range(job);
    const double given = recipe.skin->drain_pitch;
    if (given == 0) return std::min(std::max(depth / 3, suited.lo), suited.hi);
    if (!suited.contains(given)) {
        throw LocatedError(
            fmt::format("skin.drain_pitch / --drain-pitch: {} mm is out of range for this part; accepted: "
                        "{:.4g} to {:.4g} mm (16 layers)",
                        given, suited.lo, suited.hi));
    }
    return given;
}

/// Returns the hole at right angles to the nearest point of the surface; nothing where that point is not
/// clear, or lies inside the body, on another of its shells.
std::optional<DrilledHole> drain_to_nearest(const Field& body, dvec3 at, double radius, double depth) {
    DrilledHole hole;
    try {
        hole = drill(body, at, dvec3(0), radius, 0, depth);
    } catch (const InputError&) {
        return std::nullopt;
    }
    if (body.value(hole.from) <= 0) return std::nullopt;
    // The hole passes through the point and slightly beyond, however deep the point lies.
    const dvec3 axis = hole.to - hole.from;
    const double length = std::sqrt(glm::dot(axis, axis));
    const double way = glm::dot(at - hole.from, axis) / length + radius;
    if (way > length) hole.to = hole.from + axis * (way / length);
    return hole;
}

/// Returns how far from a point a line leaves the body for good, mm, looking no farther than `farthest`.
/// Steps by the distance to the surface (sphere tracing), of which the value is a bound.
double way_out(const Field& body, dvec3 at, dvec3 direction, double step, double farthest) {
    double last_inside = 0;
    for (double way = 0; way < farthest;) {
        const double value = body.value(at + direction * way);
        if (value <= 0) last_inside = way;
        way += std::max(std::abs(value), step);
    }
    return last_inside;
}

/// Returns the shortest of 26 straight ways out; nothing when the body is unbounded.
std::optional<DrilledHole> drain_straight(const Field& body, dvec3 at, double radius) {
    const double farthest = diagonal(body.bounds());
    if (!std::isfinite(farthest)) return std::nullopt;
    dvec3 best(0);
    double shortest = infinity;
    for (int k = 0; k < 27; ++k) {
        const dvec3 way(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        if (way == dvec3(0)) continue;
        const dvec3 direction = way / std::sqrt(glm::dot(way, way));
        const double length = way_out(body, at, direction, radius / 8, farthest);
        if (length >= shortest) continue;
        shortest = length;
        best = direction;
    }
    return DrilledHole{at + best * (shortest + 2 * radius), at - best * radius, radius, false};
}

std::optional<DrilledHole> drain(const Field& body, dvec3 at, double radius, double depth) {
    const auto hole = drain_to_nearest(body, at, radius, depth);
    return hole ? hole : drain_straight(body, at, radius);
}

}  // namespace

DrainReport place_drains(const Recipe& recipe, const Job& job, const Field& body, double depth) {
    const SkinRecipe& skin = *recipe.skin;
    constexpr double min_radius = 0.5;
    const double radius = skin.drain_radius > 0 ? skin.drain_radius : std::max(0.5 * depth, min_radius);
    CavitySurveyOptions options;
    options.pitch = survey_pitch(recipe, job, depth);
    options.most = max_cavities + 1;
    CavitySurvey survey = survey_cavities(job, options);
    DrainReport report;
    report.cavities = survey.count;
    report.volume = survey.volume;
    const double least = 4.0 / 3 * pi * radius * radius * radius;
    for (Cavity& cavity : survey.cavities) {
        if (cavity.volume >= least) report.drained.push_back(cavity);
    }
    if (report.drained.size() > max_cavities) {
        throw LocatedError(
            fmt::format("skin.drains / --drains: more than {} closed cavities need drains ({} in all); "
                        "accepted: an open-cell foam, or no drains",
                        max_cavities, report.cavities));
    }
    report.small = survey.count - report.drained.size();
    const auto drill_into = [&](const Cavity& cavity) {
        const auto low = drain(body, cavity.lowest, radius, depth);
        if (low) report.holes.push_back(*low);
        if (!low || skin.drains < 2) return low.has_value();
        if (const auto high = drain(body, cavity.highest, radius, depth)) report.holes.push_back(*high);
        return true;
    };
    std::erase_if(report.drained, [&](const Cavity& cavity) {
        if (drill_into(cavity)) return false;
        report.kept.push_back(cavity);
        return true;
    });
    return report;
}

nlohmann::ordered_json drains_json(const DrainReport& report) {
    const auto list = [](const std::vector<Cavity>& cavities) {
        auto json = nlohmann::ordered_json::array();
        for (const Cavity& cavity : cavities) {
            json.push_back({{"volume_mm3", cavity.volume},
                            {"lowest_mm", json_triple(cavity.lowest)},
                            {"highest_mm", json_triple(cavity.highest)}});
        }
        return json;
    };
    auto holes = nlohmann::ordered_json::array();
    for (const DrilledHole& hole : report.holes) {
        holes.push_back({{"from_mm", json_triple(hole.from)},
                         {"to_mm", json_triple(hole.to)},
                         {"radius_mm", hole.radius}});
    }
    return {{"cavities", report.cavities},        {"volume_mm3", report.volume},
            {"too_small_to_drain", report.small}, {"drained", list(report.drained)},
            {"not_drained", list(report.kept)},   {"holes", std::move(holes)}};
}

std::string drains_text(const DrainReport& report) {
    if (report.cavities == 0) return "no cavity is closed";
    std::string text = fmt::format("{} closed {} of {:.1f} mm3, {} {} drilled", report.cavities,
                                   report.cavities == 1 ? "cavity" : "cavities", report.volume,
                                   report.holes.size(), report.holes.size() == 1 ? "hole" : "holes");
    if (!report.drained.empty()) {
        const Cavity& cavity = report.drained.front();
        text += fmt::format("; the largest, of {:.1f} mm3, lowest at ({:.2f}, {:.2f}, {:.2f}) mm",
                            cavity.volume, cavity.lowest.x, cavity.lowest.y, cavity.lowest.z);
    }
    for (const Cavity& cavity : report.kept) {
        text += fmt::format("; that at ({:.2f}, {:.2f}, {:.2f}) mm, of {:.1f} mm3, has no way out",
                            cavity.lowest.x, cavity.lowest.y, cavity.lowest.z, cavity.volume);
    }
    if (report.small > 0) text += fmt::format("; {} too small to drain", report.small);
    return text;
}

}  // namespace lamella
