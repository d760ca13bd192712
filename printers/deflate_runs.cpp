// Runs to tokens, tokens to one dynamic Huffman block.
#include "printers/deflate_runs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

#include "engine/error.h"
#include "printers/huffman.h"

namespace lamella {
namespace {

constexpr std::size_t end_of_block = 256;
constexpr std::size_t literal_symbols = 286;
constexpr std::size_t distance_symbols = 30;
constexpr std::uint32_t min_match = 3;
constexpr std::uint32_t max_match = 258;
constexpr std::uint32_t max_distance = 32768;

/// `count` bytes: all equal to `value`, or a copy of what stands one row back.
struct Token {
    std::uint32_t count;
    std::uint8_t value;
    bool copy;
};

/// A deflate symbol with the extra bits that follow it.
struct Symbol {
    std::uint16_t symbol;
    std::uint8_t extra_bits;
    std::uint16_t extra;
};

/// Symbols of match lengths 3 to 258 (RFC 1951, section 3.2.5), indexed by the length.
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
    std::uint32_t bits = 1;  // extra bits: two less than the bits of d
    while (d >> (bits + 2) != 0) ++bits;
    const std::uint32_t half = d >> bits & 1;
    return {static_cast<std::uint16_t>(2 * (bits + 1) + half), static_cast<std::uint8_t>(bits),
            static_cast<std::uint16_t>(d & ((1U << bits) - 1))};
}

/// Calls match(length) for pieces of 3 to 258 bytes that sum to `count`, which is at least 3.
template <typename Match>
void split_match(std::uint32_t count, Match match) {
    for (; count >= max_match + min_match; count -= max_match) match(max_match);
    if (count > max_match) {
        match(max_match - min_match);
        count -= max_match - min_match;
    }
    match(count);
}

/// Calls literal(value) and match(length, copy) for the symbols of a token.
template <typename Literal, typename Match>
void expand(const Token& token, Literal literal, Match match) {
    if (token.copy) {
        split_match(token.count, [&](std::uint32_t length) { match(length, true); });
        return;
    }
    literal(token.value);
    const std::uint32_t rest = token.count - 1;
    if (rest >= min_match) {
        split_match(rest, [&](std::uint32_t length) { match(length, false); });
    } else {
        for (std::uint32_t i = 0; i < rest; ++i) literal(token.value);
    }
}

/// Turns the rows of a band into tokens and sums their bytes.
class Tokenizer {
  public:
    Tokenizer(std::uint32_t width, std::vector<Token>& tokens, Adler& adler)
        : width_(width), tokens_(tokens), adler_(adler) {}

    void row(std::span<const GreyRun> runs) {
        // A copied row costs its matches of 258 bytes; a row of few runs is no dearer written out.
        const bool worth_copying = runs.size() > 4 + (width_ + 1) / max_match;
        if (worth_copying && width_ + 1 <= max_distance && std::ranges::equal(runs, previous_)) {
            copy(runs);
        } else {
            put(1, 0);  // the filter byte: none
            for (const GreyRun& run : runs) put(run.length, static_cast<std::uint8_t>(run.value));
        }
        previous_ = runs;
    }

    void finish() { flush(); }

  private:
    void put(std::uint32_t count, std::uint8_t value) {
        if (value == open_.value) {
            open_.count += count;
        } else if (count > 0) {
            flush();
            open_ = {count, value, false};
        }
    }
    void flush() {
        if (open_.count == 0) return;
        adler_.append_run(open_.count, open_.value);
        tokens_.push_back(open_);
        open_.count = 0;
    }
    void copy(std::span<const GreyRun> runs) {
        flush();
        adler_.append_run(1, 0);
        for (const GreyRun& run : runs) adler_.append_run(run.length, static_cast<std::uint8_t>(run.value));
        if (tokens_.back().copy) {
            tokens_.back().count += width_ + 1;
        } else {
            tokens_.push_back({width_ + 1, 0, true});
        }
    }

    std::uint32_t width_;
    std::vector<Token>& tokens_;
    Adler& adler_;
    Token open_{0, 0, false};
    std::span<const GreyRun> previous_;
};

/// Cuts the runs into rows, checking that each has `width` pixels.
void tokenize(std::span<const GreyRun> runs, std::uint32_t width, int rows, std::vector<Token>& tokens,
              Adler& adler) {
    Tokenizer tokenizer(width, tokens, adler);
    std::size_t next = 0;
    for (int row = 0; row < rows; ++row) {
        const std::size_t first = next;
        std::uint64_t pixels = 0;
        while (next < runs.size() && pixels < width) pixels += runs[next++].length;
        if (pixels != width) {
            throw FaultError("row " + std::to_string(row) + " of a band of pixels has " +
                             std::to_string(pixels) + " pixels instead of " + std::to_string(width));
        }
        tokenizer.row(runs.subspan(first, next - first));
    }
    while (next < runs.size() && runs[next].length == 0) ++next;
    if (next != runs.size()) {
        throw FaultError("a band of pixels has more than its " + std::to_string(rows) + " rows");
    }
    tokenizer.finish();
}

/// Appends bits, the lowest first, to bytes.
class BitWriter {
  public:
    /// `most` bounds the bytes that will be written.
    BitWriter(std::vector<std::byte>& out, std::size_t most) : out_(out), start_(out.size()) {
        out_.resize(start_ + most + sizeof buffer_);
        next_ = out_.data() + start_;
    }
    /// Appends the low `count` bits of `bits`, whose other bits are 0; count <= 48.
    void put(std::uint64_t bits, unsigned count) {
        buffer_ |= bits << filled_;
        filled_ += count;
        // All eight bytes go out each time, though only the full ones count: one store and no branch.
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

/// One step of the code that sends the code lengths (RFC 1951, section 3.2.7).
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

/// Huffman codes of a block.
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

/// A match as the bits that send it: code and extra bits of its length, then of its distance.
struct MatchBits {
    std::uint64_t bits = 0;
    unsigned count = 0;

    void add(std::uint64_t more, unsigned more_count) {
        bits |= more << count;
        count += more_count;
    }
};

MatchBits match_bits(const BlockCodes& codes, std::uint32_t length, const Symbol& distance) {
    const Symbol& symbol = length_symbols[length];
    MatchBits match;
    match.add(codes.literal_codes[symbol.symbol], codes.literal_lengths[symbol.symbol]);
    match.add(symbol.extra, symbol.extra_bits);
    match.add(codes.distance_codes[distance.symbol], codes.distance_lengths[distance.symbol]);
    match.add(distance.extra, distance.extra_bits);
    return match;
}

}  // namespace

void compress_band(std::span<const GreyRun> runs, int width, int rows, std::vector<std::byte>& out,
                   Adler& adler) {
    if (width < 1 || width > 65535 || rows < 1 || rows > 4096) {
        throw FaultError("a band of pixels is 1 to 65535 wide and 1 to 4096 high");
    }
    std::vector<Token> tokens;
    tokens.reserve(runs.size() + 1);
    Adler sum;
    tokenize(runs, static_cast<std::uint32_t>(width), rows, tokens, sum);
    adler.append(sum);

    // A row too long to be copied leaves the second distance unused.
    const std::uint32_t stride = std::min(static_cast<std::uint32_t>(width) + 1, max_distance);
    const std::array<Symbol, 2> distances = {distance_symbol(1), distance_symbol(stride)};
    std::array<std::uint32_t, literal_symbols> literal_count{};
    std::array<std::uint32_t, distance_symbols> distance_count{};
    literal_count[end_of_block] = 1;
    for (const Token& token : tokens) {
        expand(
            token, [&](std::uint8_t value) { ++literal_count[value]; },
            [&](std::uint32_t length, bool copy) {
                ++literal_count[length_symbols[length].symbol];
                ++distance_count[distances[copy].symbol];
            });
    }
    BlockCodes codes;
    huffman_lengths(literal_count, 15, codes.literal_lengths);
    huffman_codes(codes.literal_lengths, codes.literal_codes);
    huffman_lengths(distance_count, 15, codes.distance_lengths);
    huffman_codes(codes.distance_lengths, codes.distance_codes);

    std::uint64_t size = 0;  // in bits
    for (std::size_t s = 0; s < literal_symbols; ++s) {
        size += std::uint64_t{literal_count[s]} * (codes.literal_lengths[s] + 5U);
    }
    for (std::size_t s = 0; s < distance_symbols; ++s) {
        size += std::uint64_t{distance_count[s]} * (codes.distance_lengths[s] + 13U);
    }
    constexpr std::size_t header_bytes = 1024;
    BitWriter bits(out, static_cast<std::size_t>(size / 8) + header_bytes);
    write_header(codes, bits);

    std::array<std::array<MatchBits, max_match + 1>, 2> matches;
    for (std::uint32_t length = min_match; length <= max_match; ++length) {
        for (const std::size_t copy : {0U, 1U}) {
            matches[copy][length] = match_bits(codes, length, distances[copy]);
        }
    }
    for (const Token& token : tokens) {
        expand(
            token,
            [&](std::uint8_t value) { bits.put(codes.literal_codes[value], codes.literal_lengths[value]); },
            [&](std::uint32_t length, bool copy) {
                const MatchBits& match = matches[copy][length];
                bits.put(match.bits, match.count);
            });
    }
    bits.put(codes.literal_codes[end_of_block], codes.literal_lengths[end_of_block]);
    bits.put(0, 3);  // an empty stored block, which ends on a byte border
    bits.align();
    bits.put(0xffff0000, 32);
    bits.finish();
}

void deflate_end(std::vector<std::byte>& out) {
    // The last block with the fixed codes: 1, then 01, then the seven zeros of the end of block.
    out.push_back(std::byte{3});
    out.push_back(std::byte{0});
}

}  // namespace lamella
