// A table of numbers along another grading: along z, a depth, a distance, a formula.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/grading.h"

namespace lamella {

/// Rows of (position, number).
using Table = std::vector<std::pair<double, double>>;

/// The number that the table gives at the position `along` has: straight between rows, or smooth (the
/// monotone cubic of Fritsch and Carlson 1980, which never leaves the span of its two rows), constant beyond
/// the ends. Throws InputError for an empty table, for numbers beyond 1e100 and for positions that do not
/// increase strictly.
GradingPtr make_table_grading(GradingPtr along, Table rows, bool smooth);

/// Reads two numbers a line, parted by a comma, semicolon or white space; empty lines and what follows a # do
/// not count, and one line of words may head the table. Throws InputError("path:line: what").
Table read_table(const std::string& path);

/// The same for text at hand; `name` stands in messages.
Table read_table(std::string_view text, const std::string& name);

}  // namespace lamella
