// How far runs beside a gap reach into it on the lines of a small block, once they are grown by balls.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/block_reaches.h"

namespace lamella {

/// A run that may reach into a gap of a block, run units.
struct GapSource {
    std::int32_t begin, end;
    double weight;             ///< as of BallRun
    std::int32_t layer, line;  ///< where it lies
    std::int32_t most;         ///< how far it reaches on lines of the block, at most
};

/// What is left of a gap on each line of a block, when runs beside it and in it have grown by balls. Blocks
/// are `edge` layers of as many lines at most.
class GapLimits {
  public:
    static constexpr std::int32_t edge = BallReaches::edge;
    static constexpr std::size_t lines = static_cast<std::size_t>(edge) * edge;

    /// Begins with the whole gap.
    void begin(const LineBlock& block, Run gap);
    /// Grows runs that begin left of the gap or where it begins. Those that reach far had better come first.
    /// `reaches` are those of most of the runs.
    void grow_left(const LayerLattice& lattice, const BallReaches& reaches, const LineBlock& block,
                   std::span<const GapSource> sources);
    /// The same of those that end right of it.
    void grow_right(const LayerLattice& lattice, const BallReaches& reaches, const LineBlock& block,
                    std::span<const GapSource> sources);
    /// Grows runs within the gap. Those that then reach neither side are added to a list for each line.
    void grow_within(const LayerLattice& lattice, const BallReaches& reaches, const LineBlock& block,
                     std::span<const GapSource> sources, std::array<std::vector<Run>, lines>& islands);
    /// What is left of it on a line, counted from the block's first; nothing where it ends before it begins.
    Run at(std::int32_t layer, std::int32_t line) const {
        const std::size_t i = place(layer, line);
        return {begins_[i], -ends_[i]};
    }

    /// Of a line, counted from the block's first, among `lines`.
    static std::size_t place(std::int32_t layer, std::int32_t line) {
        return static_cast<std::size_t>(layer) * edge + static_cast<std::size_t>(line);
    }

  private:
    alignas(64) std::array<std::int32_t, lines> begins_;
    alignas(64) std::array<std::int32_t, lines> ends_;  // below zero, so that both grow
};

}  // namespace lamella
