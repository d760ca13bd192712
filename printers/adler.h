// Adler-32 of runs of equal bytes in closed form, and of a stream joined from pieces (RFC 1950, section 8.2).
#pragma once

#include <cstdint>

namespace lamella {

/// The checksum of one piece of a stream. Pieces are summed independently and joined in order.
class Adler {
  public:
    /// Adds `count` bytes of one value.
    void append_run(std::uint64_t count, std::uint8_t value) {
        for (; count > most_pending; count -= most_pending) append_run(most_pending, value);
        pending_ += count;
        if (pending_ > most_pending) {
            reduce();
            pending_ = count;
        }
        // A byte that stands k places before the end counts k times in the second sum.
        second_ += count * first_ + count * (count + 1) / 2 * value;
        first_ += count * value;
        length_ += count;
    }
    /// Adds the piece that follows this one.
    void append(Adler next) {
        reduce();
        next.reduce();
        second_ = (second_ + next.second_ + next.length_ * first_) % modulus;
        first_ = (first_ + next.first_) % modulus;
        length_ = (length_ + next.length_) % modulus;
    }
    /// The checksum when this piece is the whole stream.
    std::uint32_t value() const {
        const std::uint64_t first = (1 + first_) % modulus;
        const std::uint64_t second = (second_ % modulus + length_) % modulus;
        return static_cast<std::uint32_t>(second << 16 | first);
    }

  private:
    static constexpr std::uint64_t modulus = 65521;
    // With so few bytes since the last reduction, the second sum stays below 2^50.
    static constexpr std::uint64_t most_pending = 1 << 20;

    void reduce() {
        first_ %= modulus;
        second_ %= modulus;
        length_ %= modulus;
        pending_ = 0;
    }

    std::uint64_t first_ = 0;   // sum of the bytes
    std::uint64_t second_ = 0;  // sum of the running sums, started from 0
    std::uint64_t length_ = 0;
    std::uint64_t pending_ = 0;  // bytes since the sums were last reduced
};

}  // namespace lamella
