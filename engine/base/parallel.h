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

/// Shows race detectors that what the waiting thread did happened before the work that it hands to others,
/// and their work before it goes on. They do not see the synchronisation inside TBB's library.
class HandOver {
  public:
    HandOver() { give(); }
    ~HandOver() { take(); }
    HandOver(const HandOver&) = delete;
    HandOver& operator=(const HandOver&) = delete;

    /// Lives as long as a piece of the work.
    class Turn {
      public:
        explicit Turn(HandOver& hand_over) : hand_over_(hand_over) { hand_over_.take(); }
        ~Turn() { hand_over_.give(); }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

      private:
        HandOver& hand_over_;
    };

  private:
    void give() { count_.fetch_add(1, std::memory_order_release); }
    void take() { count_.load(std::memory_order_acquire); }

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
        HandOver hand_over;
        return arena_.execute([&] {
            const HandOver::Turn turn(hand_over);
            return work();
        });
    }

  private:
    oneapi::tbb::task_arena arena_;
};

/// Calls work(i) for each i in [0, count), in parallel. An exception of one call is thrown once the calls
/// that have begun end; others may never begin.
template <typename Index, typename Work>
void parallel_for(Index count, const Work& work) {
    HandOver hand_over;
    oneapi::tbb::parallel_for(Index{0}, count, [&](Index i) {
        const HandOver::Turn turn(hand_over);
        work(i);
    });
}

/// Calls work(i) for each i in [0, count), in parallel. Runs all of them even when the enclosing stream is
/// being cancelled, so that no layer is left half done.
template <typename Work>
void isolated_parallel_for(std::size_t count, const Work& work) {
    oneapi::tbb::task_group_context own(oneapi::tbb::task_group_context::isolated);
    HandOver hand_over;
    const auto in_turn = [&](std::size_t i) {
        const HandOver::Turn turn(hand_over);
        work(i);
    };
    oneapi::tbb::parallel_for(std::size_t{0}, count, in_turn, own);
}

}  // namespace lamella
