// ElementRaster: placed elements as densities of a grid of cells, and the way back for gradients.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "procedural/elements/distance_table.h"
#include "procedural/elements/placed_element.h"
#include "procedural/optimization/element_use.h"

namespace lamella {

/// The finite elements of a body, x fastest, then y, then z; here they are called cells. Lengths in mm.
struct CellGrid {
    glm::ivec3 size{0};
    dvec3 corner{0};       ///< the lowest
    dvec3 edges{1};        ///< of a cell
    bool is_flat = false;  ///< one layer of cells: elements lie in the plane z = 0 of their own frame

    std::size_t cells() const {
        return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
               static_cast<std::size_t>(size.z);
    }
    std::size_t number(glm::ivec3 at) const {
        return static_cast<std::size_t>(at.x) +
               static_cast<std::size_t>(size.x) *
                   (static_cast<std::size_t>(at.y) +
                    static_cast<std::size_t>(size.y) * static_cast<std::size_t>(at.z));
    }
    dvec3 centre(glm::ivec3 at) const { return corner + (dvec3(at) + 0.5) * edges; }
    Box box() const { return {corner, corner + dvec3(size) * edges}; }
    /// Returns the mean edge along the dimensions, mm.
    double edge() const { return is_flat ? 0.5 * (edges.x + edges.y) : (edges.x + edges.y + edges.z) / 3; }
};

/// The derivatives of a number with respect to an element's place (mm), rotation (radians about x, y, z
/// through its place) and scale.
struct ElementGradient {
    dvec3 at{0}, turn{0};
    double scale = 0;
};

/// Projects elements to densities, smoothly, so that gradients exist (Wein, Dunning and Norato 2020, "A
/// review on feature-mapping methods for structural optimization"):
///
///     r_k = H(-(phi_k + thinner * width) / width),  H(t) = 1/2 + 3/4 (t - t^3 / 3) in [-1, 1],
///     rho = min(1, (sum_k r_k^8)^(1/8)),
///
/// phi_k being the distance of element k at the middle of a cell. Elements are taken a little thinner than
/// they are: otherwise they would stop just short of each other.
class ElementRaster {
  public:
    /// Tables and use of cells have to outlive the object. `width` is in mm, `thinner` a share of it.
    ElementRaster(const CellGrid& grid, std::span<const ElementUse> use,
                  std::span<const DistanceTable> shapes, double width, double thinner);

    /// Computes the densities of cells: those of free ones; 1 in solid ones, 0 in empty ones and outside.
    void set(std::span<const PlacedElement> elements);
    std::span<const double> densities() const { return densities_; }
    /// Returns how much of the elements' content is not in the densities: where they overlap, and where they
    /// stand out of the free cells. In cells.
    double overlap() const { return overlap_; }
    /// Returns the derivatives of sum_e by_density[e] * density_e + by_overlap * overlap, by element.
    std::vector<ElementGradient> gradients(std::span<const double> by_density, double by_overlap) const;
    /// Returns sum_e by_cell[e] * the element's part of the density of e, by element.
    std::vector<double> shares(std::span<const double> by_cell) const;

  private:
    /// What an element contributes to a cell.
    struct Part {
        std::uint32_t cell;
        double amount;    ///< r
        double slope;     ///< dr / dphi
        dvec3 gradient;   ///< of phi with respect to the cell's place
        double by_scale;  ///< dphi / dscale
    };
    std::vector<Part> parts_of(const PlacedElement& element) const;
    dvec3 centre(std::uint32_t cell) const;
    double density_slope(const Part& part) const;

    CellGrid grid_;
    std::span<const ElementUse> use_;
    std::span<const DistanceTable> shapes_;
    double width_, thinner_;
    std::vector<PlacedElement> elements_;
    std::vector<std::vector<Part>> parts_;  ///< by element
    std::vector<double> norms_;             ///< of the elements' amounts, by cell
    std::vector<double> densities_;
    double overlap_ = 0;
};

}  // namespace lamella
