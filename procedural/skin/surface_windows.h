// SurfaceWindows: a window about each of the seeds on a surface, with struts between them.
#pragma once

#include <vector>

#include "engine/field/grading.h"
#include "procedural/skin/surface_seeds.h"
#include "procedural/skin/window_pattern.h"
#include "procedural/voronoi/point_tree.h"

namespace lamella {

struct SurfaceWindowSettings {
    double window = 2;     ///< mean width of a window, mm
    Graded strut = 0.5;    ///< width of the struts, mm, > 0; asked for at the seeds
    double corner = 0.25;  ///< radius of the windows' corners, mm, >= 0
    double depth = 1;      ///< how far from the surface the pattern is wanted, mm
};

/// The windows are the Voronoi cells of the seeds in space, whose faces stand on the surface about upright,
/// each face moved inward by half a strut. Between two windows lies a strut of constant width measured
/// across the face, so nowhere on the surface is a strut narrower: half the sum of the strut's width at the
/// two seeds. The edge between two faces of a window is rounded by `corner` (the window is what a ball of
/// that radius sweeps in the wedge between the faces), and by less in a cell that has no room for it. A cell
/// less than a tenth of a window wide about its seed once its faces have moved stays closed. Seeds that lie
/// back to back have no strut between them.
class SurfaceWindows : public WindowPattern {
  public:
    /// Throws InputError for settings out of range or without seeds.
    SurfaceWindows(const std::vector<SurfaceFoot>& seeds, const SurfaceWindowSettings& settings);

    double value_near(dvec3 p, std::uint32_t& hint) const override;

    /// Seeds, and those among them whose cells have no window.
    std::size_t seed_count() const { return cells_.size(); }
    std::size_t closed_count() const { return closed_; }

  private:
    struct Face {
        dvec3 normal;     ///< away from the seed
        double distance;  ///< from the seed, mm
    };
    struct Cell {
        std::uint32_t first = 0, walls_end = 0, end = 0;  ///< of faces_: walls, then those without a strut
        double inset = 0;                                 ///< half a strut, mm
        double corner = 0;                                ///< mm
        double beyond = 0;                                ///< how far it is surely solid beyond the walls, mm
        bool closed = false;
    };

    /// How far apart seeds are at most whose cells can come near each other, mm.
    double neighbourhood() const { return 2 * std::sqrt(3.0) * reach_; }

    Cell make_cell(const std::vector<SurfaceFoot>& seeds, std::uint32_t own, double half, double min_room);
    double excess(const Cell& cell, dvec3 q) const;
    /// How far a point (from the seed) is from the planes of a cell's faces, mm.
    struct Ways {
        double wall = infinity, border = infinity;
        bool inside = false;  ///< surely in the cell, so that no other seed is nearer
    };
    Ways ways_out(const Cell& cell, dvec3 q) const;

    PointTree tree_;
    double reach_;                 ///< half side of the cube that a cell is cut from, mm
    double corner_;                ///< mm
    double min_inset_ = infinity;  ///< mm
    std::vector<Cell> cells_;
    std::vector<Face> faces_;
    std::size_t closed_ = 0;
};

/// Windows of random shape: at scattered seeds. `seed` picks the places.
std::shared_ptr<const SurfaceWindows> make_voronoi_windows(const Field& body,
                                                           const SurfaceWindowSettings& settings,
                                                           std::uint64_t seed);

/// Hexagonal windows, `window` mm from side to side.
std::shared_ptr<const SurfaceWindows> make_hexagon_windows(const Field& body,
                                                           const SurfaceWindowSettings& settings);

}  // namespace lamella
