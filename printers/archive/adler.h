// Adler: Adler-32 checksum of a stream that is joined from pieces (RFC 1950, section 8.2).
#pragma once

#include <cstdint>

namespace lamella {

/// Checksum of one piece of a stream. Pieces are summed independently and joined in order.
class Adler {
  public:
    Adler() = default;
    /// Builds the checksum of `length` bytes from their sum and from the sum of their running sums.
    Adler(std::uint64_t sum, std::uint64_t sum_of_sums, std::uint64_t length)
        : first_(sum % modulus), second_(sum_of_sums % modulus), length_(length % modulus) {}
    /// Appends the checksum of the next piece.
    void append(const Adler& next) {
        second_ = (second_ + next.second_ + next.length_ * first_) % modulus;
        first_ = (first_ + next.first_) % modulus;
        length_ = (length_ + next.length_) % modulus;
    }
    /// Returns the Adler-32 value if this piece is the whole stream.
    std::uint32_t value() const {
        const std::uint64_t first = (1 + first_) % modulus;
        const std::uint64_t second = (second_ + length_) % modulus;
        return static_cast<std::uint32_t>(second << 16 | first);
    }

  private:
    static constexpr std::uint64_t modulus = 65521;

    std::uint64_t first_ = 0;   // sum of the bytes
    std::uint64_t second_ = 0;  // sum of the running sums, starting from 0
    std::uint64_t length_ = 0;
};

}  // namespace lamella
