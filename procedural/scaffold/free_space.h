// FreeSpace: clearance queries around a part, answered by the part's field.
#pragma once

#include <optional>

#include "engine/field/field.h"

namespace lamella {

/// The clearance around a part, found by sphere tracing (Hart 1996). Guarantees hold to within 0.05 mm. If
/// the part's values are distances or bounds of them, no obstacle is missed. If only their signs are
/// meaningful, probes on shells around each point are used, and obstacles between the probes are missed.
class FreeSpace {
  public:
    /// The part must outlive this object. `bed` is the height below which nothing is queried, mm.
    FreeSpace(const Field& part, double bed);

    double bed() const { return bed_; }
    /// Returns a lower bound of the signed distance to the part, mm, at most `limit` (> 0); negative inside.
    double clearance(dvec3 p, double limit) const;
    /// Returns whether the segment from a to b keeps a distance of `distance` (mm) from the part.
    bool clear(dvec3 a, dvec3 b, double distance) const;
    /// Returns whether a segment that starts on the part at `contact` soon reaches a distance of `distance`
    /// (mm) from the part and keeps it. Near the contact a clearance of `slope` mm for each mm along the
    /// segment suffices. A segment at 24 degrees to a flat surface has a slope of 0.4. If the contact is
    /// inside the part, the segment counts from where it leaves the part, which must be within 0.5 mm.
    bool clear_from_contact(dvec3 contact, dvec3 end, double distance, double slope = 0.4) const;
    /// How far a ray from p in a downward unit direction gets.
    struct Fall {
        double clear = 0;  ///< length over which it keeps `distance` from the part, mm
        std::optional<double>
            hits;  ///< length to the part's surface if it ends there, mm; none if it reaches the bed
        /// false if it comes closer than `distance` to the part and then goes on past it
        bool passes = true;
    };
    Fall fall(dvec3 p, dvec3 direction, double distance) const;

  private:
    double probed_room(dvec3 p, double limit) const;
    std::optional<double> leaves_part(dvec3 contact, dvec3 way) const;

    const Field& part_;
    double bed_;
    Metric metric_;
};

}  // namespace lamella
