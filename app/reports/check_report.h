// The result of a print check as text, as JSON and as a sentence.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/reports/check_limits.h"
#include "engine/layers/layer.h"

namespace lamella {

/// A print check and its result.
struct CheckOutcome {
    std::string part;     ///< its name
    std::string machine;  ///< the profile's name
    CheckPlan plan;
    CheckReport report;
};

/// Returns a line for each check (limit, outcome, findings), then the worst places of those with findings,
/// and notes.
std::string check_text(const CheckOutcome& outcome);

/// Returns the whole report; keys of sizes contain their units.
nlohmann::ordered_json check_json(const CheckOutcome& outcome, const Job& job);

/// Returns why the check fails: "koala cannot be printed as it is on marlin: thickness (3 places), islands (1
/// place)".
std::string failure_text(const CheckOutcome& outcome);

/// Returns "2 of 9 checks fail, 1 warns" or "all 9 checks pass".
std::string verdict_text(const CheckReport& report);

/// Returns "3 places" or "1 place".
std::string places_text(std::size_t count);

/// Returns the checks that were not made, "sheets, cups"; empty when all were.
std::string left_out(const CheckReport& report);

}  // namespace lamella
