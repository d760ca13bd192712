// A search for elements that begins on a coarse grid and ends on a finer one.
#pragma once

#include "procedural/elements/element_optimizer.h"

namespace lamella {

/// A problem on a grid of cells, and the shapes as tables that reach as far as the border of elements there.
template <std::size_t Dim>
struct ElementSearchGrid {
    const TopologyProblem<Dim>* problem;
    CellGrid cells;
    std::span<const DistanceTable> shapes;
    double compliance_unit = 1;  ///< factor of the compliances that are told
};

/// Elements as a search left them.
struct FoundElements {
    std::vector<PlacedElement> elements;
    std::vector<double> loads;  ///< of each, as ElementOptimizer::loads()
};

/// Of a search that begins on a coarse grid and ends on one of cells half as wide: the number of its
/// iterations on the coarse one, which find how the elements bear the loads. On the fine one the smooth
/// border of elements is narrow, so that gaps and slight contacts carry as little as in the true shapes
/// (thesis 4.3, adaptive simulation).
int coarse_iterations(int all);

/// Optimises elements by ElementOptimizer on a grid, in the iterations from settings.begin to `end`. Throws
/// as ElementOptimizer does.
template <std::size_t Dim>
FoundElements search_elements(const ElementSearchGrid<Dim>& grid, const ElementSettings& settings, int end,
                              std::vector<PlacedElement> start,
                              const std::function<void(const ElementIteration&)>& on_iteration = {});

extern template FoundElements search_elements<2>(const ElementSearchGrid<2>&, const ElementSettings&, int,
                                                 std::vector<PlacedElement>,
                                                 const std::function<void(const ElementIteration&)>&);
extern template FoundElements search_elements<3>(const ElementSearchGrid<3>&, const ElementSettings&, int,
                                                 std::vector<PlacedElement>,
                                                 const std::function<void(const ElementIteration&)>&);

}  // namespace lamella
