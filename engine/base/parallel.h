// Parallel loops and the number of threads that run them. Only the stream of layers, a pipeline, uses TBB
// directly.
//
//     ThreadArena arena(options.threads);
//     arena.execute([&] { parallel_for(planes, [&](int z) { sample_plane(z); }); });
#pragma once

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cstddef>

namespace lamella {

/// Returns the number of threads to use: the requested one, or one per core of the machine when that is 0.
inline int thread_count(int requested) {
    return requested > 0 ? requested : oneapi::tbb::info::default_concurrency();
}

/// Threads that the loops inside execute() run on.
class ThreadArena {
  public:
    /// Allows the requested number of threads; 0 means one per core.
    explicit ThreadArena(int requested) : arena_(thread_count(requested)) {}

    /// Calls work() and returns its result.
    template <typename Work>
    auto execute(const Work& work) {
        return arena_.execute(work);
    }

  private:
    oneapi::tbb::task_arena arena_;
};

/// Calls work(i) for each i in [0, count), in parallel. An exception of one call is thrown once the calls
/// that have begun end; others may never begin.
template <typename Index, typename Work>
void parallel_for(Index count, const Work& work) {
    oneapi::tbb::parallel_for(Index{0}, count, work);
}

/// Calls work(i) for each i in [0, count), in parallel. Runs all of them even when the enclosing stream is
/// being cancelled, so that no layer is left half done.
template <typename Work>
void isolated_parallel_for(std::size_t count, const Work& work) {
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
