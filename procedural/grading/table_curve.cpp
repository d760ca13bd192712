// Linear and monotone cubic interpolation between rows.
#include "procedural/grading/table_curve.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"

namespace lamella {
namespace {

void check(const Table& rows) {
    if (rows.empty()) throw InputError("a table needs at least one row (position, number)");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string row = "row " + std::to_string(i + 1) + " of a table";
        if (!(std::abs(rows[i].first) <= max_table_number && std::abs(rows[i].second) <= max_table_number)) {
            throw InputError(row + ": both numbers must be finite and at most 1e100");
        }
        if (i > 0 && !(rows[i - 1].first < rows[i].first)) {
            throw InputError(row + ": positions must increase from row to row");
        }
    }
}

/// Returns slopes at the rows that keep every piece monotone: zero at local extremes, else the weighted
/// harmonic mean of the slopes on both sides (Fritsch and Butland 1984); at the ends a three-point slope,
/// limited.
std::vector<double> monotone_slopes(const Table& rows) {
    const std::size_t n = rows.size();
    std::vector<double> slopes(n, 0.0), widths, chords;
    if (n < 2) return slopes;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        widths.push_back(rows[i + 1].first - rows[i].first);
        chords.push_back((rows[i + 1].second - rows[i].second) / widths[i]);
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = chords[i - 1], after = chords[i];
        if (!(before > 0 && after > 0) && !(before < 0 && after < 0)) continue;
        const double share = (widths[i - 1] + 2 * widths[i]) / (3 * (widths[i - 1] + widths[i]));
        slopes[i] = 1 / (share / before + (1 - share) / after);
    }
    const auto end_slope = [](double width, double next_width, double chord, double next_chord) {
        const double slope = chord + (chord - next_chord) * (width / (width + next_width));
        if (!(slope > 0 && chord > 0) && !(slope < 0 && chord < 0)) return 0.0;
        return std::abs(slope) > 3 * std::abs(chord) ? 3 * chord : slope;
    };
    if (n == 2) {
        slopes[0] = slopes[1] = chords[0];
    } else {
        slopes[0] = end_slope(widths[0], widths[1], chords[0], chords[1]);
        slopes[n - 1] = end_slope(widths[n - 2], widths[n - 3], chords[n - 2], chords[n - 3]);
    }
    return slopes;
}

}  // namespace

TableCurve::TableCurve(Table rows, bool smooth) : rows_(std::move(rows)), smooth_(smooth) {
    check(rows_);
    if (smooth_) slopes_ = monotone_slopes(rows_);
}

Interval TableCurve::range(Interval along) const {
    const double first = at(along.lo), last = at(along.hi);
    Interval range{std::min(first, last), std::max(first, last)};
    Interval pieces = range;  // cannot be left by rounding within the pieces at both ends
    for (std::size_t i = behind(along.lo); i < rows_.size() && rows_[i].first <= along.hi; ++i) {
        range = {std::min(range.lo, rows_[i].second), std::max(range.hi, rows_[i].second)};
    }
    if (smooth_) {
        for (const double end : {along.lo, along.hi}) include_piece(pieces, end);
        const double slack = 1e-14 * std::max(std::abs(pieces.lo), std::abs(pieces.hi));
        pieces = {std::min(pieces.lo, range.lo), std::max(pieces.hi, range.hi)};
        range = {std::max(range.lo - slack, pieces.lo), std::min(range.hi + slack, pieces.hi)};
    }
    return range;
}

/// Returns the index of the first row beyond a position.
std::size_t TableCurve::behind(double position) const {
    const auto beyond = [](double x, const std::pair<double, double>& row) { return x < row.first; };
    return static_cast<std::size_t>(std::upper_bound(rows_.begin(), rows_.end(), position, beyond) -
                                    rows_.begin());
}

void TableCurve::include_piece(Interval& range, double position) const {
    const std::size_t i = behind(position);
    for (std::size_t k = i > 0 ? i - 1 : 0; k <= i && k < rows_.size(); ++k) {
        range = {std::min(range.lo, rows_[k].second), std::max(range.hi, rows_[k].second)};
    }
}

double TableCurve::at(double position) const {
    if (std::isnan(position)) return position;
    const std::size_t i = behind(position);
    if (i == 0) return rows_.front().second;
    if (i == rows_.size()) return rows_.back().second;
    const auto [x0, y0] = rows_[i - 1];
    const auto [x1, y1] = rows_[i];
    const double width = x1 - x0, t = (position - x0) / width;
    double y = y0 + (y1 - y0) * t;
    if (smooth_) {
        // Hermite's cubic as the chord plus the deviation due to the slopes at both ends.
        const double chord = y1 - y0, s = 1 - t;
        y += t * s * ((slopes_[i - 1] * width - chord) * s - (slopes_[i] * width - chord) * t);
    }
    const Interval between{std::min(y0, y1), std::max(y0, y1)};
    return y > between.hi ? between.hi : y >= between.lo ? y : between.lo;
}

}  // namespace lamella
