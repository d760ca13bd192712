// Checks that run beside the back-ends of a run, on the same layers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/check_report.h"
#include "recipe/outputs.h"

namespace lamella {

/// A check for the machine of each output. Outlives the back-end that it gives out.
class OutputChecks {
  public:
    /// The back-end with the checks beside it, which see every layer, also those that a continued output has
    /// already. `parts`: see plan_check. Throws InputError where the limits make no sense for the job.
    std::unique_ptr<Backend> beside(std::unique_ptr<Backend> outputs, const std::vector<Output>& machines,
                                    const std::string& part, const Job& job, int parts);

    /// After the layers have gone through, by output; empty without checks.
    std::vector<CheckOutcome> outcomes() const;

  private:
    std::vector<CheckOutcome> planned_;
    std::vector<std::shared_ptr<PrintCheck>> checks_;
};

}  // namespace lamella
