// ElementStep: one step of the method of moving asymptotes from the present elements.
#pragma once

#include <span>
#include <vector>

#include "procedural/elements/element_raster.h"

namespace lamella {

/// How far a step may go.
struct StepLimits {
    double place = 1;       ///< of the middle or of both ends, along each axis of the element, mm
    double turn = 0;        ///< about the element's own x axis, radians; 0: elements do not turn at all
    double scale = 0;       ///< 0: scales stay
    Interval scales{1, 1};  ///< of which none leaves
};

/// A function of the elements that is not to exceed 0, with its derivatives by element.
struct ElementConstraint {
    double value = 0;
    std::vector<ElementGradient> gradients;
};

/// Steps of elements, in variables of their own: they slide along their x axis, each of their ends moves
/// across it, they roll about it, and grow. Ends are where long elements meet others and loads: moved one by
/// one, they do not tear off what holds already when the other end goes elsewhere. Each variable has a reach
/// that grows while it keeps its direction and shrinks when it turns back.
class ElementStep {
  public:
    /// The grid's elements; `arms` are the distances of the ends from the middle by shape, at scale 1, mm.
    ElementStep(const CellGrid& grid, std::vector<double> arms, bool turns, bool scales);

    /// Returns the elements after a step down the objective, whose derivatives are given by element, within
    /// the constraints, as far as they can hold. Places stay in the grid's box; in a flat grid elements move
    /// in the plane and turn about z.
    std::vector<PlacedElement> from(std::span<const PlacedElement> elements,
                                    std::span<const ElementGradient> objective,
                                    std::span<const ElementConstraint> constraints, const StepLimits& limits);
    /// Says that the last step was taken: the next call of from() compares directions with it.
    void take() { taken_ = last_; }
    /// Forgets directions and reaches.
    void forget() {
        reaches_.clear();
        taken_.clear();
        last_.clear();
    }

  private:
    enum class Kind : std::uint8_t { middle, near_end, far_end, roll, scale };
    /// What a variable changes: along an axis of the element's frame, or about it.
    struct Variable {
        Kind kind;
        int axis;
    };
    double unit(const Variable& variable, const StepLimits& limits) const;
    double derivative(const Variable& variable, const PlacedElement& element,
                      const ElementGradient& gradient) const;
    std::vector<double> derivatives(std::span<const PlacedElement> elements,
                                    std::span<const ElementGradient> gradients,
                                    const StepLimits& limits) const;
    PlacedElement changed(PlacedElement element, std::span<const double> changes,
                          const StepLimits& limits) const;
    void adapt(std::span<const double> slopes);

    CellGrid grid_;
    std::vector<double> arms_;
    std::vector<Variable> variables_;
    std::vector<double> reaches_, taken_, last_;  ///< by element, then variable
};

}  // namespace lamella
