// IslandPlanner: plans the beads of one island of a layer.
#pragma once

#include "printers/polygons/inscribed_disc.h"
#include "printers/polygons/polygons.h"
#include "printers/toolpath/toolpath.h"

namespace lamella {

/// Plans the islands of one layer one after another; see plan_toolpaths.
class IslandPlanner {
  public:
    IslandPlanner(const ToolpathSettings& settings, int layer_index, const LayerNeighborhood& around,
                  const CancelToken* cancel);

    /// Plans the beads of a connected piece with its holes, of at least LineSettings::min_area().
    std::vector<Bead> plan(const Polygons& island);

  private:
    void fill(const Polygons& exact, const Polygons& piece, int walls_laid);
    void fill_thick(const Polygons& exact, const Polygons& piece, int walls_laid);
    bool lay_walls(const Polygons& exact, const Polygons& piece, int walls_laid);
    bool fill_even_wall(const Polygons& piece, const InscribedDisc& disc, double area, Role role);
    void fill_narrow(const Polygons& piece, bool full_width_fits, Role role);
    void fill_inside(const Polygons& inside);
    void fill_region(const Polygons& region, double density);
    void add(std::vector<Bead> beads);
    double volume_from(std::size_t first) const;

    ToolpathSettings settings_;
    LineSettings line_;
    LayerNeighborhood around_;
    const CancelToken* cancel_;
    dvec2 direction_;
    int sparse_regions_ = 0;  ///< regions of the island that beads do not fill
    std::vector<Bead> beads_;
};

}  // namespace lamella
