// Encodes runs as steps, and steps as one dynamic Huffman block.
#include "printers/archive/deflate_runs.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/base/error.h"
#include "printers/archive/bit_writer.h"
#include "printers/archive/deflate_steps.h"
#include "printers/archive/huffman.h"

namespace lamella {
namespace {

constexpr std::size_t end_of_block = 256;
constexpr std::size_t literal_symbols = 286;
constexpr std::size_t distance_symbols = 30;

/// A deflate symbol and its extra bits.
struct Symbol {
    std::uint16_t symbol;
    std::uint8_t extra_bits;
    std::uint16_t extra;
};

/// Symbols of match lengths 3 to 258 (RFC 1951, section 3.2.5), indexed by length.
constexpr std::array<Symbol, max_match + 1> make_length_symbols() {
    std::array<Symbol, max_match + 1> table{};
    std::uint32_t length = min_match;
    for (std::uint16_t code = 0; code < 28; ++code) {
        const auto extra_bits = static_cast<std::uint8_t>(code < 8 ? 0 : code / 4 - 1);
        for (std::uint16_t extra = 0; extra < 1 << extra_bits && length <= max_match; ++extra) {
            table[length++] = {static_cast<std::uint16_t>(257 + code), extra_bits, extra};
        }
    }
    table[max_match] = {285, 0, 0};
    return table;
}
constexpr auto length_symbols = make_length_symbols();

Symbol distance_symbol(std::uint32_t distance) {
    const std::uint32_t d = distance - 1;
    if (d < 4) return {static_cast<std::uint16_t>(d), 0, 0};
    std::uint32_t bits = 1;  // number of extra bits: two less than the bits of d
    while (d >> (bits + 2) != 0) ++bits;
    const std::uint32_t half = d >> bits & 1;
    return {static_cast<std::uint16_t>(2 * (bits + 1) + half), static_cast<std::uint8_t>(bits),
            static_cast<std::uint16_t>(d & ((1U << bits) - 1))};
}

/// Returns the checksum of a row of `row_bytes` bytes: 0, then the runs.
Adler sum_row(std::span<const GreyRun> runs, std::uint32_t row_bytes) {
    // The second sum counts each byte as often as there are bytes from it to the end. For n bytes of which
    // the first is followed by k - 1 others, that is (2 k - n + 1) / 2 times on average.
    std::uint64_t first = 0, twice_second = 0;
    std::uint64_t left = row_bytes - 1;
    for (const GreyRun& run : runs) {
        const std::uint64_t sum = std::uint64_t{run.length} * static_cast<std::uint8_t>(run.value);
        first += sum;
        twice_second += sum * (2 * left - run.length + 1);
        left -= run.length;
    }
    return {first, twice_second / 2, row_bytes};
}

/// Calls row(runs) for each row. Throws FaultError unless each row has `width` pixels.
template <typename Row>
void visit_rows(std::span<const GreyRun> runs, std::uint32_t width, int rows, Row row) {
    std::size_t next = 0;
    for (int r = 0; r < rows; ++r) {
        const std::size_t first = next;
        std::uint64_t pixels = 0;
        while (next < runs.size() && pixels < width) pixels += runs[next++].length;
        if (pixels != width) {
            throw FaultError("row " + std::to_string(r) + " of a band of pixels has " +
                             std::to_string(pixels) + " pixels instead of " + std::to_string(width));
        }
        row(runs.subspan(first, next - first));
    }
    while (next < runs.size() && runs[next].length == 0) ++next;
    if (next != runs.size()) {
        throw FaultError("a band of pixels has more than its " + std::to_string(rows) + " rows");
    }
}

/// A symbol of the code that transmits the code lengths (RFC 1951, section 3.2.7).
struct LengthStep {
    std::uint8_t symbol;
    std::uint8_t extra;
};
constexpr std::array<std::uint8_t, 19> length_step_bits = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                                           0, 0, 0, 0, 0, 0, 2, 3, 7};

std::vector<LengthStep> length_steps(std::span<const std::uint8_t> lengths) {
    std::vector<LengthStep> steps;
    for (std::size_t i = 0; i < lengths.size();) {
        const std::uint8_t length = lengths[i];
        std::size_t same = 1;
        while (i + same < lengths.size() && lengths[i + same] == length) ++same;
        i += same;
        if (length > 0) {
            steps.push_back({length, 0});
            --same;
        }
        while (same >= 3) {
            const std::size_t most = length > 0 ? 6 : 138;
            const std::size_t piece = std::min(same, most);
            if (length > 0) {
                steps.push_back({16, static_cast<std::uint8_t>(piece - 3)});
            } else if (piece <= 10) {
                steps.push_back({17, static_cast<std::uint8_t>(piece - 3)});
            } else {
                steps.push_back({18, static_cast<std::uint8_t>(piece - 11)});
            }
            same -= piece;
        }
        steps.insert(steps.end(), same, {length, 0});
    }
    return steps;
}

/// The Huffman codes of a block.
struct BlockCodes {
    std::array<std::uint8_t, literal_symbols> literal_lengths{};
    std::array<std::uint16_t, literal_symbols> literal_codes{};
    std::array<std::uint8_t, distance_symbols> distance_lengths{};
    std::array<std::uint16_t, distance_symbols> distance_codes{};
};

void write_header(const BlockCodes& codes, BitWriter& bits) {
    static constexpr std::array<std::uint8_t, 19> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                           11, 4,  12, 3, 13, 2, 14, 1, 15};
    const auto used = [](std::span<const std::uint8_t> lengths, std::size_t least) {
        std::size_t count = lengths.size();
        while (count > least && lengths[count - 1] == 0) --count;
        return count;
    };
    const std::size_t literals = used(codes.literal_lengths, 257);
    const std::size_t distances = used(codes.distance_lengths, 1);
    std::vector<std::uint8_t> lengths(codes.literal_lengths.begin(),
                                      codes.literal_lengths.begin() + static_cast<std::ptrdiff_t>(literals));
    lengths.insert(lengths.end(), codes.distance_lengths.begin(),
                   codes.distance_lengths.begin() + static_cast<std::ptrdiff_t>(distances));
    const std::vector<LengthStep> steps = length_steps(lengths);

    std::array<std::uint32_t, 19> frequencies{};
    for (const LengthStep& step : steps) ++frequencies[step.symbol];
    std::array<std::uint8_t, 19> step_lengths;
    std::array<std::uint16_t, 19> step_codes;
    huffman_lengths(frequencies, 7, step_lengths);
    huffman_codes(step_lengths, step_codes);
    std::size_t sent = order.size();
    while (sent > 4 && step_lengths[order[sent - 1]] == 0) --sent;

    bits.put(0b100, 3);  // not the last block; dynamic codes
    bits.put(literals - 257, 5);
    bits.put(distances - 1, 5);
    bits.put(sent - 4, 4);
    for (std::size_t i = 0; i < sent; ++i) bits.put(step_lengths[order[i]], 3);
    for (const LengthStep& step : steps) {
        bits.put(step_codes[step.symbol], step_lengths[step.symbol]);
        bits.put(step.extra, length_step_bits[step.symbol]);
    }
}

/// Number of occurrences of each step.
using StepCounts = std::array<std::uint32_t, step_kinds>;

StepCounts count_steps(std::span<const Step> steps) {
    StepCounts counts{};
    for (const Step step : steps) ++counts[step];
    return counts;
}

/// The deflate symbols of a match.
struct Match {
    Symbol length;
    Symbol distance;
};

/// Calls literal(step) and match(step, symbols) for all steps that occur.
template <typename Literal, typename OnMatch>
void visit_steps(const StepCounts& counts, std::uint32_t row_bytes, Literal literal, OnMatch match) {
    for (Step value = 0; value < 256; ++value) {
        if (counts[value] > 0) literal(value);
    }
    // If a row is too long to be copied, the second distance stays unused.
    const Symbol byte_back = distance_symbol(1),
                 row_back = distance_symbol(std::min(row_bytes, max_distance));
    for (std::uint32_t length = min_match; length <= max_match; ++length) {
        const Step repeat = repeat_step(length), copy = copy_step(length);
        if (counts[repeat] > 0) match(repeat, Match{length_symbols[length], byte_back});
        if (counts[copy] > 0) match(copy, Match{length_symbols[length], row_back});
    }
}

BlockCodes make_codes(const StepCounts& counts, std::uint32_t row_bytes) {
    std::array<std::uint32_t, literal_symbols> literal_count{};
    std::array<std::uint32_t, distance_symbols> distance_count{};
    literal_count[end_of_block] = 1;
    visit_steps(
        counts, row_bytes, [&](Step value) { literal_count[value] = counts[value]; },
        [&](Step step, const Match& match) {
            literal_count[match.length.symbol] += counts[step];
            distance_count[match.distance.symbol] += counts[step];
        });
    BlockCodes codes;
    huffman_lengths(literal_count, 15, codes.literal_lengths);
    huffman_codes(codes.literal_lengths, codes.literal_codes);
    huffman_lengths(distance_count, 15, codes.distance_lengths);
    huffman_codes(codes.distance_lengths, codes.distance_codes);
    return codes;
}

/// The bits that encode a step.
struct StepBits {
    std::uint64_t bits = 0;
    unsigned count = 0;

    void add(std::uint64_t more, unsigned more_count) {
        bits |= more << count;
        count += more_count;
    }
};

/// Returns the bits of all steps that occur; the others have none.
std::array<StepBits, step_kinds> step_bits(const StepCounts& counts, std::uint32_t row_bytes,
                                           const BlockCodes& codes) {
    std::array<StepBits, step_kinds> table{};
    visit_steps(
        counts, row_bytes,
        [&](Step value) { table[value].add(codes.literal_codes[value], codes.literal_lengths[value]); },
        [&](Step step, const Match& match) {
            StepBits& bits = table[step];
            bits.add(codes.literal_codes[match.length.symbol], codes.literal_lengths[match.length.symbol]);
            bits.add(match.length.extra, match.length.extra_bits);
            bits.add(codes.distance_codes[match.distance.symbol],
                     codes.distance_lengths[match.distance.symbol]);
            bits.add(match.distance.extra, match.distance.extra_bits);
        });
    return table;
}

}  // namespace

void compress_band(std::span<const GreyRun> runs, int width, int rows, std::vector<std::byte>& out,
                   Adler& adler) {
    if (width < 1 || width > 65535 || rows < 1 || rows > 4096) {
        throw FaultError("a band of pixels is 1 to 65535 wide and 1 to 4096 high");
    }
    const auto row_bytes = static_cast<std::uint32_t>(width) + 1;
    StepWriter writer(row_bytes);
    Adler sum;
    visit_rows(runs, row_bytes - 1, rows, [&](std::span<const GreyRun> row) {
        writer.row(row);
        sum.append(sum_row(row, row_bytes));
    });
    adler.append(sum);

    const std::span<const Step> steps = writer.finish();
    const StepCounts counts = count_steps(steps);
    const BlockCodes codes = make_codes(counts, row_bytes);
    const std::array<StepBits, step_kinds> table = step_bits(counts, row_bytes, codes);
    std::uint64_t size = 0;  // bits
    for (std::size_t step = 0; step < step_kinds; ++step)
        size += std::uint64_t{counts[step]} * table[step].count;
    constexpr std::size_t header_bytes = 1024;
    BitWriter bits(out, static_cast<std::size_t>(size / 8) + header_bytes);
    write_header(codes, bits);
    for (const Step step : steps) bits.put(table[step].bits, table[step].count);
    bits.put(codes.literal_codes[end_of_block], codes.literal_lengths[end_of_block]);
    bits.put(0, 3);  // an empty stored block, which ends on a byte boundary
    bits.align();
    bits.put(0xffff0000, 32);
    bits.finish();
}

void deflate_end(std::vector<std::byte>& out) {
    // The final block with the fixed codes: 1, then 01, then the seven zeros of the end of block.
    out.push_back(std::byte{3});
    out.push_back(std::byte{0});
}

}  // namespace lamella
