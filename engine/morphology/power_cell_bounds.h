// PowerCellBounds: on which lines a dilated run can be visible, from the half-space power cells of its
// neighbours (Chen et al. 2018).
#pragma once

#include <algorithm>
#include <cstdint>

namespace lamella {

/// The four lines next to a line of a stack of layers.
enum class Neighbor : std::uint8_t { line_before, line_behind, layer_below, layer_above };

/// The position of a block of lines relative to a source line: lower bounds on its distance, in lines or
/// layers, towards each side. Several sides are combined by `|`.
class BlockOffset {
  public:
    constexpr BlockOffset(Neighbor side, std::int32_t lines)
        : bits_(static_cast<std::uint64_t>(std::clamp(lines, 0, 127)) * each_end
                << 8 * static_cast<int>(side)) {}
    constexpr BlockOffset operator|(BlockOffset other) const { return BlockOffset(bits_ | other.bits_); }
    constexpr std::uint64_t bits() const { return bits_; }

  private:
    static constexpr std::uint64_t each_end = 0x1'0000'0001;  // both halves of a PowerCellBounds
    explicit constexpr BlockOffset(std::uint64_t bits) : bits_(bits) {}
    std::uint64_t bits_;
};

/// For each half of a run, from its middle to an end, how many lines away to each side its dilation may be
/// visible, that is, cover points that no other run covers. Farther away, a run on the adjacent line that
/// reaches over the middle covers the whole half, because it is nearer. These are half-space Voronoi cells
/// (thesis 3.2; Chen, Panozzo and Dumas 2018), bounded by boxes. Packed into a word: a byte for each half and
/// side.
class PowerCellBounds {
  public:
    static constexpr std::uint8_t unlimited = 127;

    /// Sets how many lines away the two halves are visible on one side, at most `unlimited`.
    void limit(Neighbor side, std::uint8_t lines_of_begin, std::uint8_t lines_of_end) {
        const int shift = 8 * static_cast<int>(side);
        constexpr std::uint64_t both = 0xff'0000'00ff;
        bits_ = (bits_ & ~(both << shift)) | (std::uint64_t{lines_of_end} << 32 | lines_of_begin) << shift;
    }
    /// Returns true if a half of the run may be visible on a block of lines at that offset.
    bool reaches(BlockOffset lines) const {
        const std::uint64_t within = (bits_ | begins | ends) - lines.bits();  // no borrow from byte to byte
        // Without a branch, for loops over many runs.
        return static_cast<bool>(static_cast<int>((within & begins) == begins) |
                                 static_cast<int>((within & ends) == ends));
    }

  private:
    static constexpr std::uint64_t begins = 0x80808080, ends = begins << 32;
    std::uint64_t bits_ = 0x7f7f7f7f7f7f7f7f;
};

}  // namespace lamella
