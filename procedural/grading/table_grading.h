// A grading that is a tabulated function of another one, such as z, a depth, a distance or a formula.
#pragma once

#include <string>
#include <string_view>
#include "engine/field/grading.h"
#include "procedural/grading/table_curve.h"

namespace lamella {

/// Makes the grading that looks up the value of `along` in a table; see TableCurve, also for errors.
GradingPtr make_table_grading(GradingPtr along, Table rows, bool smooth);

/// Reads a table with two numbers per line, separated by a comma, semicolon or white space. Ignores empty
/// lines and everything after a #; the first line may be a heading. Throws InputError("path:line: what").
Table read_table(const std::string& path);

/// Reads a table from text; `name` is used in messages.
Table read_table(std::string_view text, const std::string& name);

}  // namespace lamella
