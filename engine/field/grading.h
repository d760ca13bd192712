// Grading: a number that varies in space, for cell sizes, radii, thicknesses and everything else that may be
// graded.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/field/field.h"

namespace lamella {

/// A number at every point of space. Immutable and thread-safe; a pure function of place, the same bits on
/// every machine.
class Grading {
  public:
    virtual ~Grading() = default;
    /// The number at a point (mm); NaN where none is defined.
    virtual double at(dvec3 p) const = 0;
    /// The numbers at many points, those of `at`; a grading that is quicker with many at once says so.
    virtual void numbers(std::span<const dvec3> points, std::span<double> out) const {
        for (std::size_t i = 0; i < points.size(); ++i) out[i] = at(points[i]);
    }
    /// Encloses the numbers at all points of the closed box; a NaN counts as +infinity.
    virtual Interval range(const Box& box) const = 0;
    /// The number when it is the same everywhere.
    virtual std::optional<double> constant() const { return std::nullopt; }
};
using GradingPtr = std::shared_ptr<const Grading>;

/// What a function makes of the numbers of another grading.
template <typename Make>
void numbers_of(const Grading& given, std::span<const dvec3> points, std::span<double> out, Make make) {
    given.numbers(points, out);
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = make(out[i]);
}

/// What a function makes of the numbers of two gradings.
template <typename Make>
void numbers_of(const Grading& first, const Grading& second, std::span<const dvec3> points,
                std::span<double> out, Make make) {
    std::vector<double> others(points.size());
    first.numbers(points, out);
    second.numbers(points, others);
    for (std::size_t i = 0; i < points.size(); ++i) out[i] = make(out[i], others[i]);
}

/// The same number everywhere.
GradingPtr make_constant_grading(double number);

/// What a setting that may be graded is given: a number or a grading.
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

/// How deep a point lies below the body's surface, mm: minus the body's value, so positive inside. A body
/// whose metric is `bound` gives a lower bound of the depth.
GradingPtr make_depth_grading(FieldPtr body);

/// The grading kept within limits; where it is NaN, the upper limit. Limits that are not in order are an
/// InputError.
GradingPtr make_clamped_grading(GradingPtr grading, Interval limits);

/// Encloses the numbers over the box as narrowly as a bounded search can: the box is divided where the
/// enclosure is widest until it exceeds the numbers found at centres by at most 2 % of their spread.
Interval tight_range(const Grading& grading, const Box& box);

/// Encloses a length over the region as tight_range does. Throws InputError ("<what> ... mm; it must be
/// positive") when it is not positive, not finite or not defined everywhere.
Interval positive_range(const Grading& length, const Box& region, const std::string& what);

/// What part of a body asks for numbers outside limits, by a fixed lattice of points.
struct GradingSurvey {
    int points = 0;     ///< lattice points inside the body
    int below = 0;      ///< ... that ask for less than the lower limit
    int above = 0;      ///< ... that ask for more than the upper limit
    int undefined = 0;  ///< ... whose number is NaN
    Interval asked;     ///< the least and the greatest number asked for
};

/// The points inside the body of a lattice with `per_side` points along its longest side; none in a body
/// without an end or an extent.
std::vector<dvec3> points_inside(const Field& body, int per_side);

/// Asks for the grading at points_inside() the body.
GradingSurvey survey_grading(const Grading& grading, const Field& body, Interval limits, int per_side = 48);

}  // namespace lamella
