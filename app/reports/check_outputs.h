// Checks as back-ends: alone, or beside the outputs of a run, on the same layers.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/reports/check_report.h"
#include "recipe/output/outputs.h"

namespace lamella {

/// A check for each of some machines. Outlives the back-ends that it gives out.
class OutputChecks {
  public:
    /// A back-end that checks the layers of `part` for a machine. `parts`: see plan_check. Throws InputError
    /// where the limits make no sense for the job.
    std::unique_ptr<Backend> check_of(const PrinterProfile& machine, const std::string& part, const Job& job,
                                      int parts);

    /// The back-end with a check for the machine of each output beside it, which see every layer, also those
    /// that a continued output has already.
    std::unique_ptr<Backend> beside(std::unique_ptr<Backend> outputs, const std::vector<Output>& machines,
                                    const std::string& part, const Job& job, int parts);

    /// After the layers have gone through, in the order of asking; empty without checks.
    std::vector<CheckOutcome> outcomes() const;

  private:
    std::vector<CheckOutcome> planned_;
    std::vector<std::shared_ptr<PrintCheck>> checks_;
};

}  // namespace lamella
