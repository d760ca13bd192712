// ElementOptimizer: moves, turns and scales elements such that together they become stiff.
#pragma once

#include <functional>

#include "procedural/elements/element_step.h"
#include "procedural/optimization/compliance.h"

namespace lamella {

struct ElementSettings {
    double overlap = 0.15;  ///< most of the elements' content that may overlap or stand out, as a share
    bool turns = true;      ///< whether elements may turn
    Interval scale{1, 1};   ///< limits of their scales
    int iterations = 150;
    int begin = 0;           ///< iterations that were done on a coarser grid
    std::uint64_t seed = 1;  ///< of the places to which idle elements go
    /// Direction of the elements' x axis by place, a unit vector; may be empty. Not with elements that turn.
    std::function<dvec3(dvec3)> way{};
    double solver_tolerance = 1e-5;
    const CancelToken* cancel = nullptr;  ///< may be null
};

/// What an iteration found.
struct ElementIteration {
    int index = 0;          ///< from 1
    double compliance = 0;  ///< weighted sum over cases, of the step that it tried
    std::size_t moved = 0;  ///< idle elements that went elsewhere
};

/// Minimises the compliance of placed elements by steps of the method of moving asymptotes within limits that
/// shrink (after Dumas, Lu, Lefebvre, Wu, Dick 2017, "Aggregates of discrete elements", and thesis 4.3). The
/// logarithm of the compliance is minimised, which falls by many decades. Steps that make the elements softer
/// are taken back and tried again half as far. Elements that carry next to nothing go to where others carry
/// most. A pure function of problem, settings and start.
template <std::size_t Dim>
class ElementOptimizer {
  public:
    /// Keeps references to the problem and the shapes; the problem's volume is not used. The grid is that of
    /// its elements. Throws InputError for a problem without loads or supports, and without elements.
    ElementOptimizer(const TopologyProblem<Dim>& problem, const CellGrid& grid,
                     std::span<const DistanceTable> shapes, const ElementSettings& settings,
                     std::vector<PlacedElement> start);

    /// Analyses a step, and takes it if it is good. Throws Interrupted once cancelled; then nothing is
    /// changed.
    ElementIteration iterate();
    bool is_finished() const { return iteration_ >= settings_.iterations; }
    /// Returns the elements that were taken last.
    const std::vector<PlacedElement>& elements() const { return elements_; }
    /// Returns how much of the strain energy each of them has, over its content, such that the mean over the
    /// content is 1.
    const std::vector<double>& loads() const { return loads_; }

  private:
    double content(const PlacedElement& element) const;
    double progress() const { return static_cast<double>(iteration_) / settings_.iterations; }
    void accept(const ElementRaster& raster, const typename Compliance<Dim>::Result& found);
    StepLimits step_limits() const;
    ElementConstraint overlap_bound(const ElementRaster& raster) const;
    ElementConstraint content_bound() const;
    void measure_loads(const ElementRaster& raster, const std::vector<double>& by_density);
    std::size_t move_idle();
    void align(std::vector<PlacedElement>& elements) const;

    const TopologyProblem<Dim>& problem_;
    CellGrid grid_;
    std::span<const DistanceTable> shapes_;
    ElementSettings settings_;
    std::vector<PlacedElement> elements_, trial_;
    std::vector<double> loads_;
    double content_;  ///< of all elements at the start
    ElementStep step_;
    Compliance<Dim> compliance_;
    int iteration_;
    bool is_new_ = true;  ///< the trial is not compared with the elements before
    bool was_late_ = false;
    double reach_ = 1;  ///< of a step, as a share of its limits
    // Of the accepted elements:
    double accepted_compliance_ = 0;
    std::vector<ElementGradient> slopes_;  ///< of the logarithm of the compliance
    std::vector<ElementConstraint> constraints_;
};

extern template class ElementOptimizer<2>;
extern template class ElementOptimizer<3>;

}  // namespace lamella
