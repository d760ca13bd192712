// CutNotes: counts the warnings that arise while cuts are planned.
#pragma once

#include <string>
#include <vector>

#include "printers/vector/cut_plan.h"

namespace lamella {

/// Counts the layers with peculiarities that a user should know.
class CutNotes {
  public:
    /// Counts a layer. Throws ConstraintError for a layer of several pieces if the profile refuses those.
    void count(int layer, const CutPlan& plan, const CuttingProfile& profile);
    /// Returns the warnings, one sentence each.
    std::vector<std::string> texts(const CuttingProfile& profile) const;

  private:
    /// Number of layers with a peculiarity, and the first of them.
    struct Tally {
        int layers = 0;
        int first = 0;
        int sum = 0;

        void count(int layer, int times);
        std::string where() const;
    };

    Tally loose_, holes_, merged_, unnumbered_;
    int first_loose_ = 0;
};

}  // namespace lamella
