// Distributes the load cases of a structural optimisation over several processes.
#pragma once

#include "app/ranks/ranks.h"
#include "engine/base/cancel_token.h"
#include "procedural/optimization/shared_solves.h"

namespace lamella {

/// The cases go round the ranks, in their order. Used by all of them.
class DistributedCases : public SharedSolves {
  public:
    /// `ranks` must outlive this; `cancel` may be null.
    DistributedCases(Ranks& ranks, const CancelToken* cancel) : ranks_(ranks), cancel_(cancel) {}

    bool is_solved_here(std::size_t load_case) const override {
        return solver_of(load_case) == ranks_.rank();
    }
    void give(const SolvedCase& solved) override;
    SolvedCase take(std::size_t load_case, std::uint64_t problem) override;

  private:
    int solver_of(std::size_t load_case) const {
        return static_cast<int>(load_case % static_cast<std::size_t>(ranks_.size()));
    }

    Ranks& ranks_;
    const CancelToken* cancel_;
};

}  // namespace lamella
