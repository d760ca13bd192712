// Formats a check's report as tables, lists and JSON.
#include "app/reports/check_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "engine/checks/check_table.h"
#include "printers/common/layer_heights.h"
#include "recipe/build/json_triple.h"
#include "recipe/keys/check_words.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t places_in_text = 3;

std::string found_text(const CheckResult& result) {
    if (result.passed()) return "";
    std::string text = places_text(result.count);
    if (result.count > 1 && check_info(result.check).adds_up)
        text += ", " + size_text(result.check, result.total) + " in all";
    return text;
}

std::string results_text(const CheckOutcome& outcome) {
    const PrintLimits& limits = outcome.plan.options.limits;
    std::size_t name_width = 0, limit_width = 0;
    for (const CheckResult& result : outcome.report.results) {
        name_width = std::max(name_width, check_name(result.check).size());
        limit_width = std::max(limit_width, check_limit(result.check, limits).size());
    }
    std::string text;
    for (const CheckResult& result : outcome.report.results) {
        std::string line = fmt::format("{:<{}}  {:<{}}  {}  {}", check_name(result.check), name_width,
                                       check_limit(result.check, limits), limit_width, outcome_word(result),
                                       found_text(result));
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string places(const CheckResult& result) {
    std::string text = fmt::format("\n{} {}: {}. {}\n", outcome_word(result), check_name(result.check),
                                   check_fault(result.check), check_advice(result.check));
    const std::size_t told = std::min(result.worst.size(), places_in_text);
    for (std::size_t i = 0; i < told; ++i) {
        const Fault& fault = result.worst[i];
        text += fmt::format("  {:<11} at {}, {}\n", size_text(result.check, fault.size), place_text(fault.at),
                            layers_text(fault));
    }
    if (result.count > told) text += fmt::format("  and {} more\n", result.count - told);
    return text;
}

/// Appends the unit, such as "mm2", to a key.
std::string keyed(const char* key, Check check) { return fmt::format("{}_{}", key, size_unit(check)); }

/// Returns all limits, whether or not their checks were made.
Json limits_mm_json(const PrintLimits& limits) {
    Json build_volume = Json::array();
    for (int k = 0; k < 3; ++k) {
        const double side = limits.build_volume[k];
        build_volume.push_back(std::isfinite(side) ? Json(side) : Json());
    }
    return {{"thickness", limits.thickness},
            {"thickness_up", limits.thickness_up},
            {"gap", limits.gap},
            {"gap_up", limits.gap_up},
            {"neck", limits.neck},
            {"overhang", limits.overhang},
            {"free_stretch", limits.free_stretch},
            {"bridge", limits.bridge},
            {"support_spacing", limits.support_spacing},
            {"support_gap", limits.support_gap},
            {"build_volume", std::move(build_volume)}};
}

Json limits_mm2_json(const PrintLimits& limits) { return {{"island", limits.island}}; }

Json limits_mm3_json(const PrintLimits& limits) {
    return {{"piece", limits.piece},
            {"large_part", limits.large_part},
            {"cavity", limits.cavity},
            {"cup", limits.cup}};
}

Json curve_json(const LayerCurve& curve) {
    return {{"layers_a_value", curve.layers_each()}, {"values", curve.values()}};
}

/// Returns the begin and end of each run, in the middle of its row.
Json runs_json(const Fault& fault, const RowBand& band) {
    Json runs = Json::array();
    for (const PlacedRun& run : fault.runs) {
        const dvec2 a = on_band(band, run.begin, run.row + 0.5), b = on_band(band, run.end, run.row + 0.5);
        runs.push_back({a.x, a.y, b.x, b.y});
    }
    return runs;
}

Json fault_json(Check check, const Fault& fault, const RowBand& band) {
    return {{keyed("size", check), fault.size},
            {"at_mm", json_triple(fault.at)},
            {"layer", fault.layer},
            {"first_layer", fault.first_layer},
            {"end_layer", fault.end_layer},
            {"box_mm", {{"lo", json_triple(fault.box.lo)}, {"hi", json_triple(fault.box.hi)}}},
            {"runs_x_y_x_y_mm", runs_json(fault, band)}};
}

Json result_json(const CheckResult& result, const CheckOutcome& outcome) {
    const Check check = result.check;
    Json json{{"check", check_name(check)},
              {"verdict", result.verdict == Severity::fail ? "fail" : "warn"},
              {"passed", result.passed()},
              {"limit", check_limit(check, outcome.plan.options.limits)}};
    if (const std::string unit = check_info(check).limit_unit; !unit.empty())
        json["limit_" + unit] = result.limit;
    json["count"] = result.count;
    json[keyed("total", check)] = result.total;
    json["worst"] = Json::array();
    for (const Fault& fault : result.worst)
        json["worst"].push_back(fault_json(check, fault, outcome.report.band));
    return json;
}

}  // namespace

std::string places_text(std::size_t count) { return fmt::format("{} place{}", count, count == 1 ? "" : "s"); }

std::string verdict_text(const CheckReport& report) {
    std::size_t failed = 0, warned = 0;
    for (const CheckResult& result : report.results) {
        if (!result.passed()) ++(result.verdict == Severity::fail ? failed : warned);
    }
    const std::size_t all = report.results.size();
    if (failed + warned == 0) return fmt::format("all {} checks pass", all);
    if (failed == 0) return fmt::format("nothing fails, {} of {} checks warn", warned, all);
    std::string text = fmt::format("{} of {} checks fail", failed, all);
    if (warned > 0) text += fmt::format(", {} warn", warned);
    return text;
}

std::string left_out(const CheckReport& report) {
    std::string text;
    for (std::size_t i = 0; i < check_count; ++i) {
        const auto check = static_cast<Check>(i);
        const auto is_it = [&](const CheckResult& result) { return result.check == check; };
        if (std::ranges::any_of(report.results, is_it)) continue;
        text += (text.empty() ? "" : ", ") + check_name(check);
    }
    return text;
}

std::string failure_text(const CheckOutcome& outcome) {
    std::string text;
    for (const CheckResult& result : outcome.report.results) {
        if (result.passed() || result.verdict != Severity::fail) continue;
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", check_name(result.check),
                            places_text(result.count));
    }
    return fmt::format("{} cannot be printed as it is on {}: {}", outcome.part, outcome.machine, text);
}

std::string check_text(const CheckOutcome& outcome) {
    const CheckReport& report = outcome.report;
    std::string text =
        fmt::format("{} on {} ({}): {}\n\n{}", outcome.part, outcome.machine,
                    process_name(outcome.plan.process), verdict_text(report), results_text(outcome));
    if (const std::string out = left_out(report); !out.empty()) text += "not looked at: " + out + "\n";
    for (const std::string& note : outcome.plan.notes) text += "note: " + note + "\n";
    for (const CheckResult& result : report.results) {
        if (!result.passed()) text += places(result);
    }
    return text;
}

nlohmann::ordered_json check_json(const CheckOutcome& outcome, const Job& job) {
    Json json{{"part", outcome.part},
              {"machine", outcome.machine},
              {"process", process_name(outcome.plan.process)},
              {"passed", outcome.report.passed()},
              {"identity", job.identity},
              {"layers", job.layers.count()},
              {"layer_height_mm", layer_heights_json(job.layers)},
              {"pitch_mm", outcome.plan.options.pitch},
              {"volume_mm3", outcome.report.volume},
              {"limits_mm", limits_mm_json(outcome.plan.options.limits)},
              {"limits_mm2", limits_mm2_json(outcome.plan.options.limits)},
              {"limits_mm3", limits_mm3_json(outcome.plan.options.limits)},
              {"limits_times", {{"peel", outcome.plan.options.limits.peel}}}};
    if (!outcome.plan.notes.empty()) json["notes"] = outcome.plan.notes;
    json["checks"] = Json::array();
    for (const CheckResult& result : outcome.report.results)
        json["checks"].push_back(result_json(result, outcome));
    if (const auto& peel = outcome.report.peel)
        json["peel"] = {{"area_mm2", curve_json(peel->area)}, {"load_times", curve_json(peel->load)}};
    return json;
}

}  // namespace lamella
