// Bracket: the cells of a line among which the tile walk looks for a crossing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace lamella {

/// Search strategy for the cell that holds a crossing.
enum class Search : std::uint8_t {
    chord,   ///< where a straight line through the values at both ends crosses zero
    halves,  ///< halfway
    signs    ///< at quarters; depends on signs only, so values do not decide which of several crossings is
             ///< found
};

/// Cells lo to hi between two samples, with the surface between them, and the values at both ends.
struct Bracket {
    int lo, hi;
    double v_lo, v_hi;

    /// Cell borders to sample next; the same number for every bracket.
    struct Borders {
        std::array<int, 3> at;
        std::size_t count;
    };
    Borders next(Search search) const {
        const int width = hi - lo;
        if (search == Search::signs) return {{lo + width / 4, lo + width / 2, lo + width - width / 4}, 3};
        const double share = v_lo / (v_lo - v_hi);
        const bool between = search == Search::chord && 0 <= share && share <= 1;
        const int guess = between ? std::max(static_cast<int>(width * share), 1) : width / 2;
        const int middle = lo + std::min(guess, width - 1);
        return {{std::max(middle - spread(), lo + 1), std::min(middle + spread() + 1, hi - 1)}, 2};
    }

    /// Returns how far (in cells) the crossing may lie from the chord's border, on either side: a curve
    /// deviates from its chord by an amount that grows with the square of the length.
    int spread() const {
        constexpr std::int64_t straight = 1 << 21;
        const std::int64_t width = hi - lo;
        return static_cast<int>(std::min(width / 16, width * width / straight));
    }

    void take(int border, double value, bool begins_inside) {
        if (border <= lo || hi <= border) return;
        if ((value < 0) == begins_inside) {
            lo = border;
            v_lo = value;
        } else {
            hi = border;
            v_hi = value;
        }
    }
};

}  // namespace lamella
