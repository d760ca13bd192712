// ElasticBody: which elements of a grid a body consists of, and where it is held.
#pragma once

#include <cstdint>
#include <vector>

#include "procedural/elasticity/grid_element.h"
#include "procedural/elasticity/node_grid.h"
#include "procedural/elasticity/node_runs.h"

namespace lamella {

/// A body of equal elements, each with a modulus of its own.
template <std::size_t Dim>
struct ElasticBody {
    NodeGrid<Dim> grid;
    GridElement<Dim> element;           ///< of modulus 1
    std::vector<std::uint8_t> present;  ///< by element number; 0: outside the body
    std::vector<std::uint8_t> fixed;    ///< by node number: bit d is set if the node cannot move along d

    /// A body that fills a grid of elements and is not held anywhere.
    ElasticBody(const NodeGrid<Dim>& nodes, const GridElement<Dim>& kind)
        : grid(nodes), element(kind), present(grid.size()), fixed(grid.size()) {
        for_each_element([&](std::size_t e) { present[e] = 1; });
    }
    /// Calls visit(number) for each element of the grid, in ascending order.
    template <typename Visit>
    void for_each_element(const Visit& visit) const {
        const glm::ivec3 n = grid.elements();
        for (int z = 0; z < n.z; ++z) {
            for (int y = 0; y < n.y; ++y) {
                const std::size_t row = grid.number(0, y, z);
                for (std::size_t x = 0; x < static_cast<std::size_t>(n.x); ++x) visit(row + x);
            }
        }
    }
};

/// Returns the runs of nodes that touch an element of the body.
template <std::size_t Dim>
NodeRuns used_nodes(const NodeGrid<Dim>& grid, const std::vector<std::uint8_t>& present) {
    constexpr std::size_t tile = NodeGrid<Dim>::tile;
    const auto corners = grid.corner_steps();
    std::vector<std::uint8_t> used(grid.size() / tile);
    for (std::size_t e = 0; e < present.size(); ++e) {
        if (present[e] == 0) continue;
        for (const std::ptrdiff_t c : corners)
            used[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(e) + c) / tile] = 1;
    }
    return NodeRuns(used, tile);
}

}  // namespace lamella
