// DensityFilter: the cone-weighted mean of design variables around each element, and its transpose.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "procedural/optimization/design_grid.h"

namespace lamella {

/// What the filter sees beyond the borders of the grid.
enum class FilterPadding {
    cut,     ///< nothing: weights end at the border
    mirror,  ///< the grid and its domain, mirrored at the border; the borders act as planes of symmetry
};

/// The linear density filter (Bruns and Tortorelli 2001; Bourdin 2001; in the discrete form of Andreassen et
/// al. 2011, "Efficient topology optimization in MATLAB using 88 lines of code"):
///
///     out_i = sum_j w_ij x_j / H_i,   w_ij = max(0, r - |i - j|),   H_i = sum_j w_ij,
///
/// over the elements j of the domain; |i - j| is the distance of centres in elements. Outside the domain the
/// results are 0, and values there are ignored. A constant stays constant, at borders and edges of the mask
/// as well. The sum of all values stays the same only where H is the same for all elements: with mirrored
/// borders and no element outside the domain.
///
/// Cost: one number per element of the ball of radius r is added, but only one per ring (same distance from
/// the x axis) and step in x is multiplied. 1.6 million elements with r = 4 in 3D take about 0.2 s on one
/// core. Every element is summed in a fixed order, so the bits do not depend on the number of threads.
class DensityFilter {
  public:
    /// The largest radius in elements.
    static constexpr double max_radius = 256;

    /// Takes the radius in elements. Throws InputError unless it lies in [1, max_radius] and size and mask
    /// are those of a DesignGrid.
    DensityFilter(glm::ivec3 size, std::span<const std::uint8_t> domain, double radius,
                  FilterPadding padding = FilterPadding::cut);

    /// Lets these elements (1; one number per element) see void where the grid or the domain ends: H_i
    /// becomes that of an element all of whose neighbours are there. A member along such a border is then
    /// measured like any other; without it, its mirror image counts as well, and it may be half as thick.
    void open_border(std::span<const std::uint8_t> elements);

    const DesignGrid& grid() const { return grid_; }
    double radius() const { return radius_; }

    /// Computes the filtered values. These three throw InputError if a span has another number of elements
    /// than the grid; `out` may be the same memory as an input.
    void forward(std::span<const double> values, std::span<double> out) const;
    /// Computes the gradient with respect to the values from that with respect to the filtered values:
    /// out_j = sum_i w_ij g_i / H_i, the transpose of forward.
    void backward(std::span<const double> gradient, std::span<double> out) const;
    /// Sigmund's sensitivity filter (as in that paper): out_i = sum_j w_ij x_j g_j / (H_i max(1e-3,
    /// x_i)). A heuristic for optimality criteria with rho = x, not the gradient of any function.
    void sensitivities(std::span<const double> values, std::span<const double> gradient,
                       std::span<double> out) const;

  private:
    /// Rows (offsets in y and z) that have the same distance from the x axis, hence the same weights along x.
    struct Ring {
        std::vector<glm::ivec2> rows;
        std::vector<double> weights;  ///< by |dx|
    };
    template <class Source>
    std::vector<double> padded(const Source& source) const;
    template <class Source, class Finish>
    void smooth(const Source& source, const Finish& finish, std::span<double> out) const;

    DesignGrid grid_;
    double radius_;
    FilterPadding padding_;
    glm::ivec3 pad_{0};
    std::vector<Ring> rings_;
    std::vector<double> weight_sums_;  ///< H by element, 0 outside the domain
};

}  // namespace lamella
