// BitWriter: packs bits into bytes, the lowest first, in the order of deflate.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace lamella {

/// Appends bits to a byte vector. The vector has its final size after `finish`.
class BitWriter {
  public:
    /// `most` is an upper bound of the bytes that will be written.
    BitWriter(std::vector<std::byte>& out, std::size_t most) : out_(out), start_(out.size()) {
        out_.resize(start_ + most + sizeof buffer_);
        next_ = out_.data() + start_;
    }
    /// Appends the low `count` bits of `bits`; the other bits must be 0, count <= 48.
    void put(std::uint64_t bits, unsigned count) {
        buffer_ |= bits << filled_;
        filled_ += count;
        // Always stores all eight bytes, although only the full ones count: one store and no branch.
        if constexpr (std::endian::native == std::endian::little) {
            std::memcpy(next_, &buffer_, sizeof buffer_);
        } else {
            for (std::size_t i = 0; i < sizeof buffer_; ++i)
                next_[i] = static_cast<std::byte>(buffer_ >> 8 * i);
        }
        const unsigned whole = filled_ / 8;
        next_ += whole;
        buffer_ >>= 8 * whole;
        filled_ %= 8;
    }
    void align() {
        if (filled_ > 0) put(0, 8 - filled_);
    }
    void finish() { out_.resize(static_cast<std::size_t>(next_ - out_.data())); }

  private:
    std::vector<std::byte>& out_;
    std::size_t start_;
    std::byte* next_;
    std::uint64_t buffer_ = 0;
    unsigned filled_ = 0;
};

}  // namespace lamella
