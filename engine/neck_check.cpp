// Openings split layers; union-find joins what they leave and what they take away.
#include "engine/neck_check.h"

#include <algorithm>

namespace lamella {
namespace {

/// Rows crumble the border of what is opened, run units.
constexpr double crumbs = 1.5 * run_unit;

/// The parts that a run of row `r` touches.
void touch_parts(const LabelledRun& run, int r, const LabelledLayer& parts,
                 std::vector<std::uint32_t>& marks) {
    for (int near = r - 1; near <= r + 1; ++near) {
        for_touching(std::span(&run, 1), parts.row(near),
                     [&](const LabelledRun&, const LabelledRun& part) { marks.push_back(part.component); });
    }
}

}  // namespace

NeckCheck::NeckCheck(const CheckGrid& grid, double thickness, double large_part, std::size_t most)
    : NeckCheck(grid, sampled_ball(grid.band, grid.layer_height, thickness, thickness), large_part, most) {}

NeckCheck::NeckCheck(const CheckGrid& grid, const SampledBall& ball, double large_part, std::size_t most)
    : grid_(grid),
      large_part_(large_part),
      opened_(ball.lattice, ball.radius, crumbs),
      parts_(Growth{}, 0),
      necks_(most) {}

void NeckCheck::push(const SpanRows& layer) {
    solid_.push_back(layer);
    opened_.push(layer);
    carry_on();
}

void NeckCheck::carry_on() {
    for (SpanRows opened; opened_.pop(opened);) split(opened);
}

void NeckCheck::split(const SpanRows& opened) {
    const SpanRows solid = std::move(solid_.front());
    solid_.pop_front();
    SpanRows part;
    Split fresh;
    intersect(solid, opened, part);
    subtract(solid, opened, fresh.rest);
    fresh.parts = label_layer(part, layers_, Growth{});
    const std::vector<std::uint32_t> numbers = parts_.add(fresh.parts, layers_);
    for (LabelledRun& run : fresh.parts.runs) run.component = numbers[run.component];
    recent_.push_back(std::move(fresh));
    ++layers_;
    if (recent_.size() > 1) join_rest(recent_.size() - 2);
    if (recent_.size() > 2) recent_.pop_front();
}

/// Joins the rest of a recent layer to those before it, with the parts that it touches as marks.
void NeckCheck::join_rest(std::size_t of) {
    const int layer = layers_ - static_cast<int>(recent_.size() - of);
    LabelledLayer rest = label_layer(recent_[of].rest, layer, Growth{});
    ComponentTags tags;
    tags.marks.resize(rest.components.size());
    for (int r = 0; r < rest.rows(); ++r) {
        for (const LabelledRun& run : rest.row(r)) {
            for (std::size_t k = of - std::min<std::size_t>(of, 1); k < std::min(of + 2, recent_.size()); ++k)
                touch_parts(run, r, recent_[k].parts, tags.marks[run.component]);
        }
    }
    for (std::vector<std::uint32_t>& marks : tags.marks) {
        for (std::uint32_t& mark : marks) mark = parts_.find(mark);
        std::ranges::sort(marks);
        marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
    }
    rests_.add(std::move(rest), layer, tags, ended_);
    for (EndedComponent& ended : ended_) {
        if (!ended.joined && ended.component.marks.size() > 1)
            candidates_.push_back(std::move(ended.component));
    }
    ended_.clear();
}

void NeckCheck::finish() {
    opened_.finish();
    carry_on();
    if (!recent_.empty()) join_rest(recent_.size() - 1);
    rests_.finish(ended_);
    for (EndedComponent& ended : ended_) candidates_.push_back(std::move(ended.component));
    for (const PassingComponent& candidate : candidates_) {
        std::vector<std::uint32_t> large;
        for (const std::uint32_t mark : candidate.marks) {
            const auto& part = parts_.component(mark);
            if (grid_.volume(part.extent.length) >= large_part_) large.push_back(parts_.find(mark));
        }
        std::ranges::sort(large);
        if (std::unique(large.begin(), large.end()) - large.begin() < 2) continue;
        Fault fault = grid_.fault(candidate);
        fault.size = grid_.volume(candidate.extent.length);
        necks_.add(std::move(fault));
    }
}

}  // namespace lamella
