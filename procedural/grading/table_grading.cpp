// Table lookups along other gradings, and tables read from text.
#include "procedural/grading/table_grading.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/base/whole_file.h"
#include "procedural/grading/table_curve.h"
#include "procedural/grading/text_rows.h"

namespace lamella {
namespace {

class TableGrading : public Grading {
  public:
    TableGrading(GradingPtr along, Table rows, bool smooth)
        : along_(std::move(along)), curve_(std::move(rows), smooth) {}

    double at(dvec3 p) const override { return curve_.at(along_->at(p)); }
    void numbers(std::span<const dvec3> points, std::span<double> out) const override {
        lamella::numbers_of(*along_, points, out, [&](double along) { return curve_.at(along); });
    }

    Interval range(const Box& box) const override {
        const Interval along = along_->range(box);
        Interval range = curve_.range(along);
        if (along.hi == infinity) range.hi = infinity;  // the value may be NaN there
        return range;
    }

  private:
    GradingPtr along_;
    TableCurve curve_;
};

/// Returns the row given by the cells of a line. `where` is "path:line: ".
std::pair<double, double> row_of(const std::vector<std::string_view>& cells, const std::string& where) {
    const std::vector<double> numbers = numbers_of(cells, where);
    if (numbers.size() != 2) {
        throw InputError(where + "a row needs two numbers, position and number; here " +
                         (numbers.size() == 1 ? "is " : "are ") + std::to_string(numbers.size()));
    }
    if (!(std::abs(numbers[0]) <= max_table_number && std::abs(numbers[1]) <= max_table_number)) {
        throw InputError(where + "both numbers must be finite and at most 1e100");
    }
    return {numbers[0], numbers[1]};
}

}  // namespace

GradingPtr make_table_grading(GradingPtr along, Table rows, bool smooth) {
    return std::make_shared<TableGrading>(std::move(along), std::move(rows), smooth);
}

Table read_table(std::string_view text, const std::string& name) {
    Table rows;
    bool headed = false;
    for (const TextRow& line : text_rows(text)) {
        const std::vector<std::string_view>& cells = line.cells;
        const auto is_word = [](std::string_view cell) { return !parse_double(cell); };
        if (rows.empty() && !headed && std::all_of(cells.begin(), cells.end(), is_word)) {
            headed = true;
            continue;
        }
        std::string where = name;
        where += ":" + std::to_string(line.number) + ": ";
        const auto row = row_of(cells, where);
        if (!rows.empty() && !(rows.back().first < row.first)) {
            throw InputError(
                where +
                "positions must increase from row to row, and this one does not exceed the one before");
        }
        rows.push_back(row);
    }
    if (rows.empty()) throw InputError(name + ": the table holds no rows (two numbers a line)");
    return rows;
}

Table read_table(const std::string& path) {
    return read_table(whole_file(path, "a table (two numbers a line)"), path);
}

}  // namespace lamella
