// SurfaceWindows: a window around each seed on a surface, with struts between the windows.
#pragma once

#include <vector>

#include "engine/field/grading.h"
#include "procedural/skin/surface_seeds.h"
#include "procedural/skin/window_pattern.h"
#include "procedural/voronoi/point_tree.h"

namespace lamella {

struct SurfaceWindowSettings {
    double window = 2;     ///< mean width of a window, mm
    Graded strut = 0.5;    ///< width of the struts, mm, > 0; sampled at the seeds
    double corner = 0.25;  ///< radius of the windows' corners, mm, >= 0
    double depth = 1;      ///< distance from the surface within which the pattern is wanted, mm
};

/// The windows are the 3D Voronoi cells of the seeds, whose faces are roughly perpendicular to the surface,
/// with each face moved inward by half a strut. Between two windows lies a strut of constant width, measured
/// perpendicular to the face: the mean of the strut widths at the two seeds. Nowhere on the surface is it
/// narrower. The edge between two faces of a window is rounded by `corner` (the window is what a ball of that
/// radius sweeps in the wedge between the faces), and by less in a cell that has no room for it. A cell stays
/// closed if it is less than a tenth of a window wide around its seed after its faces have moved. There is no
/// strut between back-to-back seeds.
class SurfaceWindows : public WindowPattern {
  public:
    /// Throws InputError for settings out of range, and if there are no seeds.
    SurfaceWindows(const std::vector<SurfaceFoot>& seeds, const SurfaceWindowSettings& settings);

    double value_near(dvec3 p, std::uint32_t& hint) const override;
    bool windows_on(dvec3 p, int axis, Interval part, std::uint32_t& hint,
                    std::vector<Interval>& out) const override;

    /// The number of seeds, and of seeds whose cells have no window.
    std::size_t seed_count() const { return cells_.size(); }
    std::size_t closed_count() const { return closed_; }

  private:
    struct Face {
        dvec3 normal;     ///< unit vector, away from the seed
        double distance;  ///< of the plane from the seed, mm
    };
    struct Cell {
        /// ranges of faces_: walls, then borders to back-to-back seeds, without a strut
        std::uint32_t first = 0, walls_end = 0, end = 0;
        double inset = 0;   ///< half a strut, mm
        double corner = 0;  ///< mm
        double beyond = 0;  ///< depth that is certainly solid beyond the walls, mm
        bool closed = false;
    };

    /// Maximum distance of seeds whose cells can be adjacent, mm.
    double neighbourhood() const { return 2 * std::sqrt(3.0) * reach_; }

    Cell make_cell(const std::vector<SurfaceFoot>& seeds, std::uint32_t own, double half, double min_room);
    struct Excess {
        double value;  ///< mm
        double slope;  ///< along an axis
    };
    Excess excess(const Cell& cell, dvec3 q, int axis) const;
    Interval window_on(const Cell& cell, dvec3 q, int axis) const;
    double rounded_end(const Cell& cell, dvec3 q, int axis, double inward) const;
    double way_to_border(const Cell& cell, dvec3 q, int axis) const;
    /// Distances of a point (relative to the seed) from the planes of a cell's faces, mm.
    struct Ways {
        double wall = infinity, border = infinity;
        bool inside = false;  ///< certainly in the cell, so that no other seed is nearer
    };
    Ways ways_out(const Cell& cell, dvec3 q) const;

    PointTree tree_;
    double reach_;                 ///< half side of the cube that a cell is clipped from, mm
    double corner_;                ///< mm
    double min_inset_ = infinity;  ///< mm
    std::vector<Cell> cells_;
    std::vector<Face> faces_;
    std::size_t closed_ = 0;
};

/// Makes windows of random shape, at scattered seeds. `seed` is that of the random numbers.
std::shared_ptr<const SurfaceWindows> make_voronoi_windows(const Field& body,
                                                           const SurfaceWindowSettings& settings,
                                                           std::uint64_t seed);

/// Makes hexagonal windows, `window` mm across flats.
std::shared_ptr<const SurfaceWindows> make_hexagon_windows(const Field& body,
                                                           const SurfaceWindowSettings& settings);

}  // namespace lamella
