// Voronoi foam below a face that cuts its cells: the share of its modulus that is left.
#pragma once

#include "engine/base/geometry.h"

namespace lamella {

/// Returns the mean share of its modulus that a Voronoi foam of beams has between two depths (mm) below a
/// bare face: 1 - exp(-depth / length), of a length that is a fraction of the cell. A beam that the face cuts
/// carries nothing towards its loose end (Onck, Andrews, Gibson 2001, "Size effects in ductile cellular
/// solids", part I); the form and the length, 0.36 - 1.2 ratio cells, fit bars of 3 to 6 cells in tension and
/// bending with beams of 0.075 to 0.2 cells. `ratio` is that of the beam's radius to the cell.
double cut_cells_share(Interval depths, double cell, double ratio);

/// Returns the depth (mm) from which cut_cells_share() is 0.99 or more for every ratio.
double cut_cells_depth(double cell);

}  // namespace lamella
