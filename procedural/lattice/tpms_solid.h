// TpmsSolid: evaluates a triply periodic solid at points, over boxes and along lines, by the formulas of
// tpms.h.
#pragma once

#include <optional>

#include "procedural/lattice/tpms_network.h"
#include "procedural/lattice/tpms_wall.h"

namespace lamella {

/// A solid with valid settings, whose gradings are positive and finite everywhere.
class TpmsSolid {
  public:
    explicit TpmsSolid(const TpmsSettings& settings);

    bool is_constant() const { return constant_period_ && constant_thickness_; }
    bool has_constant_period() const { return constant_period_; }
    TpmsKind kind() const { return settings_.kind; }
    const Box& region() const { return settings_.region; }
    /// The point where all angles are 0: the region's centre.
    dvec3 center() const { return center_; }
    /// The period at the region's centre, mm.
    double period() const { return period_; }
    double period_at(dvec3 p) const { return constant_period_ ? period_ : settings_.period->at(p); }
    /// Half of a thickness, in radians.
    static double half_angle(double thickness, double period) { return turn / 2 * thickness / period; }
    /// Returns the value of a network with the central period where g has this value, mm.
    double network_value(double g, double thickness) const {
        return (g - network_->level(half_angle(thickness, period_))) * (period_ / (turn * g_.steepest));
    }
    /// The wall of a sheet; null for a network.
    const TpmsWall* wall() const { return network_ ? nullptr : &wall_; }
    double thickness_at(dvec3 p) const {
        return constant_thickness_ ? thickness_ : settings_.thickness->at(p);
    }
    /// Computes the thickness at many points; as many numbers as points, as in values().
    void thicknesses(std::span<const dvec3> points, std::span<double> out) const;
    Interval thickness_over(const Box& box) const {
        return constant_thickness_ ? Interval{thickness_, thickness_} : settings_.thickness->range(box);
    }

    /// Returns sine and cosine of the angle at a distance (mm) from the centre along an axis.
    static SineCosine angle(double distance, double period) {
        return sine_cosine(angle_of(distance, period));
    }
    /// Returns that angle, in the unit of sine_cosine().
    static double angle_of(double distance, double period) { return distance * turn / period; }
    /// Returns the field's value at a point with these angles, mm.
    double value_at(const TpmsPoint& point, double period, double thickness) const;
    /// Returns an upper bound of the change of the value per mm along a line parallel to `axis` (0 to 2). The
    /// contribution of gradings is estimated from their differences on a lattice over the region.
    double steepest(int axis) const { return 1 + graded_change_[axis]; }
    /// Returns how much of that gradings contribute.
    double graded_change(int axis) const { return graded_change_[axis]; }
    /// The maximum gradient of g.
    double steepest_wave() const { return g_.steepest; }
    /// Finds the turns in which one period of a line of a network with struts of this thickness is solid, as
    /// wave_runs() does. The period is that at the region's centre.
    void find_network_runs(Axis axis, const SineCosine& across, const SineCosine& z, double thickness,
                           std::vector<Interval>& out) const;

    double value(dvec3 p) const;
    void values(std::span<const dvec3> points, std::span<double> out) const;
    /// Computes numbers of the same sign that are faster to compute and bound the same distances, but jump.
    void bounds(std::span<const dvec3> points, std::span<double> out) const;
    Interval range(const Box& box) const;

  private:
    template <class Value>
    void compute(std::span<const dvec3> points, std::span<double> out, const Value& value) const;
    void periods(std::span<const dvec3> points, std::span<double> out) const;
    dvec3 survey_gradings() const;

    static constexpr double turn = 2 * pi;

    TpmsSettings settings_;
    TpmsConstants g_;
    TpmsWall wall_;
    std::optional<TpmsNetwork> network_;  ///< empty for a sheet
    dvec3 center_;
    double period_, thickness_;
    bool constant_period_, constant_thickness_;
    /// estimated contribution of the gradings to the change of the value per mm along each axis
    dvec3 graded_change_{0};
};

}  // namespace lamella
