// CounterHash: counter-based random numbers, a hash of (recipe seed, level, ix, iy, iz, draw) in integer
// arithmetic.
#pragma once

#include <cstdint>

namespace lamella {

/// The SplitMix64 finaliser (Steele, Lea, Flood 2014): a bijection of 64 bits in which every input bit flips
/// about half of the output bits.
constexpr std::uint64_t mix(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
    return v ^ (v >> 31);
}

/// The random numbers of one node. Draws may be requested in any order and by any thread; draw n is always
/// the same.
class CounterHash {
  public:
    constexpr CounterHash(std::uint64_t recipe_seed, int level, std::int64_t x, std::int64_t y,
                          std::int64_t z) {
        state_ = mix(recipe_seed + golden * (static_cast<std::uint64_t>(level) + 1));
        state_ = mix(state_ + golden * static_cast<std::uint64_t>(x));
        state_ = mix(state_ + golden * static_cast<std::uint64_t>(y));
        state_ = mix(state_ + golden * static_cast<std::uint64_t>(z));
    }

    /// Returns 64 random bits.
    constexpr std::uint64_t bits(std::uint64_t draw) const { return mix(state_ + golden * (draw + 1)); }

    /// Returns a uniform number strictly between 0 and 1, at least 2^-33 away from both ends, so that sums of
    /// integers with rounding errors cannot cross the next integer.
    constexpr double uniform(std::uint64_t draw) const {
        return (static_cast<double>(bits(draw) >> 32) + 0.5) * 0x1p-32;
    }

  private:
    static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
    std::uint64_t state_ = 0;
};

}  // namespace lamella
