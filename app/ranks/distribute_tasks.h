// Distributes independent tasks over several processes: a free rank does the next task.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/ranks/ranks.h"
#include "engine/base/cancel_token.h"

namespace lamella {

/// Does a task, and returns its result as bytes. Must give the same result on every rank.
using DoTask = std::function<std::string(std::size_t task)>;

/// The tasks, as seen by rank 0 or a single process.
class DistributedTasks {
  public:
    /// `ranks`: null for a single process. `identity` distinguishes this work from other work: ranks with
    /// another identity refuse to help. Tasks are numbered from 0.
    DistributedTasks(Ranks* ranks, std::size_t count, std::string identity, DoTask task,
                     const CancelToken* cancel);

    /// Returns the result of a task. Until it is available, does tasks here, those with low numbers first.
    /// Throws what a task throws, Interrupted when cancelled, and failures of other ranks.
    const std::string& result(std::size_t task);
    /// Returns true if the result is available. Results of other ranks count after they have been collected.
    bool is_done(std::size_t task) const { return results_[task].has_value(); }
    /// Receives results of other ranks; long tasks should call it now and then. Throws failures of other
    /// ranks.
    void collect();
    /// To be called after the last result: waits until the other ranks know that no task is left.
    void finish();

  private:
    void hand_out(const std::stop_token& stop);

    Ranks* ranks_;
    std::string identity_;
    DoTask task_;
    const CancelToken* cancel_;
    std::vector<std::optional<std::string>> results_;
    std::atomic<std::size_t> next_{0};  ///< next task that no rank has begun
    std::atomic<int> sent_home_{0};     ///< ranks that know that no task is left
    std::jthread desk_;                 ///< answers other ranks, also while this process does a task
};

/// The work of the other ranks: does tasks as rank 0 assigns them, until none is left. Throws what a task
/// throws, and InputError when rank 0 does other work.
void help_with_tasks(Ranks& ranks, const std::string& identity, const DoTask& task,
                     const CancelToken* cancel);

}  // namespace lamella
