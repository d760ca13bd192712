// A part of a search, on one grid.
#include "procedural/elements/element_search.h"

#include <cmath>
#include <utility>

namespace lamella {

int coarse_iterations(int all) {
    constexpr double share = 0.6;
    return static_cast<int>(std::lround(share * all));
}

template <std::size_t Dim>
FoundElements search_elements(const ElementSearchGrid<Dim>& grid, const ElementSettings& settings, int end,
                              std::vector<PlacedElement> start,
                              const std::function<void(const ElementIteration&)>& on_iteration) {
    ElementOptimizer<Dim> search(*grid.problem, grid.cells, grid.shapes, settings, std::move(start));
    for (int i = settings.begin; i < end; ++i) {
        ElementIteration done = search.iterate();
        done.compliance *= grid.compliance_unit;
        if (on_iteration) on_iteration(done);
    }
    return {search.elements(), search.loads()};
}

template FoundElements search_elements<2>(const ElementSearchGrid<2>&, const ElementSettings&, int,
                                          std::vector<PlacedElement>,
                                          const std::function<void(const ElementIteration&)>&);
template FoundElements search_elements<3>(const ElementSearchGrid<3>&, const ElementSettings&, int,
                                          std::vector<PlacedElement>,
                                          const std::function<void(const ElementIteration&)>&);

}  // namespace lamella
