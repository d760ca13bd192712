// NeckCheck: thin features split the layers; union-find joins the parts and the rests across layers.
#include "engine/checks/neck_check.h"

#include <algorithm>

#include "engine/morphology/sampled_ball.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

/// Slack for the rough border of an opening that is sampled by rows, run units.
constexpr double crumbs = 1.5 * run_unit;

ThinFeatureStream thin_layers(const SampledBall& ball) { return {ball.lattice, {ball.radius, crumbs}}; }

/// Appends the parts that a run of row `r` touches.
void touch_parts(const LabelledRun& run, int r, const LabelledLayer& parts,
                 std::vector<std::uint32_t>& marks) {
    for (int near = r - 1; near <= r + 1; ++near) {
        for_touching(std::span(&run, 1), parts.row(near),
                     [&](const LabelledRun&, const LabelledRun& part) { marks.push_back(part.component); });
    }
}

}  // namespace

CheckSampling NeckCheck::sampling_for(const CheckGrid& grid, double thickness) {
    constexpr double rows_in_a_neck = 4, layers_in_a_neck = 3;
    const auto one_of = [&](double pitch, double samples) {
        return std::max(1, static_cast<int>(thickness / (samples * pitch) * (1 + 1e-9)));
    };
    const double least = grid.layers.least_height();
    return {one_of(grid.band.across_pitch, rows_in_a_neck), one_of(least, layers_in_a_neck),
            std::max(least, thickness / layers_in_a_neck)};
}

NeckCheck::NeckCheck(const CheckContext& context, const CheckSampling& sampling)
    : whole_(context.grid),
      grid_(sampling.subsample(context.grid)),
      sampling_(sampling),
      large_part_(context.limits.large_part),
      thin_(thin_layers(
          sampled_ball(grid_.band, grid_.layers.least_height(), context.limits.neck, context.limits.neck))),
      necks_(context.max_faults) {}

void NeckCheck::add(LayerSample& layer, PreparedRows /*prepared*/) {
    for (int k = sampling_.samples(whole_.layers, layer.index); k > 0; --k) {
        solid_.push_back(sampling_.subsample(layer.rows.part));
        thin_.push(solid_.back());
        carry_on();
    }
}

void NeckCheck::carry_on() {
    for (RunRows thin; thin_.pop(thin);) split(std::move(thin));
}

void NeckCheck::split(RunRows thin) {
    Split fresh;
    fresh.parts = parts_.add(label_layer(without(solid_.front(), thin), layers_, Growth{}));
    fresh.rest = std::move(thin);
    solid_.pop_front();
    recent_.push_back(std::move(fresh));
    ++layers_;
    if (recent_.size() > 1) join_rest(recent_.size() - 2);
    if (recent_.size() > 2) recent_.pop_front();
    if (parts_.size() > max_parts_) forget_what_is_settled();
}

/// Joins the rest of a recent layer to the rests before it. The marks of a rest are the parts that it
/// touches.
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

/// Reduces marks to the parts that are large, or may become large because they are among the sorted
/// `growing`. Removes duplicates.
void NeckCheck::settle(std::vector<std::uint32_t>& marks, const std::vector<std::uint32_t>& growing) {
    for (std::uint32_t& mark : marks) mark = parts_.find(mark);
    std::erase_if(marks, [&](std::uint32_t mark) {
        const bool is_large = grid_.volume(parts_.length(mark)) >= large_part_;
        return !is_large && !std::ranges::binary_search(growing, mark);
    });
    std::ranges::sort(marks);
    marks.erase(std::unique(marks.begin(), marks.end()), marks.end());
}

/// Drops candidates that can no longer be necks, and parts that nothing can refer to any more.
void NeckCheck::forget_what_is_settled() {
    std::vector<std::uint32_t> used, growing;
    for (const Split& layer : recent_) {
        for (const LabelledRun& run : layer.parts.runs) used.push_back(run.component);
    }
    for (const LabelledRun& run : recent_.back().parts.runs) growing.push_back(parts_.find(run.component));
    std::ranges::sort(growing);
    const auto keep = [&](std::vector<std::uint32_t>& marks) {
        settle(marks, growing);
        used.insert(used.end(), marks.begin(), marks.end());
    };
    for (StreamingComponent& candidate : candidates_) keep(candidate.marks);
    std::erase_if(candidates_,
                  [](const StreamingComponent& candidate) { return candidate.marks.size() < 2; });
    rests_.change_marks(keep);
    parts_.forget_all_but(std::move(used));
    max_parts_ = std::max<std::size_t>(1024, 2 * parts_.size());
}

void NeckCheck::finish() {
    thin_.finish();
    carry_on();
    if (!recent_.empty()) join_rest(recent_.size() - 1);
    rests_.finish(ended_);
    for (EndedComponent& ended : ended_) candidates_.push_back(std::move(ended.component));
    for (StreamingComponent& candidate : candidates_) {
        settle(candidate.marks, {});
        if (candidate.marks.size() > 1) necks_.add(neck(candidate));
    }
}

/// Makes a fault of a rest, in full resolution.
Fault NeckCheck::neck(const StreamingComponent& rest) const {
    Fault fault = grid_.fault(rest);
    fault.size = grid_.volume(rest.extent.length);
    return sampling_.to_full_resolution(std::move(fault), whole_);
}

}  // namespace lamella
