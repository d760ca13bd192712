// CoverageGrid: a solid as shares of cells, made from slices, and the surface where half of a cell is
// covered.
#pragma once

#include <optional>
#include <vector>

#include "engine/base/cancel_token.h"
#include "engine/field/field.h"
#include "recipe/output/brick_map.h"
#include "recipe/output/density_pyramid.h"
#include "recipe/output/plane_runs.h"

namespace lamella {

/// Positions are in cells from the grid's lower corner: one cell is one unit. Memory: about 1.4 bytes a cell,
/// and 1.5 with a second solid.
class CoverageGrid {
  public:
    /// Cuts the solids into planes and adds up what their runs cover of each cell within the bounds. `cells`
    /// is the number of cells along the longest side; all cells together are at most about `most`. Uses the
    /// calling task arena's threads. Throws Interrupted when cancelled.
    CoverageGrid(const TwoSolids& solids, const Box& bounds, int cells, double most,
                 const CancelToken* cancel);

    double pitch() const { return pitch_; }  ///< edge of a cell, mm
    dvec3 to_grid(dvec3 p) const { return (p - origin_) / pitch_; }
    dvec3 to_part(dvec3 g) const { return origin_ + g * pitch_; }
    const DensityPyramid& densities() const { return densities_; }

    /// Returns the centres, in part coordinates, of coarse cells (8 cells wide) with any solid.
    std::vector<dvec3> solid_places() const;

    /// Returns where a ray first enters the solid between two of its points.
    std::optional<double> surface(const BrickMap::Ray& ray, double from, double to) const;

    /// Returns true if a point just below the surface belongs to the second solid.
    bool of_second(dvec3 p) const;

  private:
    glm::ivec3 cells_within(const Box& bounds, int cells, double most);
    struct LayerWork;
    void fill_layer(const TwoSolids& solids, const Box& bounds, int z, LayerWork& work,
                    const CancelToken* cancel);
    void store_layer(const LayerWork& work, int z);
    void restore_thin(int z);
    void mark_part(const RunRows& rows, int z);
    std::size_t bytes_of_row() const { return static_cast<std::size_t>(densities_.cells().nx + 7) / 8; }
    std::size_t row_of_bits(int y, int z) const;
    void mark_surface();

    dvec3 origin_{0};
    double pitch_ = 1;
    DensityPyramid densities_;
    BrickMap near_;                   ///< cells of the dual grid that reach into the solid
    std::vector<std::uint8_t> thin_;  ///< while the grid is made: a bit for each cell that may be thin
    std::vector<std::uint8_t> part_;  ///< a bit for each cell that the part reaches; empty: all is part
};

}  // namespace lamella
