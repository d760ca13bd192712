// Grading: a number that varies in space, for cell sizes, radii, thicknesses and other graded settings.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// A number at every point of space. Immutable and thread-safe; a pure function of position, with the same
/// bits on every machine.
class Grading {
  public:
    virtual ~Grading() = default;
    /// Returns the number at a point (mm); NaN where it is undefined.
    virtual double at(dvec3 p) const = 0;
    /// Computes the results of `at` at many points; override it where a batch is faster.
    virtual void numbers(std::span<const dvec3> points, std::span<double> out) const {
        for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(points[i]);
    }
    /// Returns an interval that encloses the numbers at all points of the closed box; NaN counts as
    /// +infinity.
    virtual Interval range(const Box& box) const = 0;
    /// Returns the number if it is the same everywhere.
    virtual std::optional<double> constant() const { return std::nullopt; }
};
using GradingPtr = std::shared_ptr<const Grading>;

/// Sets `out` to make(number) for the numbers of a grading at the points.
template <typename Make>
void numbers_of(const Grading& given, std::span<const dvec3> points, std::span<double> out, Make make) {
    given.numbers(points, out);
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = make(out[i]);
}

/// Sets `out` to make(first, second) for the numbers of two gradings at the points.
template <typename Make>
void numbers_of(const Grading& first, const Grading& second, std::span<const dvec3> points,
                std::span<double> out, Make make) {
    std::vector<double> others(points.size());
    first.numbers(points, out);
    second.numbers(points, others);
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = make(out[i], others[i]);
}

/// Returns a grading with the same number everywhere.
GradingPtr make_constant_grading(double number);

/// Argument of a setting that may be graded: a number or a grading.
class Graded {
  public:
    Graded(double number) : grading_(make_constant_grading(number)) {}
    template <typename Kind>
    Graded(std::shared_ptr<Kind> grading) : grading_(std::move(grading)) {}
    const Grading* operator->() const { return grading_.get(); }
    const Grading& operator*() const { return *grading_; }
    const GradingPtr& pointer() const { return grading_; }

  private:
    GradingPtr grading_;  ///< never null
};

/// Returns the depth below the body's surface, mm: the negated value of the body, so positive inside. A body
/// whose metric is `bound` gives a lower bound of the depth.
GradingPtr make_depth_grading(FieldPtr body);

/// Returns the grading clamped to the limits; where it is NaN, the upper limit. Throws InputError when the
/// lower limit exceeds the upper one.
GradingPtr make_clamped_grading(GradingPtr grading, Interval limits);

/// Returns a tight interval that encloses the numbers over the box. Branch and bound: boxes with the widest
/// enclosure are divided until it exceeds the numbers found at their centres by at most 2 % of the spread of
/// these numbers, or after 4,000 divisions.
Interval tight_range(const Grading& grading, const Box& box);

/// Returns a tight interval that encloses the numbers at the points of a body, as tight_range does with fewer
/// divisions; empty when the body has no points.
Interval range_in(const Field& body, const Grading& grading);

/// Returns an interval that encloses a length over the region, as tight_range does. Throws InputError
/// ("<what> ... mm; it must be positive") when it is not positive, not finite or undefined somewhere.
Interval positive_range(const Grading& length, const Box& region, const std::string& what);

/// How much of a body asks for numbers outside the limits, counted on a fixed lattice of points.
struct GradingSurvey {
    int points = 0;     ///< lattice points inside the body
    int below = 0;      ///< ... that ask for less than the lower limit
    int above = 0;      ///< ... that ask for more than the upper limit
    int undefined = 0;  ///< ... whose number is NaN
    Interval asked;     ///< the lowest and the highest number asked for
};

/// Returns the points inside the body of a lattice with `per_side` points along its longest side; none when
/// the body is unbounded or has no extent.
std::vector<dvec3> points_inside(const Field& body, int per_side);

/// Evaluates the grading at points_inside() the body and counts the results.
GradingSurvey survey_grading(const Grading& grading, const Field& body, Interval limits, int per_side = 48);

}  // namespace lamella
