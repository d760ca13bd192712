// Strips of a layer worked on at once.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <cstddef>

namespace lamella {

/// Calls work(i) for each i of [0, count), several at once. Within a stream that is being stopped it still
/// does them all, so that nobody comes upon half of a layer.
template <typename Work>
void for_all_strips(std::size_t count, const Work& work) {
    oneapi::tbb::task_group_context own(oneapi::tbb::task_group_context::isolated);
    oneapi::tbb::parallel_for(std::size_t{0}, count, work, own);
}

}  // namespace lamella
