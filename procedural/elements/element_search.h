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

/// Optimises elements by ElementOptimizer on one grid or two. Of two, the coarse one has three fifths of the
/// iterations, which find how the elements bear the loads, and the fine one the rest: there the smooth border
/// of elements is narrow, so that gaps and slight contacts carry as little as in the true shapes (thesis 4.3,
/// adaptive simulation). Throws as ElementOptimizer does.
template <std::size_t Dim>
FoundElements search_elements(const ElementSearchGrid<Dim>& coarse, const ElementSearchGrid<Dim>* fine,
                              ElementSettings settings, std::vector<PlacedElement> start,
                              const std::function<void(const ElementIteration&)>& on_iteration = {});

extern template FoundElements search_elements<2>(const ElementSearchGrid<2>&, const ElementSearchGrid<2>*,
                                                 ElementSettings, std::vector<PlacedElement>,
                                                 const std::function<void(const ElementIteration&)>&);
extern template FoundElements search_elements<3>(const ElementSearchGrid<3>&, const ElementSearchGrid<3>*,
                                                 ElementSettings, std::vector<PlacedElement>,
                                                 const std::function<void(const ElementIteration&)>&);

}  // namespace lamella
