// What checks look for, in words for people.
#pragma once

#include <string>

#include "engine/checks/print_check.h"
#include "printers/common/check_profile.h"

namespace lamella {

/// "resin".
std::string process_name(Process process);

/// "build_volume": its key in [check] and in JSON.
std::string check_name(Check check);

/// "a wall or strut is too thin": what is wrong where it finds something.
std::string check_fault(Check check);

/// What can be done about it, a sentence.
std::string check_advice(Check check);

/// "at least 0.4 mm, 0.8 mm upright": what is looked for, with its numbers.
std::string check_limit(Check check, const PrintLimits& limits);

/// "mm", "mm2" or "mm3": of its faults' sizes.
const char* size_unit(Check check);

/// "12.3 mm2".
std::string size_text(Check check, double size);

/// "pass", "warn" or "FAIL".
const char* outcome_word(const CheckResult& result);

/// "layer 12" or "layers 12 to 20", the last included.
std::string layers_text(const Fault& fault);

/// "(12.3, 4.5, 6.05) mm".
std::string place_text(dvec3 at);

}  // namespace lamella
