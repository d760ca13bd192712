// Blocks of lines, strip by strip; the void in place of the solid.
#include "engine/layer_offset.h"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/error.h"
#include "engine/grown_block.h"
#include "engine/parallel_strips.h"
#include "engine/row_sets.h"

namespace lamella {
namespace {

constexpr std::size_t least_block = 16;  // layers that are finished together

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

/// Lines along the edge of blocks that are best grown together: wide ones share the search for what is near,
/// but what all of their lines have in common is little where balls are small.
std::size_t edge_of_blocks(const LayerLattice& lattice, double reach) {
    constexpr std::size_t least = 1, most = 32;
    return std::clamp(std::bit_floor(lattice.lines_within(reach)), least, most);
}

/// The lines of a block one after another.
void append_lines(const GrownBlock& grown, std::int32_t layer, std::int32_t lines, Run extent,
                  SpanRows& out) {
    for (std::int32_t l = 0; l < lines; ++l) {
        for (const Run& run : grown.line(layer, l)) {
            out.push(run.begin == extent.begin ? -far_out : run.begin,
                     run.end == extent.end ? far_out : run.end);
        }
        out.end_line();
    }
}

/// Grows layers [from, from + count) of a stack, in blocks `edge` lines wide.
std::vector<SpanRows> grow_within(const LayerStack& stack, const LayerLattice& lattice, std::size_t edge,
                                  std::size_t from, std::size_t count) {
    const Run extent = extent_of(stack);
    std::vector<std::vector<SpanRows>> strips((lattice.lines + edge - 1) / edge);  // layer by layer
    oneapi::tbb::enumerable_thread_specific<GrownBlock> blocks(lattice, extent);
    for_all_strips(strips.size(), [&](std::size_t s) {
        GrownBlock& grown = blocks.local();
        const auto line = static_cast<std::int32_t>(s * edge);
        const auto lines = static_cast<std::int32_t>(std::min(edge, lattice.lines - s * edge));
        for (std::size_t z = 0; z < count; z += edge) {
            const auto layers = static_cast<std::int32_t>(std::min(edge, count - z));
            grown.grow({static_cast<std::int32_t>(from + z), line, layers, lines}, stack);
            for (std::int32_t i = 0; i < layers; ++i)
                append_lines(grown, i, lines, extent, strips[s].emplace_back());
        }
    });
    std::vector<SpanRows> layers(count);
    for (std::size_t z = 0; z < count; ++z) {
        for (const std::vector<SpanRows>& strip : strips) layers[z].append_lines(strip[z]);
    }
    return layers;
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
    const LayerLattice lattice{row_pitch, row_pitch, rows.lines()};
    const std::size_t edge = edge_of_blocks(lattice, std::sqrt(rows.most_weight()));
    out = std::move(grow_within({&rows}, lattice, edge, 0, 1).front());
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
      reach_(lattice.layers_within(most_reach)),
      edge_(edge_of_blocks(lattice, most_reach)),
      block_(std::max(edge_, least_block)) {}

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
    for (SpanRows& layer : grow_within(stack, lattice_, edge_, past_, count))
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
