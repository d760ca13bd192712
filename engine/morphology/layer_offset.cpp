// Dilation in blocks of lines, strips of them in parallel. Erosion dilates the void.
#include "engine/morphology/layer_offset.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/morphology/brute_force_dilation.h"
#include "engine/morphology/pruned_dilation.h"
#include "engine/runs/row_sets.h"

namespace lamella {
namespace {

constexpr std::size_t min_block = 16;  // least number of layers dilated together

/// Balls that reach at most so many lines are dilated by brute force (BruteForceDilation). Measured on foams
/// and capsules, PrunedDilation breaks even about here: at balls with a radius of eleven lines.
constexpr std::size_t max_lines_by_all = 400;

using LayerStack = std::vector<const WeightedRows*>;

double max_weight_of(const LayerStack& stack) {
    double most = 0;
    for (const WeightedRows* layer : stack) most = std::max(most, layer->max_weight());
    return most;
}

/// Returns the extent of the dilated layers along the lines. Unbounded run ends are ignored.
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

/// Returns the fastest edge length of blocks, in lines and layers, as measured on foams, gyroids and
/// capsules. For moderate balls it is at most that of SimdRunUnion. For large balls the search for runs in
/// reach dominates, and larger blocks, which are halved then, share it.
std::size_t edge_of_blocks(const LayerLattice& lattice, double reach) {
    const std::size_t lines = lattice.lines_within(reach);
    if (lines < 32) return std::clamp<std::size_t>(std::bit_floor(lines), 1, SimdRunUnion::edge);
    return lines < 48 ? 16 : 32;
}

/// Returns how many lines a ball reaches in a stack of `layers` layers. Stops counting above
/// max_lines_by_all.
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

/// Returns true if brute force is faster for a ball of that weight in a stack of `layers` layers.
bool looks_at_all(const LayerLattice& lattice, const BallExtentTable& reaches, double weight,
                  std::size_t layers) {
    return reaches.weight() >= 0 && lines_reached(lattice, weight, layers) <= max_lines_by_all;
}

/// Appends a dilated line. Runs that reach an end of the extent are unbounded there.
void append_line(std::span<const Run> grown, Run extent, RunRows& out) {
    for (const Run& run : grown) {
        out.push(run.begin == extent.begin ? -unbounded : run.begin,
                 run.end == extent.end ? unbounded : run.end);
    }
    out.end_line();
}

/// Appends the dilated lines of a block to its layers.
template <typename Grower>
void append_block(const Grower& grown, const LineBlock& block, Run extent, std::span<RunRows> layers) {
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l)
            append_line(grown.line(z, l), extent, layers[static_cast<std::size_t>(z)]);
    }
}

/// Lines of one task of a thread.
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

/// Dilates layers [from, from + count) of a stack, in blocks of `high` layers of `wide` lines.
template <typename Grower>
std::vector<RunRows> grow_blocks(const LayerStack& stack, const LayerLattice& lattice,
                                 const BallExtentTable& reaches, std::size_t high, std::size_t wide,
                                 std::size_t from, std::size_t count) {
    const Run extent = extent_of(stack);
    Strips strips(strips_of(lattice));
    oneapi::tbb::enumerable_thread_specific<Grower> growers(lattice, std::cref(reaches), extent,
                                                            static_cast<std::int32_t>(std::min(high, count)),
                                                            max_weight_of(stack));
    isolated_parallel_for(strips.size(), [&](std::size_t s) {
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

/// Dilates layers [from, from + count) of a stack with the faster of the two engines.
std::vector<RunRows> grow_within(const LayerStack& stack, const LayerLattice& lattice,
                                 const BallExtentTable& reaches, std::size_t from, std::size_t count) {
    const double max_weight = max_weight_of(stack);
    const double reach = std::sqrt(max_weight);
    if (looks_at_all(lattice, reaches, max_weight, stack.size())) {
        // Higher blocks pay for balls that reach most of their layers from anywhere.
        const std::size_t high = lattice.layers_within(reach) <= SimdRunUnion::edge ? 4 : SimdRunUnion::edge;
        return grow_blocks<BruteForceDilation>(stack, lattice, reaches, high, SimdRunUnion::edge, from,
                                               count);
    }
    const std::size_t edge = edge_of_blocks(lattice, reach);
    return grow_blocks<PrunedDilation>(stack, lattice, reaches, edge, edge, from, count);
}

/// Appends the void of a line, from -unbounded to unbounded.
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

/// Returns the void of a layer, with `margin` lines of void on either side.
WeightedRows void_of(const RunRows& rows, std::size_t margin, double radius) {
    WeightedRows out;
    for (std::size_t l = 0; l < margin; ++l) append_void({}, radius * radius, out);
    for (std::size_t l = 0; l < rows.lines(); ++l) append_void(rows.line(l), radius * radius, out);
    for (std::size_t l = 0; l < margin; ++l) append_void({}, radius * radius, out);
    return out;
}

/// Appends the complement of the dilated void, without the margin.
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
    // A layer pitch beyond every disc's reach: the lattice has a single layer.
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
    isolated_parallel_for(layers_.size() - limited_, [&](std::size_t i) {
        WeightedRows& layer = layers_[limited_ + i];
        layer.begin_sights();
        sight_limits_.limit(layer);
    });
    isolated_parallel_for(strips_of(lattice_), [&](std::size_t s) {
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
