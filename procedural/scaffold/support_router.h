// SupportRouter: routes legs from what needs support down to the bed or, if that cannot be reached, to the
// part.
#pragma once

#include <optional>
#include <vector>

#include "procedural/scaffold/free_space.h"
#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// The pieces that carry the load of one place.
struct Leg {
    std::vector<Beam> connectors;          ///< leaning and tapered pieces
    std::optional<ScaffoldPillar> pillar;  ///< the vertical piece; none for short legs
    double landing = 0;                    ///< height at which the leg stands, mm
    bool on_bed = true;
    double length = 0;  ///< total length of the pieces, mm
};

/// Finds legs: straight down to the bed if possible, else by a detour to the bed, else onto the part below;
/// where there is no room for a pillar, by a thin strut.
class SupportRouter {
  public:
    SupportRouter(const FreeSpace& space, const ScaffoldShape& shape) : space_(space), shape_(shape) {}

    /// Returns a leg for a point of the part; none if every route touches the part.
    std::optional<Leg> under_point(dvec3 point) const;
    /// Returns a leg for a place clear of the part, such as the underside of a bar's end.
    std::optional<Leg> under_bar(dvec3 place) const;

    /// The radius of connectors where they are thickest, mm.
    double connector_radius() const { return shape_.bar_width / 2; }
    /// Returns the centre of the tip of a connector to a point of the part.
    dvec3 tip_center(dvec3 point) const;

  private:
    std::optional<Leg> upright(dvec3 top) const;
    std::optional<Leg> best_detour(dvec3 top, double min_rise, double top_radius, bool contact) const;
    std::optional<double> leaves_part(dvec3 contact, dvec3 way, double longest) const;
    std::optional<Leg> strut_along(dvec3 top, dvec3 way, bool contact) const;
    std::optional<Leg> strut(dvec3 top, double longest, bool contact) const;
    bool level_enough(dvec3 place) const;
    Leg post(dvec3 top) const;
    double layer_below(double z) const;
    double foot_radius(double upper, double length, dvec3 way) const;
    double foot_radius_on_bed(dvec2 at, double height) const;

    const FreeSpace& space_;
    ScaffoldShape shape_;
};

}  // namespace lamella
