// Adler-32 of runs of equal bytes in closed form, and of a stream joined from pieces (RFC 1950, section 8.2).
#pragma once

#include <cstdint>

namespace lamella {

/// The checksum of one piece of a stream. Pieces are summed independently and joined in order.
class Adler {
  public:
    /// Adds `count` bytes of one value; count < 2^31.
    void append_run(std::uint64_t count, std::uint8_t value) {
        // A byte that stands k places before the end counts k times in the second sum.
        second_ = (second_ + count * first_ + count * (count + 1) / 2 % modulus * value) % modulus;
        first_ = (first_ + count * value) % modulus;
        length_ = (length_ + count) % modulus;
    }
    /// Adds the piece that follows this one.
    void append(const Adler& next) {
        second_ = (second_ + next.second_ + next.length_ * first_) % modulus;
        first_ = (first_ + next.first_) % modulus;
        length_ = (length_ + next.length_) % modulus;
    }
    /// The checksum when this piece is the whole stream.
    std::uint32_t value() const {
        const std::uint64_t first = (1 + first_) % modulus;
        const std::uint64_t second = (second_ + length_) % modulus;
        return static_cast<std::uint32_t>(second << 16 | first);
    }

  private:
    static constexpr std::uint64_t modulus = 65521;
    std::uint64_t first_ = 0;   // sum of the bytes
    std::uint64_t second_ = 0;  // sum of the running sums, started from 0
    std::uint64_t length_ = 0;
};

}  // namespace lamella
