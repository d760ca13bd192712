// RobustFields: the eroded, intermediate and dilated densities of one set of design variables, with the map
// of their gradients back.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "procedural/optimization/density_filter.h"
#include "procedural/optimization/length_scale.h"

namespace lamella {

/// The three-field robust formulation (Wang, Lazarov, Sigmund 2011, see length_scale.h): one filtered field,
/// projected at three thresholds. An optimiser that asks all three to carry the loads gets members and gaps
/// no thinner than length_scale.h says. For compliance it is enough that the eroded design carries and the
/// dilated one keeps the volume (Trillet, Duysinx, Fernandez 2021).
class RobustFields {
  public:
    /// One field per threshold: 0 outside the domain.
    struct Fields {
        std::vector<double> eroded, intermediate, dilated;
    };
    /// Gradients with respect to the fields; an empty one counts as 0.
    struct Gradients {
        std::span<const double> eroded, intermediate, dilated;
    };

    /// Throws as DensityFilter does, and InputError unless 0 <= dilated <= intermediate <= eroded <= 1.
    RobustFields(glm::ivec3 size, std::span<const std::uint8_t> domain, const LengthScale& scale,
                 FilterPadding padding = FilterPadding::mirror);

    /// As DensityFilter::open_border.
    void open_border(std::span<const std::uint8_t> elements) { filter_.open_border(elements); }
    const DensityFilter& filter() const { return filter_; }
    const LengthScale& scale() const { return scale_; }

    /// The filtered field of the last call of forward.
    const std::vector<double>& filtered() const { return filtered_; }

    /// Returns the fields of the design variables at a sharpness of the projection; keeps the filtered field
    /// for backward. Throws InputError for a wrong number of values or sharpness (projection.h).
    Fields forward(std::span<const double> design, double sharpness);
    /// Computes the gradient with respect to the design variables of the last call of forward. Throws
    /// InputError for a wrong number of values, FaultError without a call of forward.
    void backward(const Gradients& gradients, std::span<double> out) const;

  private:
    DensityFilter filter_;
    LengthScale scale_;
    std::vector<double> filtered_;
    double sharpness_ = 0;
};

}  // namespace lamella
