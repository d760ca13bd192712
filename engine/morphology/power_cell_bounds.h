// PowerCellBounds: on which lines a dilated run can be visible, from the half-space power cells of its
// neighbours (Chen et al. 2018).
#pragma once

#include <algorithm>
#include <cstdint>

namespace lamella {

/// The ways from a line of a stack of layers to those beside it.
enum class Neighbor : std::uint8_t { line_before, line_behind, layer_below, layer_above };

/// Where lines lie, seen from another one: so many lines to each side, at least.
class BlockOffset {
  public:
    constexpr BlockOffset(Neighbor side, std::int32_t lines)
        : bits_(static_cast<std::uint64_t>(std::clamp(lines, 0, 127)) * each_end
                << 8 * static_cast<int>(side)) {}
    constexpr BlockOffset operator|(BlockOffset other) const { return BlockOffset(bits_ | other.bits_); }
    constexpr std::uint64_t bits() const { return bits_; }

  private:
    static constexpr std::uint64_t each_end = 0x1'0000'0001;  // of a PowerCellBounds
    explicit constexpr BlockOffset(std::uint64_t bits) : bits_(bits) {}
    std::uint64_t bits_;
};

/// The lines on which each half of a grown run, from its middle to an end, may cover what nothing else does:
/// as many to each side. Beyond, a run beside it that reaches over its middle covers all of that half, as it
/// lies nearer: half-space Voronoi cells (thesis 3.2; Chen, Panozzo and Dumas 2018), bounded by boxes.
class PowerCellBounds {
  public:
    static constexpr std::uint8_t unlimited = 127;

    /// Limits what can be seen on one side.
    void limit(Neighbor side, std::uint8_t lines_of_begin, std::uint8_t lines_of_end) {
        const int shift = 8 * static_cast<int>(side);
        constexpr std::uint64_t both = 0xff'0000'00ff;
        bits_ = (bits_ & ~(both << shift)) | (std::uint64_t{lines_of_end} << 32 | lines_of_begin) << shift;
    }
    /// Whether any half of it may matter on lines that lie there.
    bool reaches(BlockOffset lines) const {
        const std::uint64_t within = (bits_ | begins | ends) - lines.bits();  // no borrow from byte to byte
        // Not a choice between ways: loops over many runs had better have none.
        return static_cast<bool>(static_cast<int>((within & begins) == begins) |
                                 static_cast<int>((within & ends) == ends));
    }

  private:
    static constexpr std::uint64_t begins = 0x80808080, ends = begins << 32;
    std::uint64_t bits_ = 0x7f7f7f7f7f7f7f7f;
};

}  // namespace lamella
