// Surveys numbers over the part, and ratios of neighbouring cells.
#include "app/reports/grading_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lamella {

namespace {

/// Neighbouring cells that differ by more are visibly distorted.
constexpr double steep = 2;

void find_steepest(const Grading& cell, const Field& body, GradingReport& report, int per_side = 24) {
    const std::array<dvec3, 3> axes{dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)};
    for (const dvec3& p : points_inside(body, per_side)) {
        const double here = cell.at(p);
        for (const dvec3& axis : axes) {
            const dvec3 q = p + axis * here;
            if (!(body.value(q) < 0)) continue;
            const double there = cell.at(q);
            const double ratio = std::max(here / there, there / here);
            if (!(ratio > report.steepest)) continue;
            report.steepest = ratio;
            report.steepest_at = p;
        }
    }
}

GradingReport report_on(const GradedUse& use, const Field& body) {
    const GradingSurvey survey = survey_grading(*use.asked, body, use.limits);
    GradingReport report{use.key, use.unit, survey.asked, use.limits};
    const double points = std::max(survey.points, 1);
    report.clamped = (survey.below + survey.above) / points;
    report.undefined = survey.undefined / points;
    return report;
}

}  // namespace

std::vector<GradingReport> grading_reports(const BuiltJob& built) {
    std::vector<GradingReport> reports;
    if (built.foam && !built.foam->cell.asked->constant()) {
        reports.push_back(report_on(built.foam->cell, *built.body));
        find_steepest(*built.foam->cell.made, *built.body, reports.back());
    }
    if (built.foam && !built.foam->member.asked->constant()) {
        reports.push_back(report_on(built.foam->member, *built.body));
    }
    if (built.foam) {
        for (const GradedUse& use : built.foam->others) {
            if (!use.asked->constant()) reports.push_back(report_on(use, *built.body));
        }
    }
    if (built.skin) reports.push_back(report_on(*built.skin, *built.body));
    return reports;
}

std::vector<std::string> warnings(const GradingReport& report) {
    std::vector<std::string> lines;
    const std::string unit = report.unit.empty() ? "" : " " + report.unit;
    if (report.clamped > 0) {
        lines.push_back(
            fmt::format("{}: {:.3g} % of the part asks for less than {}{} or more than {}{} "
                        "({:.4g} to {:.4g}{}) and is kept there",
                        report.key, 100 * report.clamped, report.limits.lo, unit, report.limits.hi, unit,
                        report.asked.lo, report.asked.hi, unit));
    }
    if (report.undefined > 0) {
        lines.push_back(fmt::format("{}: {:.3g} % of the part has no number and gets {}{}", report.key,
                                    100 * report.undefined, report.limits.hi, unit));
    }
    if (report.steepest > steep) {
        const dvec3 p = report.steepest_at;
        lines.push_back(
            fmt::format("{}: changes by a factor of {:.3g} from one cell to the next at ({:.4g}, "
                        "{:.4g}, {:.4g}) mm; cells are out of shape there",
                        report.key, report.steepest, p.x, p.y, p.z));
    }
    return lines;
}

}  // namespace lamella
