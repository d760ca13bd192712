// Sweeps across rows, then from layer to layer.
#include "engine/layer_offset.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/run_union.h"

namespace lamella {
namespace {

constexpr std::int32_t far_out = 1 << 29;  // run units; solids lie within, the void reaches up to it

/// Appends a line that covers all of the intervals.
void push_united(std::vector<Run>& runs, SpanRows& out) {
    std::ranges::sort(runs, {}, &Run::begin);
    for (const Run& run : runs) out.push(run.begin, run.end);
    out.end_line();
}

/// The runs of a layer with those of the lines about them, each with what is left of its weight.
BallRows carried_across(const BallRows& rows, double pitch) {
    const std::size_t lines = rows.lines();
    std::vector<std::vector<BallRun>> before(lines);
    BallSweep sweep(pitch);
    for (std::size_t l = 0; l < lines; ++l) {
        sweep.step();
        sweep.add(rows.line(l));
        sweep.append_runs(before[l]);
    }
    sweep.reset();
    std::vector<std::vector<BallRun>> all(lines);
    std::vector<BallRun> after;
    BallSweep both(pitch);
    for (std::size_t l = lines; l-- > 0;) {
        sweep.step();
        after.clear();
        sweep.append_runs(after);
        both.reset();
        both.add(before[l]);
        both.add(after);
        both.drop_hidden();
        both.append_runs(all[l]);
        sweep.add(rows.line(l));
    }
    BallRows carried;
    for (const std::vector<BallRun>& line : all) carried.append_line(line);
    return carried;
}

/// The void of a line between far left and far right.
void append_void(std::span<const Run> solid, double weight, BallRows& out) {
    std::vector<BallRun> runs;
    std::int32_t at = -far_out;
    for (const Run& run : solid) {
        if (run.begin > at) runs.push_back({at, run.begin, weight});
        at = run.end;
    }
    if (at < far_out) runs.push_back({at, far_out, weight});
    out.append_line(runs);
}

/// The void of a layer with `margin` lines on either side.
BallRows void_of(const SpanRows& rows, std::size_t margin, double radius) {
    BallRows out;
    for (std::size_t l = 0; l < margin; ++l) append_void({}, radius * radius, out);
    for (std::size_t l = 0; l < rows.lines(); ++l) append_void(rows.line(l), radius * radius, out);
    for (std::size_t l = 0; l < margin; ++l) append_void({}, radius * radius, out);
    return out;
}

/// What is left between the grown voids, without the margin.
void append_solid(const SpanRows& voids, std::size_t margin, SpanRows& out) {
    for (std::size_t l = margin; l + margin < voids.lines(); ++l) {
        std::int32_t at = -far_out;
        for (const Run& run : voids.line(l)) {
            out.push(at, run.begin);
            at = run.end;
        }
        out.end_line();
    }
}

}  // namespace

BallRows::BallRows(const SpanRows& rows, double radius) : BallRows() {
    runs_.reserve(rows.runs().size());
    for (std::size_t l = 0; l < rows.lines(); ++l) {
        for (const Run& run : rows.line(l)) runs_.push_back({run.begin, run.end, radius * radius});
        starts_.push_back(runs_.size());
    }
}

void BallRows::append_line(std::span<const BallRun> runs) {
    runs_.insert(runs_.end(), runs.begin(), runs.end());
    starts_.push_back(runs_.size());
}

void grow_rows(const BallRows& rows, double row_pitch, SpanRows& out) {
    out.clear();
    const std::size_t lines = rows.lines();
    std::vector<std::vector<Run>> before(lines);
    BallSweep sweep(row_pitch);
    for (std::size_t l = lines; l-- > 0;) {
        sweep.step();
        sweep.append_covered(before[l]);
        sweep.add(rows.line(l));
    }
    sweep.reset();
    for (std::size_t l = 0; l < lines; ++l) {
        sweep.step();
        sweep.add(rows.line(l));
        sweep.append_covered(before[l]);
        push_united(before[l], out);
    }
}

void shrink_rows(const SpanRows& rows, double radius, double row_pitch, SpanRows& out) {
    const auto margin = static_cast<std::size_t>(radius / row_pitch);
    SpanRows voids;
    grow_rows(void_of(rows, margin, radius), row_pitch, voids);
    out.clear();
    append_solid(voids, margin, out);
}

GrowingLayers::GrowingLayers(const LayerLattice& lattice, double most_reach)
    : lattice_(lattice), reach_(lattice.layers_within(most_reach)) {}

void GrowingLayers::push(BallRows layer) {
    if (layer.lines() != lattice_.lines) throw FaultError("a layer has other lines than the lattice");
    layers_.push_back(std::move(layer));
}

bool GrowingLayers::pop(SpanRows& out) {
    const std::size_t waiting = layers_.size() - past_;
    if (done_.empty() && (finished_ ? waiting > 0 : waiting >= block_ + reach_)) finish_block();
    if (done_.empty()) return false;
    out = std::move(done_.front());
    done_.pop_front();
    return true;
}

void GrowingLayers::finish_block() {
    const std::size_t count = std::min(block_, layers_.size() - past_);
    const std::size_t window = std::min(past_ + count + reach_, layers_.size());
    namespace tbb = oneapi::tbb;
    tbb::parallel_for(spread_, window,
                      [&](std::size_t z) { layers_[z] = carried_across(layers_[z], lattice_.row_pitch); });
    spread_ = window;
    const Run extent = this->extent(window);
    std::vector<SpanRows> grown(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        RunUnion covered;
        covered.reset(extent.begin, extent.end);
        const std::size_t z = past_ + i, last = std::min(window, z + reach_ + 1);
        for (std::size_t l = 0; l < lattice_.lines; ++l) {
            for (std::size_t from = z - std::min(z, reach_); from < last; ++from) {
                const double way =
                    (static_cast<double>(z) - static_cast<double>(from)) * lattice_.layer_pitch;
                for (const BallRun& run : layers_[from].line(l)) {
                    const double left = run.weight - way * way;
                    if (left < 0) continue;
                    const BallReach reach(std::sqrt(left));
                    covered.add(run.begin - reach.back, run.end + reach.ahead);
                }
            }
            covered.take(grown[i]);
        }
    });
    for (SpanRows& layer : grown) done_.push_back(std::move(layer));
    const std::size_t forgotten = past_ + count - std::min(past_ + count, reach_);
    layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(forgotten));
    past_ += count - forgotten;
    spread_ -= forgotten;
}

/// Where what is grown from these layers can begin and end, runs without an end apart.
Run GrowingLayers::extent(std::size_t layers) const {
    Run extent{far_out, -far_out};
    double most = 0;
    for (std::size_t z = 0; z < layers; ++z) {
        for (const BallRun& run : layers_[z].runs()) {
            for (const std::int32_t end : {run.begin, run.end}) {
                if (std::abs(end) >= far_out) continue;
                extent.begin = std::min(extent.begin, end);
                extent.end = std::max(extent.end, end);
            }
            most = std::max(most, run.weight);
        }
    }
    if (extent.begin > extent.end) return {0, run_unit};
    const auto reach = static_cast<std::int32_t>(std::sqrt(most)) + 2;
    return {extent.begin - reach, extent.end + reach};
}

ShrinkingLayers::ShrinkingLayers(const LayerLattice& lattice, double radius)
    : lattice_(lattice),
      radius_(radius),
      margin_(lattice.lines_within(radius)),
      void_layers_(lattice.layers_within(radius)),
      to_drop_(void_layers_),
      voids_({lattice.row_pitch, lattice.layer_pitch, lattice.lines + 2 * margin_}, radius) {
    push_void();
}

void ShrinkingLayers::push_void() {
    SpanRows nothing;
    for (std::size_t l = 0; l < lattice_.lines; ++l) nothing.end_line();
    for (std::size_t i = 0; i < void_layers_; ++i) voids_.push(void_of(nothing, margin_, radius_));
}

void ShrinkingLayers::push(const SpanRows& layer) {
    if (layer.lines() != lattice_.lines) throw FaultError("a layer has other lines than the lattice");
    voids_.push(void_of(layer, margin_, radius_));
    ++to_come_;
}

void ShrinkingLayers::finish() {
    push_void();
    voids_.finish();
}

bool ShrinkingLayers::pop(SpanRows& out) {
    SpanRows voids;
    for (; to_drop_ > 0; --to_drop_) {
        if (!voids_.pop(voids)) return false;
    }
    if (to_come_ == 0 || !voids_.pop(voids)) return false;
    --to_come_;
    out.clear();
    append_solid(voids, margin_, out);
    return true;
}

}  // namespace lamella
