// Distributes the solves of a foam's stiffness over several processes.
#pragma once

#include <functional>
#include <vector>

#include "app/ranks/distribute_tasks.h"
#include "recipe/structure/foam_stiffness.h"

namespace lamella {

/// Used by rank 0 or a single process: runs solves on demand; other ranks do some of them.
class DistributedSolves {
  public:
    /// `recipe` and `solves` must outlive this. `ranks`: null for a single process.
    DistributedSolves(Ranks* ranks, const Recipe& recipe, const std::vector<StiffnessSolve>& solves,
                      const StiffnessOptions& options);

    /// Returns the results of the next `count` solves, in their order; at least `count` must be left. `show`
    /// receives the finished share of their work, 0 to 1. Throws what solve_sample throws, and failures of
    /// other ranks.
    std::vector<SolvedSample> next(std::size_t count, const std::function<void(double share)>& show);
    /// To be called after the last result: releases the other ranks.
    void finish() { tasks_.finish(); }

  private:
    void tell_progress();

    const std::vector<StiffnessSolve>& solves_;
    std::size_t from_ = 0, to_ = 0;  ///< range of the requested solves
    std::size_t own_ = 0;            ///< the solve that this process works on
    double own_share_ = 0;           ///< its finished share
    std::function<void(double share)> show_;
    DistributedTasks tasks_;
};

/// The work of the other ranks.
void help_with_solves(Ranks& ranks, const Recipe& recipe, const std::vector<StiffnessSolve>& solves,
                      const StiffnessOptions& options);

}  // namespace lamella
