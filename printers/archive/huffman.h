// Length-limited Huffman codes in the canonical form of deflate (RFC 1951, section 3.2.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lamella {

/// Computes code lengths of at most `limit` bits for the given symbol frequencies. Symbols of frequency 0 get
/// length 0, a lone symbol gets length 1. The code is optimal if the limit does not bind (Moffat and
/// Katajainen 1995), and near-optimal otherwise. At most 288 symbols, of which at most 2^limit are used.
void huffman_lengths(std::span<const std::uint32_t> frequencies, int limit, std::span<std::uint8_t> lengths);

/// Computes the canonical codes of these lengths, bit-reversed as deflate sends them.
void huffman_codes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes);

}  // namespace lamella
