// A table for people, everything for programs.
#include "app/reports/structure_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "recipe/build/json_triple.h"
#include "recipe/optimize_recipe.h"

namespace lamella {

namespace {

constexpr double whole_part = OptimizeRecipe::whole_part;

std::string line(const char* name, const std::string& value) {
    return fmt::format("{:<22}{}\n", name, value);
}

std::string size_text(const StructureReport& report) {
    const std::string size = report.dimensions == 2
                                 ? fmt::format("{} x {}", report.size.x, report.size.y)
                                 : fmt::format("{} x {} x {}", report.size.x, report.size.y, report.size.z);
    const dvec3 edges = report.element;
    const bool is_cube = edges.x == edges.y && (report.dimensions == 2 || edges.x == edges.z);
    const std::string edge = is_cube ? fmt::format("{:.4g}", edges.x)
                             : report.dimensions == 2
                                 ? fmt::format("{:.4g} x {:.4g}", edges.x, edges.y)
                                 : fmt::format("{:.4g} x {:.4g} x {:.4g}", edges.x, edges.y, edges.z);
    return fmt::format("{} in a grid of {}, {} mm each", report.elements, size, edge);
}

/// Returns a compliance beside that of the full body.
std::string compliance_text(double compliance, const StructureReport& report) {
    return fmt::format("{:.5g} N mm, {:.4g} times that of the full body", compliance,
                       compliance / report.full_compliance);
}

std::string triple(dvec3 at) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", at.x, at.y, at.z); }

/// Nothing for a design of 0 and 1, and for a foam, whose densities are all printable.
std::string grey_text(const char* before, double greyness) {
    return greyness > 0 ? fmt::format("{}{:.1f} % grey", before, 100 * greyness) : "";
}

/// Returns how like the picture the densities are, and what that costs; nothing without a picture.
std::string appearance_text(const StructureReport& report) {
    if (report.appearance <= 0) return "";
    return line("stiffest",
                fmt::format("{:.5g} N mm on as much material; densities {:.4g} times, result {:.4g} times "
                            "that",
                            report.least_compliance, report.densities_compliance / report.least_compliance,
                            report.compliance / report.least_compliance)) +
           line("appearance",
                fmt::format("differs from the picture by {:.4g}, the stiffest by {:.4g} (0 is alike)",
                            report.appearance, report.stiffest_appearance));
}

std::string cases_text(const StructureReport& report) {
    std::string text;
    for (const CaseReport& load : report.cases) {
        text += fmt::format("\ncase \"{}\"{}\n", load.name,
                            load.weight == 1 ? "" : fmt::format(", weight {:.4g}", load.weight));
        text += line("  compliance", fmt::format("{:.5g} N mm", load.compliance));
        text += line("  displacement", fmt::format("at most {:.4g} mm, at {} mm", load.largest_displacement,
                                                   triple(load.displacement_at)));
        if (load.peak_stress > 0) {
            text += line("  von Mises stress",
                         fmt::format("at most {:.4g} MPa, at {} mm (elements are steps: a peak "
                                     "at a notch or corner is a guess)",
                                     load.peak_stress, triple(load.stress_at)));
        }
    }
    return text;
}

}  // namespace

void check_is_optimized(const Recipe& recipe) {
    if (recipe.optimize) return;
    throw InputError(
        "[optimize] is missing: there is nothing to optimise; accepted: a recipe with [optimize], "
        "[[load]] and [[anchor]]");
}

std::string step_text(const OptimizationStep& step, int steps) {
    const std::string aim = step.appearance > 0 ? fmt::format("A {:.4g}  C {:.4g} times the least",
                                                              step.appearance, step.compliance)
                                                : fmt::format("C {:.5g} N mm", step.compliance);
    return fmt::format("{}/{}  {}  volume {:.2f} %  change {:.3f}{}{}", step.index,
                       std::max(steps, step.index), aim, 100 * step.volume, step.change,
                       grey_text("  ", step.greyness),
                       step.sharpness > 0 ? fmt::format("  sharpness {:g}", step.sharpness) : "");
}

std::string structure_text(const StructureReport& report) {
    std::string text = line("elements", size_text(report));
    text += line("material", fmt::format("E = {:.5g} MPa, nu = {:.4g}{}", report.young, report.poisson,
                                         report.material_is_assumed
                                             ? " (assumed: the recipe has no [material]; displacements in mm "
                                               "are those of E = 1 MPa)"
                                             : ""));
    text +=
        line("full body", fmt::format("{:.5g} N mm, {:.5g} mm3", report.full_compliance, report.body_volume));
    if (!report.history.empty()) {
        text +=
            line("densities",
                 fmt::format("{} after {} iterations{}{}",
                             compliance_text(report.densities_compliance, report), report.history.size(),
                             report.is_converged ? "" : " (not settled)", grey_text(", ", report.greyness)));
    }
    text += appearance_text(report);
    const std::string bound =
        report.compliance_bound > 0 ? fmt::format(" (at most {:.4g})", report.compliance_bound) : "";
    text += line("result", compliance_text(report.compliance, report) + bound);
    if (report.volume > 0) {
        text +=
            line("volume", fmt::format("{:.2f} %{}{}", 100 * report.volume,
                                       report.history.empty() || report.volume_bound >= whole_part
                                           ? ""
                                           : fmt::format(" of at most {:.2f} %", 100 * report.volume_bound),
                                       report.mass > 0 ? fmt::format(", {:.4g} g", report.mass) : ""));
    }
    if (report.stray_pieces > 0) text += line("stray pieces", fmt::format("{} dropped", report.stray_pieces));
    for (const std::string& note : report.notes) text += line("note", note);
    return text + cases_text(report);
}

nlohmann::ordered_json step_json(const OptimizationStep& step) {
    return {{"appearance", step.appearance},
            {"compliance", step.compliance},
            {"volume", step.volume},
            {"greyness", step.greyness},
            {"change", step.change},
            {"sharpness", step.sharpness},
            {"solver_iterations", step.solver_iterations}};
}

nlohmann::ordered_json structure_json(const StructureReport& report) {
    auto cases = nlohmann::ordered_json::array(), history = nlohmann::ordered_json::array();
    for (const CaseReport& load : report.cases) {
        cases.push_back({{"case", load.name},
                         {"weight", load.weight},
                         {"compliance_nmm", load.compliance},
                         {"largest_displacement_mm", load.largest_displacement},
                         {"displacement_at_mm", json_triple(load.displacement_at)},
                         {"peak_von_mises_mpa", load.peak_stress},
                         {"stress_at_mm", json_triple(load.stress_at)}});
    }
    for (const OptimizationStep& step : report.history) history.push_back(step_json(step));
    return {{"dimensions", report.dimensions},
            {"grid", {report.size.x, report.size.y, report.size.z}},
            {"elements", report.elements},
            {"element_mm", {report.element.x, report.element.y, report.element.z}},
            {"young_mpa", report.young},
            {"poisson", report.poisson},
            {"material_is_assumed", report.material_is_assumed},
            {"body_volume_mm3", report.body_volume},
            {"volume_bound", report.volume_bound},
            {"compliance_bound_of_full", report.compliance_bound},
            {"full_compliance_nmm", report.full_compliance},
            {"densities_compliance_nmm", report.densities_compliance},
            {"least_compliance_nmm", report.least_compliance},
            {"compliance_nmm", report.compliance},
            {"appearance", report.appearance},
            {"stiffest_appearance", report.stiffest_appearance},
            {"volume", report.volume},
            {"mass_g", report.mass},
            {"greyness", report.greyness},
            {"stray_pieces", report.stray_pieces},
            {"converged", report.is_converged},
            {"cases", std::move(cases)},
            {"notes", report.notes},
            {"history", std::move(history)}};
}

}  // namespace lamella
