// A triply periodic solid at a point, over a box and along lines: the laws of tpms.h worked out.
#pragma once

#include "procedural/lattice/tpms_surface.h"
#include "procedural/lattice/wave_runs.h"

namespace lamella {

/// The solid of checked settings, whose gradings are positive and finite everywhere.
class TpmsSolid {
  public:
    explicit TpmsSolid(const TpmsSettings& settings);

    bool is_constant() const { return constant_period_ && constant_thickness_; }
    bool has_constant_period() const { return constant_period_; }
    TpmsKind kind() const { return settings_.kind; }
    const Box& region() const { return settings_.region; }
    /// The place where all angles are 0.
    dvec3 center() const { return center_; }
    /// The period at the region's centre, mm.
    double period() const { return period_; }
    double period_at(dvec3 p) const { return constant_period_ ? period_ : settings_.period->at(p); }
    double thickness_at(dvec3 p) const {
        return constant_thickness_ ? thickness_ : settings_.thickness->at(p);
    }
    /// Those at many points, as many; and so with values().
    void thicknesses(std::span<const dvec3> points, std::span<double> out) const;
    Interval thickness_over(const Box& box) const {
        return constant_thickness_ ? Interval{thickness_, thickness_} : settings_.thickness->range(box);
    }

    /// Sine and cosine of the angle at a distance from the centre along an axis, mm.
    static SineCosine angle(double distance, double period) {
        return sine_cosine(angle_of(distance, period));
    }
    /// That angle, as sine_cosine() takes it.
    static double angle_of(double distance, double period) { return distance * turn / period; }
    /// The value where g is g, mm.
    double value_of(double g, double period, double thickness) const;
    /// How much the value changes per mm at most along a line in the direction of `axis` (0 to 2) on which g
    /// changes by at most `change_of_g` per angle, as far as the gradings' differences on a lattice of the
    /// region tell.
    double steepest(int axis, double change_of_g) const {
        return change_of_g / g_.steepest + graded_change_[axis];
    }
    /// The same for any line in that direction.
    double steepest(int axis) const { return steepest(axis, g_.steepest_along); }
    /// The values of g that are solid: strictly between these.
    Interval solid_levels(double period, double thickness) const;

    double value(dvec3 p) const;
    void values(std::span<const dvec3> points, std::span<double> out) const;
    Interval range(const Box& box) const;

  private:
    void periods(std::span<const dvec3> points, std::span<double> out) const;
    dvec3 survey_gradings() const;

    static constexpr double turn = 6.28318530717958647693;

    TpmsSettings settings_;
    TpmsConstants g_;
    dvec3 center_;
    double period_, thickness_;
    bool constant_period_, constant_thickness_;
    dvec3 graded_change_{0};  ///< what the gradings add to the change of the value per mm along each axis
};

}  // namespace lamella
