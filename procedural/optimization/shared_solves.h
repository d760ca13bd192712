// SharedSolves: load cases of one search that several processes solve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lamella {

/// What a process found for a load case.
struct SolvedCase {
    std::uint64_t problem = 0;                         ///< hash of the moduli that were analysed
    int iterations = 0;                                ///< of the solver
    std::vector<std::vector<double>> displacements{};  ///< by direction, then node
};

/// The other processes of a run. All make the same search, each solves some of the load cases, and gives the
/// others what it found: so all go on with the same design.
class SharedSolves {
  public:
    SharedSolves() = default;
    virtual ~SharedSolves() = default;
    SharedSolves(const SharedSolves&) = delete;
    SharedSolves& operator=(const SharedSolves&) = delete;

    /// Whether this process solves the case, which exactly one does.
    virtual bool is_solved_here(std::size_t load_case) const = 0;
    /// Gives a case that was solved here to all others.
    virtual void give(const SolvedCase& solved) = 0;
    /// Waits for a case that another process solves. Throws FaultError if it failed or analyses another
    /// problem than `problem`, Interrupted once cancelled.
    virtual SolvedCase take(std::size_t load_case, std::uint64_t problem) = 0;
};

}  // namespace lamella
