// Rank 0 leads, the others work for it.
#include "app/ranks/run_on_ranks.h"

#include "app/console/error_report.h"
#include "app/ranks/rank_failure.h"
#include "engine/base/error.h"

namespace lamella {

void run_on_ranks(const LeadRanks& lead, const HelpRank& run_worker) {
    const std::unique_ptr<Ranks> ranks = started_ranks();
    std::string violated;
    if (!ranks) {
        violated = lead(nullptr);
    } else if (ranks->rank() > 0) {
        try {
            tell_failures(*ranks, [&] { run_worker(*ranks); });
        } catch (const Interrupted&) {
            return;  // rank 0 reports the interruption
        }
    } else {
        try {
            violated = lead(ranks.get());
        } catch (...) {
            ranks->abort(report_exception());
        }
    }
    if (!violated.empty()) throw ConstraintError(violated);
}

}  // namespace lamella
