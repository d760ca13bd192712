// Whether the print stands at each height: weight and adhesion against the push of the nozzle.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// When a print stands.
struct StabilityLimits {
    double margin = 1;       ///< by which the centre of mass must lie inside the hull of what holds, mm
    double push = 0.1;       ///< sideways force at the height reached, N
    double adhesion = 0.02;  ///< of what lies on the bed, MPa
    double bond = 1;         ///< of the part to a support point, MPa: fused, not merely laid on a plate
    double contact = 0.3;    ///< area by which a support point sticks, mm^2
    double density = 1.24;   ///< of the material, g/cm^3
    double min_height =
        1;  ///< over its hold, that a component must reach to tip, mm: below, the nozzle passes above it
};

/// The components of a print that nothing joins yet, each with its mass and with what holds it. A component
/// stands when it tips over no edge of its hull, the convex hull of its contact with the bed and of its
/// support points. For every edge, with distances inward from it, in N mm:
///     weight (distance of its centre of mass - margin) + adhesion area (distance of the contact's centre)
///     + bond contact (sum of the distances of its points) >= push (height reached - height of its lowest
///     hold).
/// A support point holds by a disc of the area `contact`. After Dumas, Hergel and Lefebvre 2014, where the
/// weight alone counts.
class PrintStability {
  public:
    /// A point closer than half of `spacing` (mm) to another one adds nothing, unless it widens the hull.
    /// `bed`: its height, in the coordinates of everything else, mm.
    PrintStability(const StabilityLimits& limits, double spacing, double bed = 0);

    /// Material of a component: its volume (mm^3) and the volume times its centre (mm^4).
    void add(std::uint32_t component, double volume, dvec2 moment);
    /// Its contact with the bed: area (mm^2), area times centre (mm^3), and what encloses it.
    void lay_on_bed(std::uint32_t component, double area, dvec2 moment, const std::vector<dvec2>& border);
    /// A support point that holds it.
    void hold(std::uint32_t component, dvec3 point);
    /// Whether `offer` would remember the place.
    bool wants(std::uint32_t component, dvec3 place) const;
    /// A place where it could be held from below.
    void offer(std::uint32_t component, dvec3 place);
    /// Two components have become one, that goes on as `kept`.
    void join(std::uint32_t kept, std::uint32_t joined);
    /// Forgets all but these components (ascending): nothing more will be added to the others.
    void keep_only(const std::vector<std::uint32_t>& components);

    /// Adds points until all that has reached `height` stands, or no offered place helps.
    /// Returns the points in the order of components; they count as holds already.
    std::vector<dvec3> steady(double height);
    /// Height from which some component no longer stands, whatever point is added; infinite when all do.
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
        double lowest = infinity;  ///< height of what holds it
        std::vector<dvec2> hull;   ///< counter-clockwise
        std::vector<dvec2> fresh;  ///< to become part of the hull
        std::vector<dvec3> held;   ///< its support points
        std::array<dvec3, directions> places{};
        std::array<double, directions> reach{};
        bool toppled = false;
        Component() { reach.fill(-infinity); }
    };
    struct Edge {
        dvec2 from, inward;
        double moment;  ///< that is left over, N mm; negative: it topples
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
