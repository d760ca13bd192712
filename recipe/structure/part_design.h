// PartDesign: the densities that a search found for a part, and its report.
#pragma once

#include <memory>
#include <span>

#include "procedural/optimization/density_shape.h"
#include "recipe/structure/structure_report.h"

namespace lamella {

struct PartDesign {
    DensityGrid grid;  ///< above 0.5 is solid; of a foam its solid volume fraction. Smooth beyond the body
    Box box;           ///< of the grid, mm
    std::shared_ptr<StructureReport> report;
};

/// Layers of elements outside the body that continue its densities: as far as trilinear samples reach.
constexpr int extended_layers = 2;

/// Shifts densities such that the shape, where they are above 0.5, fills the largest of these shares of the
/// body's elements, and empties the pieces that lack an anchored or a loaded element. If less than the
/// smallest share is left, the rest grows to it. Flags are by element. Returns the number of pieces emptied.
std::size_t cut_shape(DensityGrid& grid, Interval volume, std::span<const std::uint8_t> anchored,
                      std::span<const std::uint8_t> loaded);

}  // namespace lamella
