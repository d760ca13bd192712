// WeightedRows: rows stored one after another.
#include "engine/morphology/weighted_rows.h"

#include <algorithm>

namespace lamella {

WeightedRows::WeightedRows(const RunRows& rows, double radius) : WeightedRows() {
    runs_.reserve(rows.runs().size());
    lines_of_runs_.reserve(rows.runs().size());
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        for (const Run& run : rows.line(l)) runs_.push_back({run.begin, run.end, radius * radius});
        end_line();
    }
    max_weight_ = radius * radius;
}

void WeightedRows::end_line() {
    lines_of_runs_.resize(runs_.size(), static_cast<std::int32_t>(lines()));
    starts_.push_back(runs_.size());
}

void WeightedRows::append_line(std::span<const WeightedRun> runs) {
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    end_line();
    for (const WeightedRun& run : runs) max_weight_ = std::max(max_weight_, run.weight);
}

}  // namespace lamella
