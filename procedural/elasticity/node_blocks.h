// Parallel loops over nodes, and sums over nodes whose result does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "engine/base/parallel.h"
#include "procedural/elasticity/elastic_grid.h"

namespace lamella {

inline constexpr std::size_t nodes_in_a_block = 512;

/// Calls work(node) for each node, in parallel.
template <typename Work>
void for_each_node(std::size_t nodes, const Work& work) {
    const std::size_t blocks = (nodes + nodes_in_a_block - 1) / nodes_in_a_block;
    parallel_for(blocks, [&](std::size_t b) {
        const std::size_t end = std::min((b + 1) * nodes_in_a_block, nodes);
        for (std::size_t node = b * nodes_in_a_block; node < end; ++node) work(node);
    });
}

using CaseNumbers = std::array<double, load_cases>;

/// Returns the sum over all nodes of what add(node, sums) adds. Sums blocks in parallel and then the blocks
/// in order, so that rounding is reproducible.
template <typename Add>
CaseNumbers sum_over_nodes(std::size_t nodes, const Add& add) {
    std::vector<CaseNumbers> parts((nodes + nodes_in_a_block - 1) / nodes_in_a_block, CaseNumbers{});
    parallel_for(parts.size(), [&](std::size_t b) {
        const std::size_t end = std::min((b + 1) * nodes_in_a_block, nodes);
        for (std::size_t node = b * nodes_in_a_block; node < end; ++node) add(node, parts[b]);
    });
    CaseNumbers sums{};
    for (const CaseNumbers& part : parts) {
        for (std::size_t l = 0; l < load_cases; ++l) sums[l] += part[l];
    }
    return sums;
}

/// Returns the dot products of two nodal vectors, one for each load case.
template <typename A, typename B>
CaseNumbers products(std::size_t nodes, const A* a, const B* b) {
    return sum_over_nodes(nodes, [=](std::size_t node, CaseNumbers& sums) {
        for (std::size_t k = 0; k < node_numbers; ++k) {
            const std::size_t at = node * node_numbers + k;
            sums[k % load_cases] += static_cast<double>(a[at]) * static_cast<double>(b[at]);
        }
    });
}

}  // namespace lamella
