// Rows one after another.
#include "engine/morphology/ball_rows.h"

#include <algorithm>

namespace lamella {

BallRows::BallRows(const SpanRows& rows, double radius) : BallRows() {
    runs_.reserve(rows.runs().size());
    lines_of_runs_.reserve(rows.runs().size());
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        for (const Run& run : rows.line(l)) runs_.push_back({run.begin, run.end, radius * radius});
        end_line();
    }
    most_weight_ = radius * radius;
}

void BallRows::end_line() {
    lines_of_runs_.resize(runs_.size(), static_cast<std::int32_t>(lines()));
    starts_.push_back(runs_.size());
}

void BallRows::append_line(std::span<const BallRun> runs) {
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    end_line();
    for (const BallRun& run : runs) most_weight_ = std::max(most_weight_, run.weight);
}

}  // namespace lamella
