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

/// Shows race detectors that one thread's work happened before another's. They do not see the synchronisation
/// inside TBB's library.
class HandOver {
  public:
    void give() { count_.fetch_add(1, std::memory_order_release); }
    void take() { count_.load(std::memory_order_acquire); }
    /// Returns the work between a hand-over from the thread that waits for it and one back.
    template <typename Work>
    auto around(const Work& work) {
        return [&](auto... arguments) {
            const Turn turn(*this);
            work(arguments...);
        };
    }

  private:
    /// Also gives back when the work throws.
    struct Turn {
        explicit Turn(HandOver& over) : hand_over(over) { hand_over.take(); }
        ~Turn() { hand_over.give(); }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        HandOver& hand_over;
    };

    std::atomic<std::size_t> count_{0};
};

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
    HandOver hand_over;
    hand_over.give();
    try {
        oneapi::tbb::parallel_for(Index{0}, count, hand_over.around(work));
    } catch (...) {
        hand_over.take();
        throw;
    }
    hand_over.take();
}

/// Calls work(i) for each i in [0, count), in parallel. Runs all of them even when the enclosing stream is
/// being cancelled, so that no layer is left half done.
template <typename Work>
void isolated_parallel_for(std::size_t count, const Work& work) {
    oneapi::tbb::task_group_context own(oneapi::tbb::task_group_context::isolated);
    HandOver hand_over;
    hand_over.give();
    oneapi::tbb::parallel_for(std::size_t{0}, count, hand_over.around(work), own);
    hand_over.take();
}

}  // namespace lamella
