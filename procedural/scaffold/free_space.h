// Free space: where supports have room beside a part, asked of the part's field itself.
#pragma once

#include <optional>

#include "engine/field/field.h"

namespace lamella {

/// The clearance about a part, found by stepping from value to value (sphere tracing, Hart 1996). What is
/// proven holds to 0.05 mm. Of a part whose values tell the distance, exactly or as a bound, nothing is
/// overlooked; of one with signs alone, points round about are asked, and what lies between them is not seen.
class FreeSpace {
  public:
    /// The part must outlive this. bed: height below which nothing is asked for, mm.
    FreeSpace(const Field& part, double bed);

    double bed() const { return bed_; }
    /// A lower bound of the distance to the part, mm, as far as `limit` (> 0); negative inside.
    double clearance(dvec3 p, double limit) const;
    /// Whether the line from a to b stays `distance` (mm) away from the part.
    bool clear(dvec3 a, dvec3 b, double distance) const;
    /// Whether a line that leaves the part at `contact` soon is `distance` away and stays so: near the
    /// contact it need only have `slope` mm of room for each mm of its way. There are 0.4 beside a surface at
    /// 24 degrees to it. A contact within the part counts from where the line comes out of it, if that is
    /// within 0.5 mm.
    bool clear_from_contact(dvec3 contact, dvec3 end, double distance, double slope = 0.4) const;
    /// How far a line from p in a direction (of length 1, downward) goes.
    struct Fall {
        double clear = 0;  ///< mm of it that are `distance` away from the part
        std::optional<double>
            hits;            ///< mm to the part's surface, when it ends there; else it reaches the bed
        bool passes = true;  ///< false where it comes too near to the part and then goes on beside it
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
