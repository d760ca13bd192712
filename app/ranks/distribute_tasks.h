// Work in pieces that do not need each other, over several processes: whoever is free does the next one.
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

/// Does a task, and returns what came of it as bytes. Every rank does the same of the same task.
using DoTask = std::function<std::string(std::size_t task)>;

/// The tasks as rank 0 has them done, or a process on its own.
class DistributedTasks {
  public:
    /// `ranks`: null for this process alone. `identity` tells this work from other work: ranks that have been
    /// given another refuse to help. Tasks are numbered from 0.
    DistributedTasks(Ranks* ranks, std::size_t count, std::string identity, DoTask task,
                     const CancelToken* cancel);

    /// What came of a task. Until that is known tasks are done here, those with low numbers first. Throws
    /// what a task throws, Interrupted when cancelled, and what another rank has failed with.
    const std::string& result(std::size_t task);
    /// Whether the result is there. What others have done counts once it has been collected.
    bool is_done(std::size_t task) const { return results_[task].has_value(); }
    /// Takes in what others have done; long tasks call it now and then. Throws what another rank has failed
    /// with.
    void collect();
    /// After the last result: waits until the others know that nothing is left.
    void finish();

  private:
    void hand_out(const std::stop_token& stop);

    Ranks* ranks_;
    std::string identity_;
    DoTask task_;
    const CancelToken* cancel_;
    std::vector<std::optional<std::string>> results_;
    std::atomic<std::size_t> next_{0};  ///< task that nobody has begun
    std::atomic<int> sent_home_{0};     ///< ranks that know that nothing is left
    std::jthread desk_;                 ///< where ranks ask, also while a task is done here
};

/// What the other ranks do: tasks as they are given them, until none is left. Throws what a task throws, and
/// InputError where rank 0 is at other work.
void help_with_tasks(Ranks& ranks, const std::string& identity, const DoTask& task,
                     const CancelToken* cancel);

}  // namespace lamella
