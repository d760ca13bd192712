// A foam's solves over several processes.
#pragma once

#include <functional>
#include <vector>

#include "app/ranks/distribute_tasks.h"
#include "recipe/build/foam_stiffness.h"

namespace lamella {

/// Of rank 0, or of a process on its own: solves as they are wanted, some of them done by other ranks.
class DistributedSolves {
  public:
    /// `recipe` and `solves` outlive this. `ranks`: null for this process alone.
    DistributedSolves(Ranks* ranks, const Recipe& recipe, const std::vector<StiffnessSolve>& solves,
                      const StiffnessOptions& options);

    /// The results of the next solves, of which there are `count` at least, in their order. `show` is told
    /// how much of their work is done, 0 to 1. Throws what solve_sample throws, and what another rank has
    /// failed with.
    std::vector<SolvedSample> next(std::size_t count, const std::function<void(double share)>& show);
    /// After the last result: lets the other ranks go.
    void finish() { tasks_.finish(); }

  private:
    void tell_progress();

    const std::vector<StiffnessSolve>& solves_;
    std::size_t from_ = 0, to_ = 0;  ///< solves that are wanted now
    std::size_t own_ = 0;            ///< that this process is at
    double own_share_ = 0;           ///< of it that is done
    std::function<void(double share)> show_;
    DistributedTasks tasks_;
};

/// What the other ranks do.
void help_with_solves(Ranks& ranks, const Recipe& recipe, const std::vector<StiffnessSolve>& solves,
                      const StiffnessOptions& options);

}  // namespace lamella
