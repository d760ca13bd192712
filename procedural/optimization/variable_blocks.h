// Parallel loops over design variables, and sums over them whose bits do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/base/parallel.h"

namespace lamella {

/// Variables that one thread works on at a time. Sums are rounded block by block, so results depend on it.
inline constexpr std::size_t variables_in_a_block = 4096;

/// Calls work(block, begin, end) for each block of the variables [0, count), in parallel.
template <typename Work>
void for_each_variable_block(std::size_t count, const Work& work) {
    const std::size_t blocks = (count + variables_in_a_block - 1) / variables_in_a_block;
    parallel_for(blocks, [&](std::size_t b) {
        work(b, b * variables_in_a_block, std::min((b + 1) * variables_in_a_block, count));
    });
}

/// Returns the sum of what add(j, sums) adds for each variable j. Sums start as Sums{} and know +=. Blocks
/// are summed in parallel and then added in order.
template <typename Sums, typename Add>
Sums sum_over_variables(std::size_t count, const Add& add) {
    std::vector<Sums> parts((count + variables_in_a_block - 1) / variables_in_a_block);
    for_each_variable_block(count, [&](std::size_t b, std::size_t begin, std::size_t end) {
        Sums part{};
        for (std::size_t j = begin; j < end; ++j) add(j, part);
        parts[b] = part;
    });
    Sums sums{};
    for (const Sums& part : parts) sums += part;
    return sums;
}

}  // namespace lamella
