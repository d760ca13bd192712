// The cells of a line among which the tile walk looks for a crossing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace lamella {

/// How the cell of a crossing is looked for.
enum class Search : std::uint8_t {
    chord,   ///< where a straight line through the values at the ends crosses
    halves,  ///< halfway
    signs    ///< at quarters: which of several crossings is found hangs on no values but on their signs
};

/// Cells lo to hi of a pair, between which the surface passes, and the values there.
struct Bracket {
    int lo, hi;
    double v_lo, v_hi;

    /// Borders to try next; as many for every bracket.
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

    /// How far to either side of a border on the chord the crossing may well lie: what a curve bends away
    /// from its chord grows with the square of the length.
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
