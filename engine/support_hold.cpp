// Supports and their upper ends as balls, grown within the next layer.
#include "engine/support_hold.h"

#include <algorithm>
#include <cmath>

#include "engine/layer_offset.h"
#include "engine/row_sets.h"

namespace lamella {

SupportHold::SupportHold(const CheckGrid& grid, double spacing, double gap)
    : grid_(grid),
      spacing_(spacing),
      gap_(gap),
      layers_(static_cast<std::size_t>((spacing + gap) / grid.layer_height)) {
    last_ = empty_rows(static_cast<std::size_t>(grid.band.count));
}

SpanRows SupportHold::held() const {
    const double unit = grid_.band.along_pitch / run_unit;
    BallRows balls;
    std::vector<BallRun> line;
    bool any = !last_.runs().empty();
    for (const SpanRows& top : tops_) any = any || !top.runs().empty();
    if (!any) return last_;
    for (std::size_t l = 0; l < last_.lines(); ++l) {
        line.clear();
        const auto add = [&](const SpanRows& rows, std::size_t layers_down) {
            const double way = std::max(static_cast<double>(layers_down) * grid_.layer_height - gap_, 0.0);
            const double left = (spacing_ * spacing_ - way * way) / (unit * unit);
            if (left < 0) return;
            for (const Run& run : rows.line(l)) line.push_back({run.begin, run.end, left});
        };
        add(last_, 0);
        for (std::size_t k = 0; k < tops_.size(); ++k) add(tops_[k], tops_.size() - k);
        std::ranges::sort(line, {}, &BallRun::begin);
        balls.append_line(line);
    }
    SpanRows out;
    grow_rows(balls, run_unit, out);
    return out;
}

void SupportHold::add(const SpanRows& supports) {
    SpanRows ended;
    subtract(last_, supports, ended);
    tops_.push_back(std::move(ended));
    if (tops_.size() > layers_) tops_.pop_front();
    last_ = supports;
}

}  // namespace lamella
