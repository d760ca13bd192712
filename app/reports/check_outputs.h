// Print checks as back-ends: alone, or on the layers of a run in parallel with its outputs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/reports/check_report.h"
#include "recipe/output/outputs.h"

namespace lamella {

/// The checks of several machines. Must outlive the back-ends that it returns.
class OutputChecks {
  public:
    /// Returns a back-end that checks the layers of `part` for a machine. `parts` as in plan_check. Throws
    /// InputError when the limits do not suit the job.
    std::unique_ptr<Backend> check_of(const PrinterProfile& machine, const std::string& part, const Job& job,
                                      int parts);

    /// Returns `outputs` combined with a check for the machine of each output. The checks see every layer,
    /// including those that a resumed output already has.
    std::unique_ptr<Backend> beside(std::unique_ptr<Backend> outputs, const std::vector<Output>& machines,
                                    const std::string& part, const Job& job, int parts);

    /// Returns the outcomes after the last layer, in the order of the calls above; empty without checks.
    std::vector<CheckOutcome> outcomes() const;

  private:
    std::vector<CheckOutcome> planned_;
    std::vector<std::shared_ptr<PrintCheck>> checks_;
};

}  // namespace lamella
