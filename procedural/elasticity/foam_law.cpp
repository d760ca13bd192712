// Monotone interpolation of logarithms, and the text format of laws.
#include "procedural/elasticity/foam_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/deterministic_math.h"
#include "engine/base/error.h"
#include "procedural/grading/text_rows.h"

namespace lamella {
namespace {

constexpr std::array columns{"foam",      "ratio",  "density",    "E",        "nu",     "E_low_nu",
                             "E_high_nu", "spread", "anisotropy", "elements", "samples"};

/// Returns the factor on the modulus for a material's Poisson's ratio: the parabola through the three
/// computed values.
double poisson_factor(const FoamLawPoint& point, double poisson) {
    const auto weight = [&](double here, double other, double third) {
        return (poisson - other) * (poisson - third) / ((here - other) * (here - third));
    };
    return weight(law_poisson, low_poisson, high_poisson) +
           point.low_factor * weight(low_poisson, law_poisson, high_poisson) +
           point.high_factor * weight(high_poisson, low_poisson, law_poisson);
}

std::vector<FoamLawPoint> points_for(const FoamLawTable& table, double poisson) {
    if (!(poisson > -1 && poisson < 0.5))
        throw InputError("a material's Poisson's ratio lies between -1 and 0.5");
    const std::string whose = "the law of " + table.foam + ": ";
    if (table.points.size() < 2) throw InputError(whose + "it needs two points or more");
    std::vector<FoamLawPoint> points = table.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        FoamLawPoint& point = points[i];
        const bool in_range = point.ratio > 0 && point.ratio < 1e3 && point.young > 1e-12 &&
                              point.young <= 1 && point.low_factor > 0 && point.high_factor > 0;
        if (!in_range) throw InputError(whose + "a ratio, modulus or factor is out of range");
        point.young *= poisson_factor(point, poisson);
        if (!(point.young > 1e-12) ||
            (i > 0 && !(points[i - 1].ratio < point.ratio && points[i - 1].young < point.young)))
            throw InputError(whose + "ratio and modulus have to grow from point to point");
    }
    return points;
}

Table logarithms(const std::vector<FoamLawPoint>& points) {
    Table rows;
    for (const FoamLawPoint& point : points)
        rows.emplace_back(logarithm(point.young), logarithm(point.ratio));
    return rows;
}

FoamLawPoint point_of(const std::vector<double>& numbers) {
    FoamLawPoint point;
    point.ratio = numbers[0];
    point.density = numbers[1];
    point.young = numbers[2];
    point.poisson = numbers[3];
    point.low_factor = numbers[4] / numbers[2];
    point.high_factor = numbers[5] / numbers[2];
    point.spread = numbers[6];
    point.anisotropy = numbers[7];
    // NaN is no count; it fails every comparison.
    const auto count = [](double number) { return number > 0 ? static_cast<int>(std::min(number, 1e6)) : 0; };
    point.elements = count(numbers[8]);
    point.samples = count(numbers[9]);
    return point;
}

}  // namespace

FoamLaw::FoamLaw(const FoamLawTable& table, double material_poisson)
    : points_(points_for(table, material_poisson)), log_ratio_(logarithms(points_), true) {}

double FoamLaw::spread() const {
    double sum = 0;
    for (const FoamLawPoint& point : points_) sum += point.spread * point.spread;
    return std::sqrt(sum / static_cast<double>(points_.size()));
}

double FoamLaw::ratio_of(double young) const {
    if (std::isnan(young)) return young;
    if (young <= points_.front().young) return points_.front().ratio;
    if (young >= points_.back().young) return points_.back().ratio;
    return exponential(log_ratio_.at(logarithm(young)));
}

FoamLawPoint FoamLaw::at(double ratio) const {
    if (!(ratio > points_.front().ratio)) return points_.front();
    if (ratio >= points_.back().ratio) return points_.back();
    const double wanted = logarithm(ratio);
    Interval logs{log_ratio_.rows().front().first, log_ratio_.rows().back().first};
    constexpr int halvings = 60;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (logs.lo + logs.hi) / 2;
        (log_ratio_.at(middle) < wanted ? logs.lo : logs.hi) = middle;
    }
    const auto next = std::ranges::upper_bound(points_, ratio, {}, &FoamLawPoint::ratio);
    const FoamLawPoint &a = *(next - 1), &b = *next;
    const double t = (wanted - logarithm(a.ratio)) / (logarithm(b.ratio) - logarithm(a.ratio));
    const auto between = [&](auto member) { return a.*member + t * (b.*member - a.*member); };
    FoamLawPoint point;
    point.ratio = ratio;
    point.density = between(&FoamLawPoint::density);
    point.young = exponential(logs.lo);
    point.poisson = between(&FoamLawPoint::poisson);
    point.low_factor = between(&FoamLawPoint::low_factor);
    point.high_factor = between(&FoamLawPoint::high_factor);
    point.spread = between(&FoamLawPoint::spread);
    point.anisotropy = between(&FoamLawPoint::anisotropy);
    point.elements = std::min(a.elements, b.elements);
    point.samples = std::min(a.samples, b.samples);
    return point;
}

std::vector<FoamLawTable> read_foam_laws(std::string_view text, const std::string& name) {
    std::vector<FoamLawTable> laws;
    bool headed = false;
    for (const TextRow& row : text_rows(text)) {
        const std::string where = fmt::format("{}:{}: ", name, row.number);
        if (!headed) {
            if (!std::ranges::equal(row.cells, columns)) {
                throw InputError(where + "this is no foam's law; accepted: a first line \"" +
                                 law_heading().substr(0, law_heading().size() - 1) + "\"");
            }
            headed = true;
            continue;
        }
        if (row.cells.size() != columns.size()) {
            throw InputError(fmt::format("{}a row of a law has {} cells; here are {}", where, columns.size(),
                                         row.cells.size()));
        }
        const std::string foam(row.cells.front());
        const FoamLawPoint point = point_of(numbers_of({row.cells.begin() + 1, row.cells.end()}, where));
        if (!std::isfinite(point.ratio + point.young + point.low_factor + point.high_factor))
            throw InputError(where + "a ratio or modulus is not finite");
        if (laws.empty() || laws.back().foam != foam) laws.push_back({foam, {}});
        laws.back().points.push_back(point);
    }
    if (laws.empty()) throw InputError(name + ": there is no foam's law in it");
    return laws;
}

std::string law_heading() { return fmt::format("{}\n", fmt::join(columns, ",")); }

std::string law_row(const std::string& foam, const FoamLawPoint& point) {
    return fmt::format("{},{:.4g},{:.4f},{:.4g},{:.4f},{:.4g},{:.4g},{:.2g},{:.2g},{},{}\n", foam,
                       point.ratio, point.density, point.young, point.poisson, point.young * point.low_factor,
                       point.young * point.high_factor, point.spread, point.anisotropy, point.elements,
                       point.samples);
}

}  // namespace lamella
