// Encodes runs with almost no branches on their lengths.
#include "printers/archive/deflate_steps.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lamella {
namespace {

/// Calls match(length) for pieces of 3 to 258 bytes that sum to `count` (at least 3).
template <typename Match>
void split_match(std::uint32_t count, Match match) {
    for (; count >= max_match + min_match; count -= max_match) match(max_match);
    if (count > max_match) {
        match(max_match - min_match);
        count -= max_match - min_match;
    }
    match(count);
}

/// End of a run, by the number of bytes left after its longest matches: a match, or literals.
struct Tail {
    Step match;         ///< 0: no match
    Step literal_mask;  ///< all ones: the first step is a literal
    std::uint32_t steps;
};

constexpr std::array<Tail, max_match> make_tails() {
    std::array<Tail, max_match> tails{};
    for (std::uint32_t rest = 0; rest < max_match; ++rest) {
        tails[rest] = rest < min_match ? Tail{0, 0xffff, rest} : Tail{repeat_step(rest), 0, 1};
    }
    return tails;
}
constexpr std::array<Tail, max_match> tails = make_tails();

/// Longest matches that are always written, whether or not the run has so many.
constexpr std::uint32_t longest_at_once = 4;

/// Writes `count` bytes of one value and returns the position of the next step. Run lengths are
/// unpredictable, so the function almost avoids branches: it writes surplus steps that the next ones
/// overwrite.
Step* write_run(std::uint32_t count, std::uint8_t value, Step* next) {
    if (count == 0) return next;
    const std::uint32_t rest = count - 1, longest = rest / max_match;
    const Tail& tail = tails[rest % max_match];
    *next++ = value;
    for (std::uint32_t i = 0; i < longest_at_once; ++i) next[i] = repeat_step(max_match);
    for (std::uint32_t i = longest_at_once; i < longest; ++i) next[i] = repeat_step(max_match);
    next += longest;
    next[0] = static_cast<Step>(tail.match | (value & tail.literal_mask));
    next[1] = value;
    return next + tail.steps;
}

}  // namespace

void StepWriter::row(std::span<const GreyRun> runs) {
    // A copied row costs one match per 258 bytes. A row with fewer runs is no more expensive if it is encoded
    // directly.
    const bool worth_copying = runs.size() > 4 + row_bytes_ / max_match;
    if (worth_copying && row_bytes_ <= max_distance && std::ranges::equal(runs, previous_)) {
        end_run();
        copied_ += row_bytes_;
    } else {
        end_copies();
        write_out(runs);
    }
    previous_ = runs;
}

std::span<const Step> StepWriter::finish() {
    end_run();
    end_copies();
    return {steps_.get(), count_};
}

void StepWriter::write_out(std::span<const GreyRun> runs) {
    make_room((longest_at_once + 2) * (runs.size() + 2) + (open_ + row_bytes_) / max_match);
    // Local copies, so that they stay in registers.
    Step* next = steps_.get() + count_;
    std::uint32_t open = open_;
    std::uint8_t value = value_;
    const auto put = [&](std::uint32_t count, std::uint8_t of) {
        if (of != value) {
            next = write_run(open, value, next);
            open = 0;
            value = of;
        }
        open += count;
    };
    put(1, 0);  // filter byte: none
    for (const GreyRun& run : runs) {
        if (run.length > 0) put(run.length, static_cast<std::uint8_t>(run.value));
    }
    count_ = static_cast<std::size_t>(next - steps_.get());
    open_ = open;
    value_ = value;
}

void StepWriter::end_run() {
    make_room(open_ / max_match + longest_at_once + 2);
    count_ = static_cast<std::size_t>(write_run(open_, value_, steps_.get() + count_) - steps_.get());
    open_ = 0;
}

void StepWriter::end_copies() {
    if (copied_ == 0) return;
    make_room(copied_ / max_match + 2);
    split_match(copied_, [&](std::uint32_t length) { steps_[count_++] = copy_step(length); });
    copied_ = 0;
}

void StepWriter::make_room(std::size_t more) {
    if (count_ + more <= room_) return;
    room_ = 2 * (count_ + more);
    auto larger = std::make_unique_for_overwrite<Step[]>(room_);
    std::copy_n(steps_.get(), count_, larger.get());
    steps_ = std::move(larger);
}

}  // namespace lamella
