// Lines or blocks of them, strip by strip; the void in place of the solid.
#include "engine/layer_offset.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/error.h"
#include "engine/grown_block.h"
#include "engine/grown_line.h"
#include "engine/parallel_strips.h"
#include "engine/row_sets.h"

namespace lamella {
namespace {

constexpr std::size_t least_block = 16;  // layers that are finished together

/// Where a ball reaches so few lines, each of them is looked at for every line that is grown: about where
/// foams and single beams were measured to take as long in blocks. Balls of six lines and a half.
constexpr std::size_t most_lines_by_line = 140;
/// Down to here, which are balls of three lines, blocks are faster inside of solids.
constexpr std::size_t least_lines_in_solids = 30;

using LayerStack = std::vector<const BallRows*>;

/// Where what is grown from these layers can begin and end, runs without an end apart.
Run extent_of(const LayerStack& stack) {
    Run extent{far_out, -far_out};
    double most = 0;
    for (const BallRows* layer : stack) {
        for (const BallRun& run : layer->runs()) {
            for (const std::int32_t end : {run.begin, run.end}) {
                if (std::abs(end) >= far_out) continue;
                extent.begin = std::min(extent.begin, end);
                extent.end = std::max(extent.end, end);
            }
        }
        most = std::max(most, layer->most_weight());
    }
    if (extent.begin > extent.end) return {0, run_unit};
    const auto reach = static_cast<std::int32_t>(std::sqrt(most)) + 2;
    return {extent.begin - reach, extent.end + reach};
}

/// Lines along the edge of blocks that are best grown together, as measured on foams, gyroids and capsules:
/// those of BlockGaps as long as all of their lines have something in common; larger ones, which are halved
/// first, where the search for what is near outweighs the rest.
std::size_t edge_of_blocks(const LayerLattice& lattice, double reach) {
    const std::size_t lines = lattice.lines_within(reach);
    if (lines < 32) return std::clamp<std::size_t>(std::bit_floor(lines), 1, GapLimits::edge);
    return lines < 48 ? 16 : 32;
}

/// How many lines a ball reaches in a stack of so many layers.
std::size_t lines_reached(const LayerLattice& lattice, double weight, std::size_t layers) {
    const double reach = std::sqrt(weight);
    const std::size_t up_to = std::min(lattice.layers_within(reach), layers - 1);
    std::size_t lines = 2 * lattice.lines_within(reach) + 1;
    for (std::size_t k = 1; k <= up_to && lines <= most_lines_by_line; ++k) {
        const double up = static_cast<double>(k) * lattice.layer_pitch;
        lines += 2 * (2 * lattice.lines_within(std::sqrt(std::max(weight - up * up, 0.0))) + 1);
    }
    return lines;
}

/// Appends a grown line; what goes on without an end reaches the ends of the extent.
void append_line(std::span<const Run> grown, Run extent, SpanRows& out) {
    for (const Run& run : grown) {
        out.push(run.begin == extent.begin ? -far_out : run.begin, run.end == extent.end ? far_out : run.end);
    }
    out.end_line();
}

using Strips = std::vector<std::vector<SpanRows>>;  // layer by layer

std::vector<SpanRows> side_by_side(const Strips& strips, std::size_t layer_count) {
    std::vector<SpanRows> layers(layer_count);
    for (std::size_t z = 0; z < layer_count; ++z) {
        for (const std::vector<SpanRows>& strip : strips) layers[z].append_lines(strip[z]);
    }
    return layers;
}

/// Lines that are worked on by one thread at once.
constexpr std::size_t strip_lines = 32;

/// Cuts layers [from, from + count) into blocks of `edge` lines and calls grow(block, layers) for each: it
/// appends the block's lines to those of `layers`.
template <typename Grow>
void for_blocks(std::size_t strip, const LayerLattice& lattice, std::size_t edge, std::size_t from,
                std::size_t count, std::vector<SpanRows>& layers, Grow grow) {
    layers.resize(count);
    const std::size_t first = strip * strip_lines, last = std::min(first + strip_lines, lattice.lines);
    for (std::size_t z = 0; z < count; z += edge) {
        const std::size_t end = std::min(z + edge, count);
        for (std::size_t l = first; l < last; l += edge) {
            const LineBlock block{static_cast<std::int32_t>(from + z), static_cast<std::int32_t>(l),
                                  static_cast<std::int32_t>(end - z),
                                  static_cast<std::int32_t>(std::min(edge, last - l))};
            grow(block, std::span<SpanRows>(layers).subspan(z, end - z));
        }
    }
}

/// The lines of a block one after another.
void append_block(const GrownBlock& grown, const LineBlock& block, Run extent, std::span<SpanRows> layers) {
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l)
            append_line(grown.line(z, l), extent, layers[static_cast<std::size_t>(z)]);
    }
}

/// Grows layers [from, from + count) of a stack line by line, but for blocks inside of solids if these are
/// to be looked for.
std::vector<SpanRows> grow_lines(const LayerStack& stack, const LayerLattice& lattice,
                                 const BallReaches& reaches, double most_weight, bool in_solids,
                                 std::size_t from, std::size_t count) {
    const Run extent = extent_of(stack);
    Strips strips((lattice.lines + strip_lines - 1) / strip_lines);
    oneapi::tbb::enumerable_thread_specific<GrownBlock> blocks(lattice, std::cref(reaches), extent);
    oneapi::tbb::enumerable_thread_specific<GrownLine> lines(lattice, most_weight, extent);
    for_all_strips(strips.size(), [&](std::size_t s) {
        GrownBlock* const solid = in_solids ? &blocks.local() : nullptr;
        GrownLine& line = lines.local();
        std::vector<Run> runs;
        const auto grow = [&](const LineBlock& block, std::span<SpanRows> layers) {
            if (solid != nullptr && solid->grow_solid(block, stack))
                return append_block(*solid, block, extent, layers);
            const auto first_layer = static_cast<std::size_t>(block.layer),
                       first_line = static_cast<std::size_t>(block.line),
                       last_line = first_line + static_cast<std::size_t>(block.lines);
            for (std::size_t z = 0; z < layers.size(); ++z) {
                for (std::size_t l = first_line; l < last_line; ++l) {
                    runs.clear();
                    line.grow(stack, first_layer + z, l, runs);
                    append_line(runs, extent, layers[z]);
                }
            }
        };
        for_blocks(s, lattice, GapLimits::edge, from, count, strips[s], grow);
    });
    return side_by_side(strips, count);
}

/// The same in blocks `edge` lines wide.
std::vector<SpanRows> grow_blocks(const LayerStack& stack, const LayerLattice& lattice,
                                  const BallReaches& reaches, std::size_t edge, std::size_t from,
                                  std::size_t count) {
    const Run extent = extent_of(stack);
    Strips strips((lattice.lines + strip_lines - 1) / strip_lines);
    oneapi::tbb::enumerable_thread_specific<GrownBlock> blocks(lattice, std::cref(reaches), extent);
    for_all_strips(strips.size(), [&](std::size_t s) {
        GrownBlock& grown = blocks.local();
        for_blocks(s, lattice, edge, from, count, strips[s],
                   [&](const LineBlock& block, std::span<SpanRows> layers) {
                       grown.grow(block, stack);
                       append_block(grown, block, extent, layers);
                   });
    });
    return side_by_side(strips, count);
}

/// The same in whichever way is faster.
std::vector<SpanRows> grow_within(const LayerStack& stack, const LayerLattice& lattice,
                                  const BallReaches& reaches, std::size_t from, std::size_t count) {
    double most_weight = 0;
    for (const BallRows* layer : stack) most_weight = std::max(most_weight, layer->most_weight());
    const std::size_t lines = lines_reached(lattice, most_weight, stack.size());
    if (lines <= most_lines_by_line)
        return grow_lines(stack, lattice, reaches, most_weight, lines >= least_lines_in_solids, from, count);
    return grow_blocks(stack, lattice, reaches, edge_of_blocks(lattice, std::sqrt(most_weight)), from, count);
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

void grow_rows(const BallRows& rows, double row_pitch, SpanRows& out) {
    // Other layers, of which there are none, lie beyond every disc.
    const double beyond = 2 * std::sqrt(rows.most_weight()) + row_pitch;
    const LayerLattice lattice{row_pitch, beyond, rows.lines()};
    out = std::move(grow_within({&rows}, lattice, BallReaches(lattice, rows.most_weight()), 0, 1).front());
}

void shrink_rows(const SpanRows& rows, double radius, double row_pitch, SpanRows& out) {
    const auto margin = static_cast<std::size_t>(radius / row_pitch);
    SpanRows voids;
    grow_rows(void_of(rows, margin, radius), row_pitch, voids);
    out.clear();
    append_solid(voids, margin, out);
}

GrowingLayers::GrowingLayers(const LayerLattice& lattice, double most_reach)
    : lattice_(lattice),
      ball_(lattice, most_reach * most_reach),
      reach_(lattice.layers_within(most_reach)),
      block_(std::max(edge_of_blocks(lattice, most_reach), least_block)) {}

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
    LayerStack stack;
    for (std::size_t z = 0; z < window; ++z) stack.push_back(&layers_[z]);
    for (SpanRows& layer : grow_within(stack, lattice_, ball_, past_, count))
        done_.push_back(std::move(layer));
    const std::size_t forgotten = past_ + count - std::min(past_ + count, reach_);
    layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(forgotten));
    past_ += count - forgotten;
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
    const SpanRows nothing = empty_rows(lattice_.lines);
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
