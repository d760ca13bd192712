// TableCurve: a function of one variable, interpolated between the rows of a table.
#pragma once

#include <utility>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Maximum magnitude of a number in a table.
inline constexpr double max_table_number = 1e100;

/// Rows of (position, number).
using Table = std::vector<std::pair<double, double>>;

/// A piecewise linear or smooth interpolation of a table: smooth is the monotone cubic of Fritsch and Carlson
/// 1980, which never leaves the range of its two rows. Constant beyond the ends.
class TableCurve {
  public:
    /// Throws InputError for an empty table, for numbers beyond 1e100, and for positions that are not
    /// strictly increasing.
    TableCurve(Table rows, bool smooth);

    /// Returns the interpolated number; NaN at NaN.
    double at(double position) const;
    /// Returns bounds of the numbers over an interval of positions.
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
