// Legs: what leads from a place that must be held down to the bed or, where that cannot be reached, to the
// part.
#pragma once

#include <optional>
#include <vector>

#include "procedural/scaffold/free_space.h"
#include "procedural/scaffold/scaffold.h"

namespace lamella {

/// A way down for the load of one place.
struct Leg {
    std::vector<Beam> connectors;          ///< leaning and tapered pieces
    std::optional<ScaffoldPillar> pillar;  ///< the upright piece; none where all is short
    double landing = 0;                    ///< height at which it stands, mm
    bool on_bed = true;
    double length = 0;  ///< of all pieces, mm
};

/// Finds legs: straight down if that leads to the bed, else by a detour to it, else on the part below; where
/// a pillar has no room, by a thin strut.
class SupportRouter {
  public:
    SupportRouter(const FreeSpace& space, const ScaffoldShape& shape) : space_(space), shape_(shape) {}

    /// For a point of the part; nothing when every way touches the part.
    std::optional<Leg> under_point(dvec3 point) const;
    /// For a place clear of the part, such as the lower side of a bar's end.
    std::optional<Leg> under_bar(dvec3 place) const;

    /// Radius of connectors where they are thickest, mm.
    double connector_radius() const { return shape_.bar_width / 2; }
    /// Where the tip of a connector to a point of the part is centred.
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
