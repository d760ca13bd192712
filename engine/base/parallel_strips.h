// Parallel loop over the strips of a layer.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <cstddef>

namespace lamella {

/// Calls work(i) for each i in [0, count), in parallel. Runs all of them even when the enclosing stream is
/// being cancelled, so that no layer is left half done.
template <typename Work>
void for_all_strips(std::size_t count, const Work& work) {
    oneapi::tbb::task_group_context own(oneapi::tbb::task_group_context::isolated);
    // Race detectors do not see the synchronisation inside TBB's library; they see this.
    std::atomic<std::size_t> handed_over{0};
    const auto watched = [&](std::size_t i) {
        handed_over.load(std::memory_order_acquire);
        work(i);
        handed_over.fetch_add(1, std::memory_order_release);
    };
    handed_over.store(0, std::memory_order_release);
    oneapi::tbb::parallel_for(std::size_t{0}, count, watched, own);
    handed_over.load(std::memory_order_acquire);
}

}  // namespace lamella
