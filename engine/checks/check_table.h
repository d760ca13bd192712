// The table of checks: one row a kind of fault, and one a class that finds some.
#pragma once

#include <memory>
#include <span>

#include "engine/checks/layer_check.h"
#include "engine/checks/print_limits.h"

namespace lamella {

/// A kind of fault.
struct CheckInfo {
    const char* name;                       ///< its key in settings and reports
    const char* unit;                       ///< of the size of a fault: "mm", "mm2", "mm3" or "times"
    double PrintLimits::*limit = nullptr;   ///< what sizes or thicknesses are compared with; null: nothing
    const char* limit_unit = "";            ///< "mm", "mm3" or "times"
    const char* thickness_limit = nullptr;  ///< the limit's name, if it is a thickness that rows must resolve
    bool adds_up = true;                    ///< whether the sum of fault sizes means anything
};

/// Returns the row of a check.
const CheckInfo& check_info(Check check);

/// What a check is made for.
struct CheckContext {
    CheckGrid grid;
    PrintLimits limits;
    std::size_t max_faults = 10;  ///< of each kind that are kept
};

/// A class that finds faults of some kinds, and the labels of a LayerSample that it reads.
struct CheckPass {
    std::span<const Check> finds;
    std::unique_ptr<LayerCheck> (*make)(const CheckContext& context);
    bool reads_part_labels = false;
    bool reads_printed_labels = false;
};

/// A pass of the table, and the check that it made.
struct ActiveCheck {
    const CheckPass* pass;
    std::unique_ptr<LayerCheck> check;
};

/// Returns all passes, in the order in which they are given a layer. Checks that move out of the layer come
/// last.
std::span<const CheckPass> check_passes();

}  // namespace lamella
