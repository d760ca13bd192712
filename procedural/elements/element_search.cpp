// The fine grid's search starts from the elements of the coarse one.
#include "procedural/elements/element_search.h"

#include <cmath>
#include <utility>

namespace lamella {

namespace {

/// Searches on one grid up to an iteration.
template <std::size_t Dim>
FoundElements search_on(const ElementSearchGrid<Dim>& grid, const ElementSettings& settings, int end,
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

}  // namespace

template <std::size_t Dim>
FoundElements search_elements(const ElementSearchGrid<Dim>& coarse, const ElementSearchGrid<Dim>* fine,
                              ElementSettings settings, std::vector<PlacedElement> start,
                              const std::function<void(const ElementIteration&)>& on_iteration) {
    if (fine == nullptr)
        return search_on(coarse, settings, settings.iterations, std::move(start), on_iteration);
    constexpr double coarse_share = 0.6;
    const auto begin = static_cast<int>(std::lround(coarse_share * settings.iterations));
    FoundElements found = search_on(coarse, settings, begin, std::move(start), on_iteration);
    settings.begin = begin;
    return search_on(*fine, settings, settings.iterations, std::move(found.elements), on_iteration);
}

template FoundElements search_elements<2>(const ElementSearchGrid<2>&, const ElementSearchGrid<2>*,
                                          ElementSettings, std::vector<PlacedElement>,
                                          const std::function<void(const ElementIteration&)>&);
template FoundElements search_elements<3>(const ElementSearchGrid<3>&, const ElementSearchGrid<3>*,
                                          ElementSettings, std::vector<PlacedElement>,
                                          const std::function<void(const ElementIteration&)>&);

}  // namespace lamella
