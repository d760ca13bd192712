// What a print check found, as text, as JSON and as a sentence.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/reports/check_limits.h"
#include "engine/layers/layer.h"

namespace lamella {

/// What was checked, and what was found.
struct CheckOutcome {
    std::string part;     ///< its name
    std::string machine;  ///< the profile's name
    CheckPlan plan;
    CheckReport report;
};

/// A line for each check (limit, outcome, how much was found), then the worst places of those that found
/// something, and notes.
std::string check_text(const CheckOutcome& outcome);

/// All of the report; sizes with their units in the keys.
nlohmann::ordered_json check_json(const CheckOutcome& outcome, const Job& job);

/// "koala cannot be printed as it is on marlin: thickness (3 places), islands (1 place)": what the process
/// fails for.
std::string failure_text(const CheckOutcome& outcome);

/// "2 of 9 checks fail, 1 warns" or "all 9 checks pass".
std::string verdict_text(const CheckReport& report);

/// "3 places", "1 place".
std::string places_text(std::size_t count);

/// "sheets, cups": what was not looked for; empty when nothing was left out.
std::string left_out(const CheckReport& report);

}  // namespace lamella
