// ElasticGrid: the nodes of a periodic voxel grid that touch a solid element, and the nodal forces of a
// stencil.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "procedural/elasticity/hex_element.h"

namespace lamella {

/// Number of load cases that are solved side by side.
inline constexpr std::size_t load_cases = 6;
/// Numbers per node in a nodal vector: the x component (displacement or force) of each load case, then y,
/// then z.
inline constexpr std::size_t node_numbers = 3 * load_cases;
inline constexpr std::size_t hex_neighbours = 27;

/// The 27-point stencil of a node: the forces at the node due to displacements of the nodes around it. One
/// 3x3 block per neighbour; neighbour (dx, dy, dz) has the block number dx + 1 + 3 * (dy + 1) + 9 * (dz + 1).
template <typename Number>
using NodeStencil = std::array<Number, 9 * hex_neighbours>;

/// The solid elements of a periodic grid of cubes. Elements are stored x fastest; element (x, y, z) lies
/// between the nodes (x, y, z) and (x + 1, y + 1, z + 1).
struct ElementMask {
    glm::ivec3 size{0};
    std::vector<std::uint8_t> present;  ///< by element; non-zero: solid

    /// Returns the volume fraction: solid elements over all elements, 0 to 1.
    double share() const {
        const auto there = std::count_if(present.begin(), present.end(), [](auto p) { return p != 0; });
        return static_cast<double>(there) / static_cast<double>(std::max<std::size_t>(present.size(), 1));
    }
    bool at(int x, int y, int z) const { return present[place(x, y, z)] != 0; }
    std::size_t place(int x, int y, int z) const {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(size.x) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(size.y) * static_cast<std::size_t>(z));
    }
};

/// Numbers the nodes that belong to at least one solid element, in grid order.
class ElasticGrid {
  public:
    explicit ElasticGrid(const ElementMask& elements);

    glm::ivec3 size() const { return size_; }
    std::size_t nodes() const { return places_.size(); }
    glm::ivec3 place(std::size_t node) const { return places_[node]; }
    /// Returns the number of the node at a grid position, -1 if there is no node. Coordinates range from -1
    /// to the size and wrap around.
    std::int32_t number(int x, int y, int z) const {
        return numbers_[index(wrapped(x, size_.x), wrapped(y, size_.y), wrapped(z, size_.z))];
    }
    /// Returns the elements around a node as bits: bit e is set if the element that has this node as its
    /// corner e is solid.
    std::uint8_t elements(std::size_t node) const { return elements_[node]; }
    /// Returns the numbers of the 27 nodes around a node, itself included, in the order of NodeStencil; -1 if
    /// there is no node.
    std::array<std::int32_t, hex_neighbours> neighbours(std::size_t node) const;

  private:
    static int wrapped(int i, int size) { return i < 0 ? i + size : i >= size ? i - size : i; }
    std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(size_.x) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(z));
    }

    glm::ivec3 size_;
    std::vector<std::int32_t> numbers_;
    std::vector<glm::i16vec3> places_;
    std::vector<std::uint8_t> elements_;
};

/// Assembles the stencil of a node that is corner e of elements e = 0..7. `stiffness(e)` returns a pointer to
/// the stiffness matrix of that element, null for void.
template <typename Number, typename Stiffness>
NodeStencil<Number> gather_stencil(const Stiffness& stiffness) {
    NodeStencil<Number> stencil{};
    for (std::size_t e = 0; e < hex_nodes; ++e) {
        const auto* k = stiffness(e);
        if (k == nullptr) continue;
        for (std::size_t c = 0; c < hex_nodes; ++c) {
            const std::size_t neighbour = (1 + (c & 1) - (e & 1)) + 3 * (1 + (c >> 1 & 1) - (e >> 1 & 1)) +
                                          9 * (1 + (c >> 2 & 1) - (e >> 2 & 1));
            for (std::size_t i = 0; i < 3; ++i) {
                for (std::size_t j = 0; j < 3; ++j) {
                    stencil[9 * neighbour + 3 * i + j] += static_cast<Number>((*k)[3 * e + i][3 * c + j]);
                }
            }
        }
    }
    return stencil;
}

/// Adds the forces of a stencil to `sum`. `displacements` holds node_numbers numbers for each node of the
/// grid.
template <typename Number>
void add_forces(const NodeStencil<Number>& stencil,
                const std::array<std::int32_t, hex_neighbours>& neighbours, const Number* displacements,
                Number* sum) {
    for (std::size_t k = 0; k < hex_neighbours; ++k) {
        if (neighbours[k] < 0) continue;
        const Number* from = displacements + node_numbers * static_cast<std::size_t>(neighbours[k]);
        const Number* block = stencil.data() + 9 * k;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const Number a = block[3 * i + j];
                for (std::size_t l = 0; l < load_cases; ++l)
                    sum[load_cases * i + l] += a * from[load_cases * j + l];
            }
        }
    }
}

}  // namespace lamella
