// Slopes of formulas along one input: enclosures of difference quotients, by forward interval arithmetic
// (Krawczyk and Neumaier 1985, "Interval slopes for rational functions and associated centered forms").
#pragma once

#include <vector>

#include "engine/field/tile_walk.h"
#include "engine/formula/formula_prune.h"

namespace lamella {

/// Computes slopes over tiles. Keeps its storage for the next tile; not thread-safe.
class FormulaSlopes {
  public:
    /// Returns the slope of the program's result along input `along`, with the other inputs fixed. ranges[i]
    /// encloses instruction i over the tile; `length` is the tile's extent along that input. The slope holds
    /// for the results as computed: rounding is in its noise. Unknown where the result may jump, be NaN or
    /// rise without bound.
    SlopeBound bound(const FormulaTape& tape, std::span<const FormulaRange> ranges, std::uint32_t along,
                     double length);

  private:
    std::vector<SlopeBound> slopes_;
};

}  // namespace lamella
