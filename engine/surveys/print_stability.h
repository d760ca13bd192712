// PrintStability: whether a print stands at each height: weight and adhesion against the push of the nozzle.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// The assumptions under which a print stands.
struct StabilityLimits {
    double margin = 1;       ///< least distance of the centre of mass inside the hull of the contacts, mm
    double push = 0.1;       ///< sideways force of the nozzle at the current height, N
    double adhesion = 0.02;  ///< adhesion of the contact with the bed, MPa
    double bond = 1;         ///< bond of the part to a support point, MPa: fused, not merely laid on a plate
    double contact = 0.3;    ///< contact area of a support point, mm^2
    double density = 1.24;   ///< of the material, g/cm^3
    /// Least height above its lowest contact at which a component can tip, mm: lower, the nozzle passes above
    /// it.
    double min_height = 1;
};

/// Tracks the connected components of a print as far as it has been printed: the mass of each, its contact
/// with the bed and its support points. A component stands if it tips over no edge of its hull, the convex
/// hull of its contact with the bed and of its support points. The condition for every edge, with distances
/// inward from it, in N mm:
///     weight (distance of its centre of mass - margin) + adhesion area (distance of the contact's centre)
///     + bond contact (sum of the distances of its points) >= push (height reached - height of its lowest
///     hold).
/// A support point holds by a disc of area `contact`. After Dumas, Hergel and Lefebvre 2014, who count the
/// weight alone.
class PrintStability {
  public:
    /// A point closer than half of `spacing` (mm) to another one adds nothing, unless it widens the hull.
    /// `bed` is the height of the bed in the coordinates of all points, mm.
    PrintStability(const StabilityLimits& limits, double spacing, double bed = 0);

    /// Adds material to a component: its volume (mm^3) and the volume times its centre (mm^4).
    void add(std::uint32_t component, double volume, dvec2 moment);
    /// Adds a component's contact with the bed: its area (mm^2), the area times its centre (mm^3), and points
    /// whose hull encloses it.
    void lay_on_bed(std::uint32_t component, double area, dvec2 moment, const std::vector<dvec2>& border);
    /// Adds a support point that holds a component.
    void hold(std::uint32_t component, dvec3 point);
    /// Returns true if offer() would remember the place.
    bool wants(std::uint32_t component, dvec3 place) const;
    /// Offers a place where a support point could hold a component from below.
    void offer(std::uint32_t component, dvec3 place);
    /// Merges two components into one, numbered `kept`.
    void join(std::uint32_t kept, std::uint32_t joined);
    /// Forgets all but these components (ascending): nothing more will be added to the others.
    void keep_only(const std::vector<std::uint32_t>& components);

    /// Adds support points until all components stand at `height`, or no offered place helps. Returns the
    /// points in the order of components; they count as held already.
    std::vector<dvec3> steady(double height);
    /// Returns the height from which some component does not stand, whatever point is added; infinite if all
    /// stand.
    double topples_at() const { return topples_at_; }

  private:
    static constexpr std::size_t directions = 16;
    struct Contact {
        double weight = 0;  ///< area, mm^2, or number of points
        dvec2 moment{0};
    };
    struct Component {
        double volume = 0;
        dvec2 moment{0};
        Contact bed, points;
        double lowest = infinity;  ///< height of its lowest contact
        std::vector<dvec2> hull;   ///< counter-clockwise
        std::vector<dvec2> fresh;  ///< points not yet included in the hull
        std::vector<dvec3> held;   ///< its support points
        std::array<dvec3, directions> places{};
        std::array<double, directions> reach{};
        bool toppled = false;
        Component() { reach.fill(-infinity); }
    };
    struct Edge {
        dvec2 from, inward;
        double moment;  ///< surplus of the holding moment, N mm; negative: it topples
        double distance(dvec2 p) const { return (p.x - from.x) * inward.x + (p.y - from.y) * inward.y; }
    };
    void hold(Component& component, dvec3 point) const;
    Edge weakest_edge(const Component& component, double height) const;
    const dvec3* max_helpful(const Component& component, const Edge& edge) const;
    void make_steady(Component& component, double height, std::vector<dvec3>& added);

    StabilityLimits limits_;
    double spacing_;
    double bed_;
    double contact_radius_;
    std::map<std::uint32_t, Component> components_;
    double topples_at_ = infinity;
};

}  // namespace lamella
