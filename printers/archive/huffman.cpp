// Computes Huffman code lengths in place over sorted frequencies, and the canonical codes.
#include "printers/archive/huffman.h"

#include <algorithm>
#include <array>

namespace lamella {
namespace {

constexpr std::size_t max_symbols = 288;
constexpr int max_depth = 32;

/// Replaces ascending frequencies by the code lengths of an optimal prefix code, in descending order, in the
/// same array (Moffat and Katajainen, "In-place calculation of minimum-redundancy codes", 1995).
void minimum_redundancy(std::span<std::uint64_t> a) {
    const std::size_t n = a.size();
    std::size_t root = 0;
    std::size_t leaf = 0;
    const auto smallest = [&](std::size_t next) {
        if (leaf >= n || (root < next && a[root] < a[leaf])) {
            const std::uint64_t weight = a[root];
            a[root++] = next;  // from here on the index of the parent
            return weight;
        }
        return a[leaf++];
    };
    for (std::size_t next = 0; next + 1 < n; ++next) {
        const std::uint64_t first = smallest(next);
        a[next] = first + smallest(next);
    }
    a[n - 2] = 0;
    for (std::size_t i = n - 2; i-- > 0;) a[i] = a[static_cast<std::size_t>(a[i])] + 1;

    std::size_t available = 1;
    std::uint64_t depth = 0;
    std::size_t inner = n - 1;  // inner nodes not yet visited, counted from the root down
    std::size_t next = n;
    while (available > 0) {
        std::size_t used = 0;
        while (inner > 0 && a[inner - 1] == depth) {
            ++used;
            --inner;
        }
        for (; available > used; --available) a[--next] = depth;
        available = 2 * used;
        ++depth;
    }
}

/// Shortens codes longer than `limit` and lengthens others until the Kraft sum is one again.
void enforce_limit(std::array<int, max_depth + 1>& count, int limit) {
    for (int depth = limit + 1; depth <= max_depth; ++depth) {
        count[static_cast<std::size_t>(limit)] += count[static_cast<std::size_t>(depth)];
        count[static_cast<std::size_t>(depth)] = 0;
    }
    std::int64_t kraft = 0;
    for (int depth = 1; depth <= limit; ++depth) {
        kraft += std::int64_t{count[static_cast<std::size_t>(depth)]} << (limit - depth);
    }
    for (; kraft > std::int64_t{1} << limit; --kraft) {
        --count[static_cast<std::size_t>(limit)];
        for (int depth = limit - 1; depth > 0; --depth) {
            if (count[static_cast<std::size_t>(depth)] == 0) continue;
            --count[static_cast<std::size_t>(depth)];
            count[static_cast<std::size_t>(depth) + 1] += 2;
            break;
        }
    }
}

}  // namespace

void huffman_lengths(std::span<const std::uint32_t> frequencies, int limit, std::span<std::uint8_t> lengths) {
    std::fill(lengths.begin(), lengths.end(), std::uint8_t{0});
    // A key holds frequency and symbol, so that equal frequencies are ordered by symbol.
    std::array<std::uint64_t, max_symbols> keys;
    std::size_t used = 0;
    for (std::size_t s = 0; s < frequencies.size(); ++s) {
        if (frequencies[s] > 0) keys[used++] = std::uint64_t{frequencies[s]} << 16 | s;
    }
    if (used == 0) return;
    if (used == 1) {
        lengths[keys[0] & 0xffff] = 1;
        return;
    }
    std::sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(used));
    std::array<std::uint64_t, max_symbols> work;
    for (std::size_t i = 0; i < used; ++i) work[i] = keys[i] >> 16;
    minimum_redundancy({work.data(), used});

    std::array<int, max_depth + 1> count{};
    for (std::size_t i = 0; i < used; ++i)
        ++count[static_cast<std::size_t>(std::min<std::uint64_t>(work[i], max_depth))];
    enforce_limit(count, limit);
    std::size_t i = 0;  // the rarest symbols get the longest codes
    for (int depth = limit; depth > 0; --depth) {
        for (int k = count[static_cast<std::size_t>(depth)]; k > 0; --k) {
            lengths[keys[i++] & 0xffff] = static_cast<std::uint8_t>(depth);
        }
    }
}

void huffman_codes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes) {
    std::array<std::uint32_t, 17> count{};
    for (const std::uint8_t length : lengths) ++count[length];
    count[0] = 0;
    std::array<std::uint32_t, 17> next{};
    for (std::size_t bits = 1; bits < next.size(); ++bits) {
        next[bits] = (next[bits - 1] + count[bits - 1]) << 1;
    }
    for (std::size_t s = 0; s < lengths.size(); ++s) {
        const std::uint8_t length = lengths[s];
        std::uint32_t code = length > 0 ? next[length]++ : 0;
        std::uint32_t reversed = 0;
        for (std::uint8_t bit = 0; bit < length; ++bit, code >>= 1) reversed = reversed << 1 | (code & 1);
        codes[s] = static_cast<std::uint16_t>(reversed);
    }
}

}  // namespace lamella
