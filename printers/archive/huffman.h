// Length-limited Huffman codes in the canonical form that deflate wants (RFC 1951, section 3.2.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lamella {

/// Code lengths for the given symbol frequencies, none longer than `limit` bits; symbols of frequency 0 get
/// length 0, a lone symbol gets length 1. Optimal when the limit does not bind (Moffat and Katajainen 1995),
/// near it otherwise. At most 288 symbols, and no more used ones than 2^limit.
void huffman_lengths(std::span<const std::uint32_t> frequencies, int limit, std::span<std::uint8_t> lengths);

/// The canonical codes of these lengths, bit-reversed as deflate sends them.
void huffman_codes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes);

}  // namespace lamella
