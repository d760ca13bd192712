// A number along another one, by rows of a table.
#pragma once

#include <utility>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// The largest magnitude of a number in a table.
inline constexpr double max_table_number = 1e100;

/// Rows of (position, number).
using Table = std::vector<std::pair<double, double>>;

/// A table of numbers with what lies between its rows: straight pieces, or smooth ones (the monotone cubic of
/// Fritsch and Carlson 1980, which never leaves the span of its two rows); constant beyond the ends.
class TableCurve {
  public:
    /// Throws InputError for an empty table, for numbers beyond 1e100 and for positions that do not increase
    /// strictly.
    TableCurve(Table rows, bool smooth);

    /// NaN at NaN.
    double at(double position) const;
    /// Encloses the numbers at all positions of an interval.
    Interval range(Interval along) const;
    const Table& rows() const { return rows_; }

  private:
    std::size_t behind(double position) const;
    void include_piece(Interval& range, double position) const;

    Table rows_;
    bool smooth_;
    std::vector<double> slopes_;
};

}  // namespace lamella
