// Finds a number by its name, surveys its range and samples it.
#include "app/jobs/part_numbers.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/http/http_server.h"
#include "app/jobs/part_samples.h"
#include "app/reports/modulus_paint.h"
#include "engine/field/turned_grading.h"
#include "engine/solids/csg.h"

namespace lamella {

namespace {

/// A number that varies, in the space of the job as it was designed.
struct VaryingNumber {
    GradingPtr grading;
    std::string unit;
};

/// Returns the numbers of foam and skin that vary.
std::vector<const GradedUse*> varying_uses(const BuiltJob& built) {
    std::vector<const GradedUse*> uses;
    const auto add = [&](const GradedUse& use) {
        if (use.made && !use.made->constant()) uses.push_back(&use);
    };
    if (built.foam) {
        add(built.foam->cell);
        add(built.foam->member);
        for (const GradedUse& other : built.foam->others) add(other);
    }
    if (built.skin) add(*built.skin);
    return uses;
}

/// Makes an entry of the recipe's gradings anew: a build keeps those alone that it uses.
GradingPtr recipe_grading(const ServedJob& job, const std::string& name) {
    const BuiltJob& built = job.built;
    const bool is_turned = built.axes != glm::dmat3(1);
    Gradings gradings(job.recipe);
    gradings.set_body(is_turned ? make_transform(built.body, glm::transpose(built.axes), dvec3(0))
                                : built.body);
    if (built.optimized) gradings.set_result({built.optimized->density, built.optimized->dense});
    return make_turned_grading(gradings.resolve({name, "paint"}), built.axes);
}

VaryingNumber number_of(const ServedJob& job, const std::string& name) {
    const nlohmann::ordered_json all = varying_numbers(job);
    if (std::ranges::none_of(all, [&](const auto& one) { return one["name"] == name; })) {
        std::string names;
        for (const auto& one : all)
            names += (names.empty() ? "" : ", ") + one["name"].template get<std::string>();
        throw HttpError(400, "of: no number of this name varies over the part; accepted: " +
                                 (names.empty() ? "none of this part" : names));
    }
    for (const GradedUse* use : varying_uses(job.built))
        if (use->key == name) return {use->made, use->unit};
    return {recipe_grading(job, name), ""};
}

}  // namespace

nlohmann::ordered_json varying_numbers(const ServedJob& job) {
    auto list = nlohmann::ordered_json::array();
    if (job.parts > 1) return list;
    for (const GradedUse* use : varying_uses(job.built))
        list.push_back({{"name", use->key}, {"unit", use->unit}});
    for (const GradingRecipe& grading : job.recipe.gradings)
        if (grading.kind != "constant") list.push_back({{"name", grading.name}, {"unit", ""}});
    return list;
}

std::string number_volume(const ServedJob& job, const std::string& name, int longest,
                          const PassControl& control) {
    const VaryingNumber number = number_of(job, name);
    constexpr int survey_points = 32;
    const GradingSurvey found =
        survey_grading(*number.grading, *job.built.body, {-infinity, infinity}, survey_points);
    const double lo = found.asked.lo, hi = found.asked.hi;
    if (!(std::isfinite(lo) && std::isfinite(hi)))
        throw HttpError(400,
                        "of: `" + name + "` has no number in the part; accepted: one that is defined there");
    const auto sample = [&](dvec3 place, std::span<std::uint8_t> bytes) {
        const double value = number.grading->at(place);
        const double share = hi > lo ? std::clamp((value - lo) / (hi - lo), 0.0, 1.0) : 0.5;
        constexpr int span = ModulusCode::most - ModulusCode::least;
        bytes[0] = std::isnan(value)
                       ? std::uint8_t{0}
                       : static_cast<std::uint8_t>(ModulusCode::least + std::lround(span * share));
    };
    return part_samples(job, longest, {1, [&](const VoxelBrick&) -> PlaceBytes { return sample; }},
                        {{"scale", {{"lo", lo}, {"hi", hi}, {"unit", number.unit}}}}, control);
}

}  // namespace lamella
