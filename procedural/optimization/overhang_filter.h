// OverhangFilter: the densities that a printer which builds layer upon layer would make of a blueprint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/optimization/design_grid.h"

namespace lamella {

/// Parameters of the smooth minimum and maximum; the defaults are those of the paper.
struct OverhangSettings {
    int axis = 2;              ///< build direction: 0, 1 or 2 for +x, +y, +z; usually 1 in two dimensions
    double exponent = 40;      ///< P of the maximum, 4 to 1000; whole numbers up to 64 are fastest
    double smoothing = 1e-4;   ///< epsilon of the minimum, above 0
    double fixed_point = 0.5;  ///< density, in (0, 1), that equal supports of that density pass on unchanged
};

/// The layer-wise additive manufacturing filter (Langelaar 2016, "Topology optimization of 3D self-supporting
/// structures for additive manufacturing"; Langelaar 2017, "An additive manufacturing filter for
/// topology optimization of print-ready designs", in two dimensions). The printed density p of an element is
/// bounded by its blueprint density x and by the largest printed density S of the elements that support it:
///
///     p = (x + S - sqrt((x - S)^2 + epsilon) + sqrt(epsilon)) / 2
///     S = (sum_k p_k^P)^(1/Q),   Q = P + ln n / ln(fixed_point)
///
/// over the n elements below: the one straight below and its neighbours along the other axes, 3 in two
/// dimensions and 5 in three. For squares and cubes this allows overhangs up to 45 degrees. A single full
/// support passes on exactly 1. The lowest layer of the grid lies on the plate: there p = x. Elements outside
/// the domain print nothing and support nothing.
///
/// For x in [0, 1]: p lies between the minimum of x and S and x + sqrt(epsilon) / 2, so it may exceed 1 by
/// sqrt(epsilon) / 2 (0.005). Solid elements over void do not vanish altogether: sqrt(epsilon) / 2 of a layer
/// passes to the next one, where the maximum damps it; a density of about 0.07 in two dimensions and 0.05 in
/// three remains.
class OverhangFilter {
  public:
    /// Throws InputError if a setting is out of bounds, or for size and mask as DesignGrid does.
    OverhangFilter(glm::ivec3 size, std::span<const std::uint8_t> domain, const OverhangSettings& settings);

    const DesignGrid& grid() const { return grid_; }

    /// Computes the printed densities, layer by layer upward, and keeps what backward needs. Blueprint
    /// densities must not be negative. Throws InputError for a wrong number of values. `printed` may be the
    /// same memory as `blueprint`.
    void forward(std::span<const double> blueprint, std::span<double> printed);
    /// Computes the exact gradient with respect to the blueprint of the last call of forward, from that with
    /// respect to the printed densities, layer by layer downward. Throws InputError for a wrong number of
    /// values, FaultError without a call of forward. `out` may be the same memory as `gradient`.
    void backward(std::span<const double> gradient, std::span<double> out) const;

  private:
    /// The largest density among the supports, and the sum of (p_k / largest)^P.
    struct Support {
        double largest = 0;
        double sum = 0;
    };
    template <class Work>
    void for_each_of_layer(int layer, const Work& work) const;
    template <class Work>
    void for_each_in_cross(int u, int v, std::size_t centre, const Work& work) const;
    Support support(int u, int v, std::size_t below) const;

    DesignGrid grid_;
    OverhangSettings settings_;
    double root_ = 0;  ///< Q
    /// Counts and steps in memory of the layers (height) and along the two other axes (u, v).
    int layers_ = 0, width_ = 0, depth_ = 0;
    std::size_t up_ = 0, across_ = 0, along_ = 0;

    // Of the last forward pass, by element.
    std::vector<double> printed_;
    std::vector<double> by_blueprint_;  ///< dp/dx
    std::vector<double> by_support_;    ///< dp_i/dp_k = by_support_i (p_k / largest_i)^(P - 1)
    std::vector<double> largest_;
};

}  // namespace lamella
