// DensityMap: from design variables to densities, and gradients back.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/geometry.h"
#include "procedural/optimization/density_filter.h"
#include "procedural/optimization/element_use.h"
#include "procedural/optimization/overhang_filter.h"
#include "procedural/optimization/robust_fields.h"

namespace lamella {

struct DensitySettings {
    double radius = 1.5;  ///< of the density filter, elements
    FilterPadding padding = FilterPadding::cut;
    std::optional<LengthScale> length_scale{};  ///< replaces the radius: three fields, see RobustFields
    /// By element: sees void beyond the border, see DensityFilter::open_border. Empty: none does.
    std::vector<std::uint8_t> open{};
    /// By element: the least and the greatest density of free ones, between which shares are filtered instead
    /// of densities, so that none leaves its own limits; of kept ones the density, twice. Empty: no limits.
    std::vector<Interval> limits{};
    std::array<bool, 3> mirrored{};  ///< symmetry across the middle of the grid, by axis
    std::optional<OverhangSettings> overhang{};
};

/// Chain of symmetry, filter, projection, overhang filter and prescribed elements. The intermediate result of
/// each link is kept for the gradients.
class DensityMap {
  public:
    /// The fields of one design. Without a length scale the three are one and the same.
    enum class Role : std::uint8_t { stiffness, volume, result };

    /// Throws InputError for limits of another number of elements, and for kept elements without limits.
    DensityMap(glm::ivec3 size, std::vector<ElementUse> use, const DensitySettings& settings);

    glm::ivec3 size() const { return size_; }
    std::span<const ElementUse> use() const { return use_; }
    std::span<const std::uint8_t> domain() const { return domain_; }
    const DensityFilter& filter() const { return robust_ ? robust_->filter() : *filter_; }
    bool has_three_fields() const { return robust_.has_value(); }

    /// Computes the densities. `sharpness` of the projection; 0: none.
    void forward(std::span<const double> design, double sharpness);
    std::span<const double> density(Role role) const { return fields_[field_of(role)].density; }
    /// The densities before projection and overhang filter, as prescribed where they are: smooth, and
    /// the result's contour is where they are 0.5.
    std::vector<double> smooth_density() const;
    /// Returns the gradient with respect to the design variables from that with respect to a density.
    std::vector<double> backward(Role role, std::span<const double> gradient) const;

  private:
    struct DensityField {
        std::vector<double> density;
        std::optional<OverhangFilter> overhang;
    };
    std::size_t field_of(Role role) const { return robust_ ? static_cast<std::size_t>(role) : 0; }
    std::vector<double> symmetric(std::span<const double> values) const;
    std::vector<double> shares(std::span<const double> design) const;
    void to_densities(std::vector<double>& shares) const;
    void scale_by_limits(std::vector<double>& gradient, bool back_to_design) const;
    void prescribe(std::vector<double>& values) const;
    void clear_prescribed(std::vector<double>& gradient) const;

    glm::ivec3 size_;
    std::vector<ElementUse> use_;
    std::vector<std::uint8_t> domain_;
    std::vector<std::uint8_t> filtered_domain_;  ///< without kept elements, which their neighbours do not see
    DensitySettings settings_;
    std::optional<DensityFilter> filter_;
    std::optional<RobustFields> robust_;
    std::vector<DensityField> fields_;
    std::vector<double> filtered_;
    double sharpness_ = 0;
};

}  // namespace lamella
