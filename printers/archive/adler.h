// Adler-32 of a stream joined from pieces (RFC 1950, section 8.2).
#pragma once

#include <cstdint>

namespace lamella {

/// The checksum of one piece of a stream. Pieces are summed independently and joined in order.
class Adler {
  public:
    Adler() = default;
    /// Of `length` bytes: their sum, and the sum of the sums up to each of them.
    Adler(std::uint64_t sum, std::uint64_t sum_of_sums, std::uint64_t length)
        : first_(sum % modulus), second_(sum_of_sums % modulus), length_(length % modulus) {}
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
