// Surveys places to repair, and joins pieces by struts.
#include "recipe/build/repair_job.h"
#include "recipe/build/json_triple.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/layers/survey_rows.h"
#include "engine/solids/box_solid.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "engine/surveys/island_survey.h"
#include "procedural/scaffold/tip_struts.h"
#include "recipe/build/build_process.h"

namespace lamella {

namespace {

constexpr double pitches_in_a_strut = 4;

/// Returns the pitch for features that are `size` mm thick, clamped to the range of the job's surveys.
double pitch_for(const Job& job, double size) {
    const Interval suited = survey_pitch_range(job);
    return std::min(std::max(size / pitches_in_a_strut, suited.lo), suited.hi);
}

/// Makes a strut that extends into both pieces by its own radius.
FieldPtr strut(const PieceJoin& join, double radius) {
    const double length = join.length();
    const dvec3 into = length > 0 ? (join.b - join.a) * (radius / length) : dvec3(0);
    return make_round_cone({join.a - into, radius, join.b + into, radius});
}

void join_pieces(const Recipe& recipe, BuiltJob& built, RepairReport& report, const RepairOptions& options) {
    // Under a scale, struts are at least as thick as asked; without one, exactly.
    const dvec3 scale = recipe.process ? recipe.process->scale : dvec3(1);
    const double radius = 0.5 * recipe.repair->join / std::min({scale.x, scale.y, scale.z});
    JoinSurveyOptions survey;
    survey.pitch = pitch_for(built.designed, 2 * radius);
    survey.threads = options.threads;
    survey.on_progress = options.on_progress;
    survey.cancel = options.cancel;
    report.joins = survey_joins(built.designed, survey);
    if (report.joins->joins.empty()) return;
    std::vector<FieldPtr> solids{built.designed.part};
    for (const PieceJoin& join : report.joins->joins) solids.push_back(strut(join, radius));
    built.designed.part = make_union(std::move(solids));
    built.job = make_processed(recipe, built.designed, built.layers.plan);
}

/// Finds the tips up to `height` mm, with rows fine enough for features that are `size` mm thick.
void find_tips(double height, double size, const BuiltJob& built, RepairReport& report,
               const RepairOptions& options) {
    constexpr double widest = 0.2;  // of what rows of a fine pitch are spent on, mm
    TipSurveyOptions survey;
    survey.pitch = pitch_for(built.job, std::min(size, widest));
    survey.height = height > 0 ? height : -1;
    survey.threads = options.threads;
    survey.on_progress = options.on_progress;
    survey.cancel = options.cancel;
    report.tips = survey_tips(built.job, survey);
    report.trim = height;
}

/// Makes struts from the tips that stay down to the part or to the bed, within the body.
void hold_tips(const Recipe& recipe, BuiltJob& built, RepairReport& report, double diameter) {
    const FieldPtr body = make_scaled(recipe, built.designed, built.outside);
    TipStrutOptions options;
    options.radius = 0.5 * diameter;
    options.layer_height = built.layers.plan.least_height();
    const auto near_bed = [&](int layer) {
        return built.job.plane(layer) - built.job.plane(0) <= 0.5 * options.radius;
    };
    // The lowest layers may hold nothing of a body that ends in points.
    const auto to_bed = [&](dvec3 tip) {
        std::vector<Beam> legs;
        for (int layer = 0; legs.empty() && near_bed(layer) && built.job.plane(layer) < tip.z; ++layer)
            legs = struts_to_bed(tip, built.job.plane(layer), *body, options);
        return legs;
    };
    for (const dvec3 tip : report.tips->begins) {
        std::vector<Beam> legs;
        if (const auto below = strut_below(tip, *built.job.part, *body, options)) legs.push_back(*below);
        if (legs.empty()) legs = to_bed(tip);
        if (legs.empty()) legs = struts_aside(tip, *built.job.part, *body, options);
        report.holds.insert(report.holds.end(), legs.begin(), legs.end());
    }
    // So may those of the pattern, where the body already stands.
    for (const dvec3 lowest : report.tips->on_bed) {
        const std::vector<Beam> legs = to_bed(lowest);
        report.holds.insert(report.holds.end(), legs.begin(), legs.end());
    }
    std::vector<FieldPtr> solids;
    for (const Beam& leg : report.holds) solids.push_back(make_round_cone(leg));
    if (solids.empty()) return;
    const FieldPtr struts = make_intersection({make_union(std::move(solids)), body});
    built.job.part = make_union({built.job.part, struts});
}

/// Returns the findings of a check in the job before outlines are repaired.
CheckResult count_faults(const Recipe& recipe, const BuiltJob& built, Check check, double limit,
                         const RepairOptions& options) {
    const Job job = make_scaled(recipe, built.designed, built.layers.plan);
    PrintCheckOptions checked;
    checked.limits.verdicts[static_cast<std::size_t>(check)] = Severity::fail;
    checked.limits.thickness = checked.limits.gap = limit;
    checked.pitch = check_pitch(job, checked.limits);
    PrintCheck surveyor(job, checked);
    survey_layers(job, surveyor, options);
    return surveyor.report().results.front();
}

nlohmann::ordered_json mended_json(const CheckResult& result) {
    auto largest = nlohmann::ordered_json::array();
    for (const Fault& fault : result.worst)
        largest.push_back({{"at_mm", json_triple(fault.at)}, {"volume_mm3", fault.size}});
    return {{"to_mm", result.limit},
            {"places", result.count},
            {"volume_mm3", result.total},
            {"largest", std::move(largest)}};
}

nlohmann::ordered_json tips_json(const TipSurvey& tips, double trim) {
    auto kept = nlohmann::ordered_json::array();
    for (const HangingTip& tip : tips.kept)
        kept.push_back({{"at_mm", json_triple(tip.at)},
                        {"height_mm", tip.height},
                        {"area_mm2", tip.area},
                        {"first_layer", tip.first_layer},
                        {"end_layer", tip.end_layer}});
    return {{"to_mm", trim},         {"tips", tips.trimmed},    {"volume_mm3", tips.volume},
            {"higher", tips.higher}, {"holding", tips.holding}, {"kept", std::move(kept)}};
}

std::string counted_tips(std::size_t count) {
    return fmt::format("{} {}", count, count == 1 ? "tip" : "tips");
}

std::string tips_text(const TipSurvey& tips, double trim) {
    std::string text = fmt::format("trim       {} up to {} mm high, {:.2f} mm3 in all, removed",
                                   counted_tips(tips.trimmed), trim, tips.volume);
    if (tips.holding > 0)
        text += fmt::format("; {} left that hold pieces together", counted_tips(tips.holding));
    if (tips.higher > 0) {
        const HangingTip& tip = tips.kept.front();
        text += fmt::format("; {} higher than that, the highest {:.2f} mm at ({:.2f}, {:.2f}, {:.2f}) mm",
                            counted_tips(tips.higher), tip.height, tip.at.x, tip.at.y, tip.at.z);
    }
    return text + "\n";
}

std::string mended_text(const char* name, const CheckResult& result, const char* found, const char* done) {
    if (result.count == 0) return fmt::format("{}nothing {} than {} mm\n", name, found, result.limit);
    const Fault& worst = result.worst.front();
    return fmt::format(
        "{}{} {} {} than {} mm, {:.2f} mm3 in all, {}; the largest at ({:.2f}, {:.2f}, {:.2f}) mm\n", name,
        result.count, result.count == 1 ? "place" : "places", found, result.limit, result.total, done,
        worst.at.x, worst.at.y, worst.at.z);
}

/// Returns the thickness of a self-supporting skin's struts, mm; 0 without such a skin.
double self_supporting_strut(const Recipe& recipe) {
    constexpr double usual = 0.8;
    if (!recipe.skin || !recipe.skin->self_supporting) return 0;
    const GradedNumber& strut = recipe.skin->strut;
    return strut.is_formula() ? usual : strut.number();
}

}  // namespace

void repair_job(const Recipe& recipe, BuiltJob& built, const RepairOptions& options) {
    const double trim = trim_height(recipe), hold = hold_diameter(recipe);
    if (!recipe.repair && trim == 0 && hold == 0) return;
    const RepairRecipe repair = recipe.repair.value_or(RepairRecipe());
    RepairReport report;
    if (repair.join > 0) join_pieces(recipe, built, report, options);
    if (repair.thickness > 0)
        report.thickened = count_faults(recipe, built, Check::thickness, repair.thickness, options);
    if (repair.gap > 0) report.filled = count_faults(recipe, built, Check::gaps, repair.gap, options);
    if (trim > 0 || hold > 0) find_tips(trim, trim > 0 ? trim : hold, built, report, options);
    built.repairs = std::move(report);
    if (trim > 0) built.job.part = without_tips(built.job.part, built);
    if (hold > 0) hold_tips(recipe, built, *built.repairs, hold);
}

double trim_height(const Recipe& recipe) {
    if (recipe.repair && recipe.repair->trim >= 0) return recipe.repair->trim;
    constexpr double share_of_strut = 0.25;
    return share_of_strut * self_supporting_strut(recipe);
}

double hold_diameter(const Recipe& recipe) {
    if (recipe.repair && recipe.repair->hold >= 0) return recipe.repair->hold;
    return self_supporting_strut(recipe);
}

FieldPtr without_tips(FieldPtr solid, const BuiltJob& built) {
    if (!built.repairs || !built.repairs->tips || built.repairs->tips->removed->empty()) return solid;
    const double bed = built.designed.z0();
    return make_without_layer_boxes(
        std::move(solid), built.repairs->tips->removed,
        [plan = built.layers.plan, bed](double z) { return plan.layer_at(z - bed); });
}

nlohmann::ordered_json repairs_json(const RepairReport& report) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (report.joins) {
        auto joins = nlohmann::ordered_json::array();
        for (const PieceJoin& join : report.joins->joins)
            joins.push_back({{"from_mm", json_triple(join.a)}, {"to_mm", json_triple(join.b)}});
        json["joined"] = {{"pieces", report.joins->pieces}, {"struts", std::move(joins)}};
    }
    if (report.thickened) json["thickened"] = mended_json(*report.thickened);
    if (report.filled) json["filled"] = mended_json(*report.filled);
    if (report.tips) json["trimmed"] = tips_json(*report.tips, report.trim);
    if (!report.holds.empty()) {
        auto struts = nlohmann::ordered_json::array();
        for (const Beam& strut : report.holds)
            struts.push_back({{"from_mm", json_triple(strut.a)}, {"to_mm", json_triple(strut.b)}});
        json["held"] = std::move(struts);
    }
    return json;
}

std::string repairs_text(const RepairReport& report) {
    std::string text;
    if (report.joins && report.joins->pieces < 2) text += "join       the part is one piece\n";
    if (report.joins && report.joins->pieces > 1) {
        double longest = 0;
        for (const PieceJoin& join : report.joins->joins) longest = std::max(longest, join.length());
        text += fmt::format("join       {} pieces, by {} {}, the longest over {:.2f} mm\n",
                            report.joins->pieces, report.joins->joins.size(),
                            report.joins->joins.size() == 1 ? "strut" : "struts", longest);
    }
    if (report.thickened) text += mended_text("thickness  ", *report.thickened, "thinner", "made thicker");
    if (report.filled) text += mended_text("gaps       ", *report.filled, "narrower", "filled");
    if (report.trim > 0) text += tips_text(*report.tips, report.trim);
    if (!report.holds.empty()) {
        text += fmt::format("hold       {} {} from tips that stay down to the part or the bed\n",
                            report.holds.size(), report.holds.size() == 1 ? "strut" : "struts");
    }
    return text;
}

}  // namespace lamella
