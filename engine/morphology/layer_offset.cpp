// Blocks of lines, strip by strip; the void in place of the solid.
#include "engine/morphology/layer_offset.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel_strips.h"
#include "engine/morphology/brute_force_dilation.h"
#include "engine/morphology/pruned_dilation.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

constexpr std::size_t min_block = 16;  // layers that are finished together

/// Where a ball reaches so few lines, all runs on them are looked at (BruteForceDilation): about where foams
/// and capsules were measured to take as long in larger blocks. Balls of eleven lines.
constexpr std::size_t max_lines_by_all = 400;

using LayerStack = std::vector<const WeightedRows*>;

double max_weight_of(const LayerStack& stack) {
    double most = 0;
    for (const WeightedRows* layer : stack) most = std::max(most, layer->max_weight());
    return most;
}

/// Where what is grown from these layers can begin and end, runs without an end apart.
Run extent_of(const LayerStack& stack) {
    Run extent{unbounded, -unbounded};
    for (const WeightedRows* layer : stack) {
        for (const WeightedRun& run : layer->runs()) {
            for (const std::int32_t end : {run.begin, run.end}) {
                if (std::abs(end) >= unbounded) continue;
                extent.begin = std::min(extent.begin, end);
                extent.end = std::max(extent.end, end);
            }
        }
    }
    if (extent.begin > extent.end) return {0, run_unit};
    const auto reach = static_cast<std::int32_t>(std::sqrt(max_weight_of(stack))) + 2;
    return {extent.begin - reach, extent.end + reach};
}

/// Lines along the edge of blocks that are best grown together, as measured on foams, gyroids and capsules:
/// those of SimdRunUnion as long as the search for what is near does not outweigh the rest, then larger ones,
/// which are halved.
std::size_t edge_of_blocks(const LayerLattice& lattice, double reach) {
    const std::size_t lines = lattice.lines_within(reach);
    if (lines < 32) return std::clamp<std::size_t>(std::bit_floor(lines), 1, SimdRunUnion::edge);
    return lines < 48 ? 16 : 32;
}

/// How many lines a ball reaches in a stack of so many layers.
std::size_t lines_reached(const LayerLattice& lattice, double weight, std::size_t layers) {
    const double reach = std::sqrt(weight);
    const std::size_t up_to = std::min(lattice.layers_within(reach), layers - 1);
    std::size_t lines = 2 * lattice.lines_within(reach) + 1;
    for (std::size_t k = 1; k <= up_to && lines <= max_lines_by_all; ++k) {
        const double up = static_cast<double>(k) * lattice.layer_pitch;
        lines += 2 * (2 * lattice.lines_within(std::sqrt(std::max(weight - up * up, 0.0))) + 1);
    }
    return lines;
}

/// Whether all runs that so large a ball reaches in a stack of so many layers had better be looked at.
bool looks_at_all(const LayerLattice& lattice, const BallExtentTable& reaches, double weight,
                  std::size_t layers) {
    return reaches.weight() >= 0 && lines_reached(lattice, weight, layers) <= max_lines_by_all;
}

/// Appends a grown line; what goes on without an end reaches the ends of the extent.
void append_line(std::span<const Run> grown, Run extent, RunRows& out) {
    for (const Run& run : grown) {
        out.push(run.begin == extent.begin ? -unbounded : run.begin,
                 run.end == extent.end ? unbounded : run.end);
    }
    out.end_line();
}

/// The lines of a block one after another.
template <typename Grower>
void append_block(const Grower& grown, const LineBlock& block, Run extent, std::span<RunRows> layers) {
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l)
            append_line(grown.line(z, l), extent, layers[static_cast<std::size_t>(z)]);
    }
}

/// Lines that are worked on by one thread at once.
constexpr std::size_t strip_lines = 32;

std::size_t strips_of(const LayerLattice& lattice) { return (lattice.lines + strip_lines - 1) / strip_lines; }

using Strips = std::vector<std::vector<RunRows>>;  // layer by layer

std::vector<RunRows> side_by_side(const Strips& strips, std::size_t layer_count) {
    std::vector<RunRows> layers(layer_count);
    for (std::size_t z = 0; z < layer_count; ++z) {
        for (const std::vector<RunRows>& strip : strips) layers[z].append_lines(strip[z]);
    }
    return layers;
}

/// Grows layers [from, from + count) of a stack, by blocks of `high` layers of `wide` lines.
template <typename Grower>
std::vector<RunRows> grow_blocks(const LayerStack& stack, const LayerLattice& lattice,
                                 const BallExtentTable& reaches, std::size_t high, std::size_t wide,
                                 std::size_t from, std::size_t count) {
    const Run extent = extent_of(stack);
    Strips strips(strips_of(lattice));
    oneapi::tbb::enumerable_thread_specific<Grower> growers(lattice, std::cref(reaches), extent,
                                                            static_cast<std::int32_t>(std::min(high, count)),
                                                            max_weight_of(stack));
    for_all_strips(strips.size(), [&](std::size_t s) {
        Grower& grower = growers.local();
        std::vector<RunRows>& layers = strips[s];
        layers.resize(count);
        const std::size_t first = s * strip_lines, last = std::min(first + strip_lines, lattice.lines);
        for (std::size_t z = 0; z < count; z += high) {
            const std::size_t end = std::min(z + high, count);
            for (std::size_t l = first; l < last; l += wide) {
                const LineBlock block{static_cast<std::int32_t>(from + z), static_cast<std::int32_t>(l),
                                      static_cast<std::int32_t>(end - z),
                                      static_cast<std::int32_t>(std::min(wide, last - l))};
                grower.grow(block, stack);
                append_block(grower, block, extent, std::span<RunRows>(layers).subspan(z, end - z));
            }
        }
    });
    return side_by_side(strips, count);
}

/// The same in whichever way is faster.
std::vector<RunRows> grow_within(const LayerStack& stack, const LayerLattice& lattice,
                                 const BallExtentTable& reaches, std::size_t from, std::size_t count) {
    const double max_weight = max_weight_of(stack);
    const double reach = std::sqrt(max_weight);
    if (looks_at_all(lattice, reaches, max_weight, stack.size())) {
        // Large balls reach most of the layers of higher blocks from everywhere.
        const std::size_t high = lattice.layers_within(reach) <= SimdRunUnion::edge ? 4 : SimdRunUnion::edge;
        return grow_blocks<BruteForceDilation>(stack, lattice, reaches, high, SimdRunUnion::edge, from,
                                               count);
    }
    const std::size_t edge = edge_of_blocks(lattice, reach);
    return grow_blocks<PrunedDilation>(stack, lattice, reaches, edge, edge, from, count);
}

/// The void of a line between far left and far right.
void append_void(std::span<const Run> solid, double weight, WeightedRows& out) {
    std::vector<WeightedRun> runs;
    std::int32_t at = -unbounded;
    for (const Run& run : solid) {
        if (run.begin > at) runs.push_back({at, run.begin, weight});
        at = run.end;
    }
    if (at < unbounded) runs.push_back({at, unbounded, weight});
    out.append_line(runs);
}

/// The void of a layer with `margin` lines on either side.
WeightedRows void_of(const RunRows& rows, std::size_t margin, double radius) {
    WeightedRows out;
    for (std::size_t l = 0; l < margin; ++l) append_void({}, radius * radius, out);
    for (std::size_t l = 0; l < rows.lines(); ++l) append_void(rows.line(l), radius * radius, out);
    for (std::size_t l = 0; l < margin; ++l) append_void({}, radius * radius, out);
    return out;
}

/// What is left between the grown voids, without the margin.
void append_solid(const RunRows& voids, std::size_t margin, RunRows& out) {
    for (std::size_t l = margin; l + margin < voids.lines(); ++l) {
        std::int32_t at = -unbounded;
        for (const Run& run : voids.line(l)) {
            out.push(at, run.begin);
            at = run.end;
        }
        out.end_line();
    }
}

}  // namespace

void grow_rows(const WeightedRows& rows, double row_pitch, RunRows& out) {
    // Other layers, of which there are none, lie beyond every disc.
    const double beyond = 2 * std::sqrt(rows.max_weight()) + row_pitch;
    const LayerLattice lattice{row_pitch, beyond, rows.lines()};
    out = std::move(grow_within({&rows}, lattice, BallExtentTable(lattice, rows.max_weight()), 0, 1).front());
}

void shrink_rows(const RunRows& rows, double radius, double row_pitch, RunRows& out) {
    const auto margin = static_cast<std::size_t>(radius / row_pitch);
    RunRows voids;
    grow_rows(void_of(rows, margin, radius), row_pitch, voids);
    out.clear();
    append_solid(voids, margin, out);
}

DilationStream::DilationStream(const LayerLattice& lattice, double max_reach)
    : lattice_(lattice),
      max_weight_(max_reach * max_reach),
      ball_(lattice, max_weight_),
      reach_(lattice.layers_within(max_reach)),
      block_(std::max(edge_of_blocks(lattice, max_reach), min_block)),
      sight_limits_(lattice, max_weight_) {}

void DilationStream::push(WeightedRows layer) {
    if (layer.lines() != lattice_.lines) throw FaultError("a layer has other lines than the lattice");
    if (layer.max_weight() > max_weight_) throw FaultError("a ball is larger than the greatest one");
    layers_.push_back(std::move(layer));
}

bool DilationStream::pop(RunRows& out) {
    const std::size_t waiting = layers_.size() - past_;
    if (done_.empty() && (finished_ ? waiting > 0 : waiting >= block_ + reach_)) finish_block();
    if (done_.empty()) return false;
    out = std::move(done_.front());
    done_.pop_front();
    return true;
}

void DilationStream::limit_sights() {
    for_all_strips(layers_.size() - limited_, [&](std::size_t i) {
        WeightedRows& layer = layers_[limited_ + i];
        layer.begin_sights();
        sight_limits_.limit(layer);
    });
    for_all_strips(strips_of(lattice_), [&](std::size_t s) {
        const std::size_t first = s * strip_lines, end = std::min(first + strip_lines, lattice_.lines);
        for (std::size_t z = std::max<std::size_t>(limited_, 1); z < layers_.size(); ++z)
            sight_limits_.limit(layers_[z - 1], layers_[z], first, end);
    });
    limited_ = layers_.size();
}

void DilationStream::finish_block() {
    const std::size_t count = std::min(block_, layers_.size() - past_);
    const std::size_t window = std::min(past_ + count + reach_, layers_.size());
    if (!few_ends_left_ && !looks_at_all(lattice_, ball_, max_weight_, window)) limit_sights();
    LayerStack stack;
    for (std::size_t z = 0; z < window; ++z) stack.push_back(&layers_[z]);
    std::size_t runs = 0, grown_runs = 0;
    for (RunRows& layer : grow_within(stack, lattice_, ball_, past_, count)) {
        grown_runs += layer.runs().size();
        done_.push_back(std::move(layer));
    }
    for (std::size_t z = past_; z < past_ + count; ++z) runs += layers_[z].runs().size();
    constexpr std::size_t few = 3;
    few_ends_left_ = few * grown_runs < runs;
    const std::size_t forgotten = past_ + count - std::min(past_ + count, reach_);
    layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(forgotten));
    past_ += count - forgotten;
    limited_ -= std::min(limited_, forgotten);
}

ErosionStream::ErosionStream(const LayerLattice& lattice, double radius)
    : lattice_(lattice),
      radius_(radius),
      margin_(lattice.lines_within(radius)),
      void_layers_(lattice.layers_within(radius)),
      to_drop_(void_layers_),
      voids_({lattice.row_pitch, lattice.layer_pitch, lattice.lines + 2 * margin_}, radius) {
    push_void();
}

void ErosionStream::push_void() {
    const RunRows nothing = empty_rows(lattice_.lines);
    for (std::size_t i = 0; i < void_layers_; ++i) voids_.push(void_of(nothing, margin_, radius_));
}

void ErosionStream::push(const RunRows& layer) {
    if (layer.lines() != lattice_.lines) throw FaultError("a layer has other lines than the lattice");
    voids_.push(void_of(layer, margin_, radius_));
    ++to_come_;
}

void ErosionStream::finish() {
    push_void();
    voids_.finish();
}

bool ErosionStream::pop(RunRows& out) {
    RunRows voids;
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
