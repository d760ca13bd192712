// Rows one after another.
#include "engine/ball_rows.h"

#include <algorithm>

namespace lamella {

BallRows::BallRows(const SpanRows& rows, double radius) : BallRows() {
    runs_.reserve(rows.runs().size());
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        for (const Run& run : rows.line(l)) runs_.push_back({run.begin, run.end, radius * radius});
        starts_.push_back(runs_.size());
    }
    most_weight_ = radius * radius;
}

void BallRows::append_line(std::span<const BallRun> runs) {
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    starts_.push_back(runs_.size());
    for (const BallRun& run : runs) most_weight_ = std::max(most_weight_, run.weight);
}

}  // namespace lamella
