// Distributes the load cases of a structural optimisation over several processes.
#pragma once

#include <algorithm>

#include "app/ranks/ranks.h"
#include "engine/base/cancel_token.h"
#include "procedural/optimization/shared_solves.h"

namespace lamella {

/// The cases go round the ranks, in their order; ranks beyond the number of cases have no part in the search.
/// Used by all that have.
class DistributedCases : public SharedSolves {
  public:
    /// `ranks` must outlive this; `cancel` may be null.
    DistributedCases(Ranks& ranks, std::size_t cases, const CancelToken* cancel)
        : ranks_(ranks),
          searching_(static_cast<int>(std::min(static_cast<std::size_t>(ranks.size()), cases))),
          cancel_(cancel) {}

    /// Whether this process makes the search.
    bool is_needed() const { return ranks_.rank() < searching_; }

    bool is_solved_here(std::size_t load_case) const override {
        return solver_of(load_case) == ranks_.rank();
    }
    void give(const SolvedCase& solved) override;
    SolvedCase take(std::size_t load_case, std::uint64_t problem) override;

  private:
    int solver_of(std::size_t load_case) const {
        return static_cast<int>(load_case % static_cast<std::size_t>(searching_));
    }

    Ranks& ranks_;
    int searching_;  ///< number of ranks that make the search
    const CancelToken* cancel_;
};

}  // namespace lamella
