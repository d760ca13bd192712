// WindowDifference: the difference |d|^q between windows of bytes, summed in whole numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lamella {

/// The difference between a window of a target and windows of an exemplar: the sum over pixels of |d|^q,
/// d in 0 to 255. |d|^q is replaced by a broken line with corners at multiples of 16, on a whole number of
/// steps: sixteen entries fit the table look-up of all SIMD targets, and whole sums are the same in any
/// order. The line is within 0.003 of 255^q of |d|^q.
class WindowDifference {
  public:
    /// Windows of `size` x `size` pixels. Throws InputError unless 1 <= exponent <= 2 and 1 <= size <= 64.
    WindowDifference(int size, double exponent);

    int size() const { return size_; }
    /// Returns the bytes that a row of a window takes: the size, rounded up to a multiple of 16. What is
    /// beyond the size is zero in all windows.
    std::size_t row_bytes() const { return row_bytes_; }
    std::size_t window_bytes() const { return row_bytes_ * static_cast<std::size_t>(size_); }
    /// Returns the broken line at a difference of d.
    std::uint32_t of(unsigned d) const { return bases_[d / 16] + slopes_[d / 16] * (d % 16); }
    /// Returns how many steps are a difference of 255^q: divide by it to get differences of values in [0, 1].
    double unit() const { return unit_; }

    /// Returns all rows of `size` pixels of an image, as windows need them: those that begin in column 0,
    /// from the first row to the last, then those of column 1, and so on. The window at (x, y) begins at
    /// window_begin(x, y, height).
    std::vector<std::uint8_t> all_rows(std::span<const std::uint8_t> image, int width, int height) const;
    std::size_t window_begin(int x, int y, int height) const {
        return (static_cast<std::size_t>(x) * static_cast<std::size_t>(height) +
                static_cast<std::size_t>(y)) *
               row_bytes_;
    }

    /// Computes the difference between the window of window_bytes() at `window` and those that begin at
    /// rows[begins[i]]. By SIMD; the same numbers on every target.
    void differences(const std::uint8_t* window, const std::uint8_t* rows,
                     std::span<const std::size_t> begins, std::uint32_t* out) const;

  private:
    friend struct DifferenceTables;
    int size_;
    std::size_t row_bytes_;
    double unit_ = 1;
    std::array<std::uint32_t, 16> bases_{};   ///< the line at multiples of 16, below 2^16
    std::array<std::uint32_t, 16> slopes_{};  ///< of the line after them, below 2^8
};

}  // namespace lamella
