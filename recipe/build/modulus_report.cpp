// Compares requested and predicted moduli point by point.
#include "recipe/build/modulus_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace lamella {

namespace {

constexpr int points_per_side = 48;

std::string number_text(double modulus) {
    return modulus < 1000 ? fmt::format("{:.3g}", modulus) : fmt::format("{:.0f}", modulus);
}

std::string range_text(Interval range) {
    const std::string high = number_text(range.hi) + " MPa";
    return range.hi > range.lo * (1 + modulus_tolerance) ? number_text(range.lo) + " to " + high : high;
}

void include(Interval& range, double number) {
    range = {std::min(range.lo, number), std::max(range.hi, number)};
}

std::string material_name(const BaseMaterial& material) {
    return fmt::format("{}{:.4g} MPa", material.name.empty() ? "" : material.name + ", ",
                       material.elastic.young);
}

}  // namespace

ModulusReport modulus_report(const BuiltModulus& modulus, const Field& body) {
    ModulusReport report;
    report.is_asked = modulus.asked.has_value();
    report.asked = report.predicted = {infinity, -infinity};
    report.material = material_name(modulus.material);
    report.fit = modulus.foam->fit();
    report.band = modulus.foam->band();
    const std::vector<dvec3> points = points_inside(body, points_per_side);
    const double weight = 1 / std::max(static_cast<double>(points.size()), 1.0);
    for (const dvec3& p : points) {
        const double made = modulus.made->at(p);
        include(report.predicted, made);
        if (!report.is_asked) continue;
        const double asked = modulus.asked->asked->at(p);
        if (std::isnan(asked)) continue;
        include(report.asked, asked);
        if (made < asked * (1 - modulus_tolerance)) report.softer += weight;
        if (made > asked * (1 + modulus_tolerance)) report.stiffer += weight;
    }
    const Interval known = modulus.foam->moduli();
    report.leaves_law = !report.is_asked && !report.predicted.empty() &&
                        (report.predicted.lo <= known.lo || report.predicted.hi >= known.hi);
    return report;
}

std::vector<std::string> modulus_lines(const ModulusReport& report) {
    if (report.predicted.empty()) return {};
    std::vector<std::string> lines;
    const std::string source = report.fit.tests > 0 ? fmt::format("fitted to {} tests", report.fit.tests)
                                                    : "made of " + report.material;
    lines.push_back(fmt::format("modulus: the foam gets {}, give or take {:.0f} %, {}",
                                range_text(report.predicted), 100 * report.band, source));
    if (report.leaves_law)
        lines.emplace_back(
            "modulus: some of the foam is thinner or thicker than its law knows; the law's end is told of "
            "it");
    const auto short_of = [&](double share, const char* how) {
        if (share > 0) {
            lines.push_back(fmt::format("modulus: {:.3g} % of the part gets {} than the {} asked for",
                                        100 * share, how, range_text(report.asked)));
        }
    };
    short_of(report.softer, "softer");
    short_of(report.stiffer, "stiffer");
    return lines;
}

nlohmann::ordered_json modulus_json(const ModulusReport& report) {
    nlohmann::ordered_json json{{"material", report.material},
                                {"predicted_MPa", {report.predicted.lo, report.predicted.hi}},
                                {"band", report.band}};
    if (report.is_asked && !report.asked.empty()) {
        json["asked_MPa"] = {report.asked.lo, report.asked.hi};
        json["softer_share"] = report.softer;
        json["stiffer_share"] = report.stiffer;
    }
    if (report.fit.tests > 0) {
        json["fit"] = {
            {"tests", report.fit.tests}, {"scale_MPa", report.fit.scale}, {"exponent", report.fit.exponent}};
    }
    json["notes"] = modulus_lines(report);
    return json;
}

}  // namespace lamella
