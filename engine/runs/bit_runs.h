// Iteration over the runs of set bits in a word.
#pragma once

#include <bit>
#include <cstdint>

namespace lamella {

/// Calls take(begin, end) for each run of set bits, from the lowest; end is 64 when the highest bit is set.
template <typename Take>
void for_bit_runs(std::uint64_t word, Take take) {
    constexpr int bits = 64;
    for (int at = 0; word != 0;) {
        const int voids = std::countr_zero(word), begin = at + voids;
        const int end = begin + std::countr_one(word >> voids);
        take(begin, end);
        if (end == bits) return;
        word >>= end - at;
        at = end;
    }
}

}  // namespace lamella
