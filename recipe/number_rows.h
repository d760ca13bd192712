// NumberRows: rows of numbers in a recipe.
#pragma once

#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Rows of numbers, all of one length: points, corners, ends of segments, rows of a table.
using NumberRows = std::vector<std::vector<double>>;

/// Returns the box between two corners, mm; empty when the first is not the lower one.
Box box_of(const NumberRows& corners);

}  // namespace lamella
