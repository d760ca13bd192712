// NodeGrid: numbers the nodes of a bounded grid of elements, with a margin, so that no neighbour is missing.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace lamella {

/// Nodes are stored x fastest with a margin of one node on each side, and so are elements, at the number of
/// their lowest corner. What lies in the margin is void and does not move, and a loop over consecutive
/// numbers needs no special case at a border. `Dim` is 2 or 3; in the plane z is 0.
template <std::size_t Dim>
class NodeGrid {
    static_assert(Dim == 2 || Dim == 3);

  public:
    static constexpr std::size_t neighbours = Dim == 2 ? 9 : 27;  ///< a node itself included
    static constexpr std::size_t corners = std::size_t{1} << Dim;
    /// Numbers come in tiles of this length, which no vector of a SIMD target exceeds.
    static constexpr std::size_t tile = 16;

    NodeGrid() = default;
    /// `elements`: along each side; z is not read in the plane.
    explicit NodeGrid(glm::ivec3 elements) : elements_(elements) {
        if constexpr (Dim == 2) elements_.z = 1;
        pitch_ = static_cast<std::size_t>(elements_.x) + 3;
        plane_ = pitch_ * (static_cast<std::size_t>(elements_.y) + 3);
        const std::size_t planes = Dim == 2 ? 1 : static_cast<std::size_t>(elements_.z) + 3;
        // A tile before and one behind, since loops run over whole tiles.
        size_ = ((plane_ * planes + tile - 1) / tile + 2) * tile;
    }

    glm::ivec3 elements() const { return elements_; }
    /// Nodes along each side.
    glm::ivec3 nodes() const { return {elements_.x + 1, elements_.y + 1, Dim == 2 ? 1 : elements_.z + 1}; }
    /// Returns how many numbers an array over this grid has; a multiple of the tile.
    std::size_t size() const { return size_; }
    /// Returns the number of a node or element; coordinates range from -1 to one past the last node.
    std::size_t number(int x, int y, int z) const {
        const std::size_t row =
            tile + static_cast<std::size_t>(x + 1) + pitch_ * static_cast<std::size_t>(y + 1);
        return Dim == 2 ? row : row + plane_ * static_cast<std::size_t>(z + 1);
    }
    /// Returns the difference between the numbers of two nodes that lie (x, y, z) apart.
    std::ptrdiff_t step(int x, int y, int z) const {
        return x + static_cast<std::ptrdiff_t>(pitch_) * y +
               (Dim == 2 ? 0 : static_cast<std::ptrdiff_t>(plane_) * z);
    }
    /// Returns the steps from an element's number to its corners.
    std::array<std::ptrdiff_t, corners> corner_steps() const {
        std::array<std::ptrdiff_t, corners> steps{};
        for (unsigned c = 0; c < corners; ++c)
            steps[c] = step(static_cast<int>(c & 1), static_cast<int>(c >> 1 & 1), static_cast<int>(c >> 2));
        return steps;
    }
    /// Returns the steps from a node to its neighbours: (dx, dy, dz) at dx + 1 + 3 (dy + 1) + 9 (dz + 1), in
    /// the plane without dz.
    std::array<std::ptrdiff_t, neighbours> neighbour_steps() const {
        std::array<std::ptrdiff_t, neighbours> steps{};
        for (std::size_t k = 0; k < neighbours; ++k) {
            const int i = static_cast<int>(k);
            steps[k] = step(i % 3 - 1, i / 3 % 3 - 1, Dim == 2 ? 0 : i / 9 - 1);
        }
        return steps;
    }

  private:
    glm::ivec3 elements_{0};
    std::size_t pitch_ = 0, plane_ = 0, size_ = 0;
};

/// A number for each node and direction: displacements or forces. One array per direction.
template <std::size_t Dim, typename Number>
struct NodalVector {
    std::array<std::vector<Number>, Dim> along;

    NodalVector() = default;
    explicit NodalVector(std::size_t size) {
        for (auto& numbers : along) numbers.assign(size, Number{0});
    }
    std::array<Number*, Dim> data() {
        std::array<Number*, Dim> pointers;
        for (std::size_t d = 0; d < Dim; ++d) pointers[d] = along[d].data();
        return pointers;
    }
    std::array<const Number*, Dim> data() const {
        std::array<const Number*, Dim> pointers;
        for (std::size_t d = 0; d < Dim; ++d) pointers[d] = along[d].data();
        return pointers;
    }
};

}  // namespace lamella
