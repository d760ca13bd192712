// Layers sent through what takes and gives them one by one.
#pragma once

#include <utility>
#include <vector>

#include "engine/runs/runs.h"

namespace lamella::test {

/// All that comes out; layers are taken as soon as they are there. `as` makes of a layer what is pushed.
template <typename Layers, typename Stack, typename As>
std::vector<RunRows> through(Layers&& process, const Stack& stack, As as) {
    std::vector<RunRows> result;
    RunRows rows;
    for (const auto& layer : stack) {
        process.push(as(layer));
        while (process.pop(rows)) result.push_back(rows);
    }
    process.finish();
    while (process.pop(rows)) result.push_back(rows);
    return result;
}

template <typename Layers>
std::vector<RunRows> through(Layers&& process, const std::vector<RunRows>& stack) {
    return through(process, stack, [](const RunRows& layer) -> const RunRows& { return layer; });
}

}  // namespace lamella::test
