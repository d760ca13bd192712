// A table of numbers along another grading: along z, a depth, a distance, a formula.
#pragma once

#include <string>
#include <string_view>
#include "engine/field/grading.h"
#include "procedural/grading/table_curve.h"

namespace lamella {

/// The number that the table gives at the position `along` has; see TableCurve, and for what is thrown.
GradingPtr make_table_grading(GradingPtr along, Table rows, bool smooth);

/// Reads two numbers a line, parted by a comma, semicolon or white space; empty lines and what follows a # do
/// not count, and one line of words may head the table. Throws InputError("path:line: what").
Table read_table(const std::string& path);

/// The same for text at hand; `name` stands in messages.
Table read_table(std::string_view text, const std::string& name);

}  // namespace lamella
