// UndecidedRuns: the undecided part of each run: not yet within reach of a known ball centre.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/morphology/dilated_difference.h"

namespace lamella {

/// A run of ball centres on a line of a stack of layers, run units.
struct BallCenter {
    std::int32_t layer, line;
    Run run;
};

/// Numbered ball centres of a stream of layers.
class BallCenters {
  public:
    /// Stores a ball centre and returns its number.
    std::uint32_t add(const BallCenter& center) {
        kept_.push_back(center);
        return first_ + static_cast<std::uint32_t>(kept_.size()) - 1;
    }
    const BallCenter& operator[](std::uint32_t number) const { return kept_[number - first_]; }
    /// Forgets centres below a layer, at times and not necessarily all. Their numbers must not be used again.
    void forget_below(std::int32_t layer);

  private:
    std::vector<BallCenter> kept_;
    std::uint32_t first_ = 0;  // number of kept_.front()
};

/// The footprint of the balls about a run of centres, line by line.
class BallFootprint {
  public:
    explicit BallFootprint(const BallLines& ball);
    /// Returns the part of a line that the balls reach; an empty run where they reach nothing.
    Run on_line(const BallCenter& center, std::int32_t layer, std::int32_t line) const {
        const int up = layer - center.layer + layers_, across = line - center.line + rows_;
        if (up < 0 || up > 2 * layers_ || across < 0 || across > 2 * rows_) return {0, 0};
        const RoundedExtent& reach = reaches_[number(up, across)];
        if (reach.ahead < 0) return {0, 0};
        return {center.run.begin - reach.back, center.run.end + reach.ahead};
    }

  private:
    /// Returns the index of a line, counted from the lowest layer and the first row that the ball reaches.
    std::size_t number(int up, int across) const {
        const int rows = 2 * rows_ + 1;
        return static_cast<std::size_t>(up) * static_cast<std::size_t>(rows) +
               static_cast<std::size_t>(across);
    }

    int layers_, rows_;
    std::vector<RoundedExtent> reaches_;  // by layer, then by row; negative beyond the ball
};

/// A run: its line, and its number among all runs of the layer.
struct NumberedRun {
    std::size_t line, number;
};

/// The part of each run that is still undecided. A run starts undecided as a whole and shrinks from its ends
/// as ball centres within reach are found.
class UndecidedRuns {
  public:
    /// The runs of `count` lines from `first_line` on start undecided, those of all other lines decided.
    UndecidedRuns(const RunRows& rows, std::int32_t layer, std::size_t first_line, std::size_t count);

    /// Returns the undecided part of run `number`; empty once it is decided.
    const Run& part(std::size_t number) const { return open_[number]; }
    /// Returns true if any run of `line` knows a ball centre within reach.
    bool knows_any(std::size_t line) const { return known_in_[line] > 0; }
    bool is_open(std::size_t number) const { return part(number).begin < part(number).end; }
    /// Returns true if the balls about `center` reach an end of the run's undecided part.
    bool may_close(const BallCenter& center, const NumberedRun& run, const BallFootprint& near) const {
        const Run closed = near.on_line(center, layer_, static_cast<std::int32_t>(run.line)),
                  &open = open_[run.number];
        return closed.begin < open.end && open.begin < closed.end &&
               (closed.begin <= open.begin || open.end <= closed.end);
    }
    /// Marks the points that the balls about `center` reach as decided. Trims ends only: if they reach the
    /// middle alone, nothing changes.
    void decide_within(std::uint32_t center, const BallCenters& centers, const NumberedRun& run,
                       const BallFootprint& near);
    /// Applies the ball centres known to an adjacent line, of the same layer or of another one, to `run`.
    void inherit_from(const UndecidedRuns& others, const RunRows& other_rows, std::size_t other_line,
                      const BallCenters& centers, const Run& whole, const NumberedRun& run,
                      const BallFootprint& near);
    /// Applies the ball centres known to the same lines of another layer to all runs.
    void inherit_from(const UndecidedRuns& others, const RunRows& other_rows, const BallCenters& centers,
                      const RunRows& rows, const BallFootprint& near);

  private:
    void close_near_all(const UndecidedRuns& others, std::size_t other, const BallCenters& centers,
                        const NumberedRun& run, const BallFootprint& near);

    static constexpr std::uint32_t none = UINT32_MAX;
    /// A node of a run's list of known centres; `next` is an index into more_.
    struct Link {
        std::uint32_t center = none, next = none;
    };
    std::int32_t layer_;
    std::vector<Run> open_;   // the undecided part of each run
    std::vector<Link> near_;  // the list of known centres of each run
    std::vector<Link> more_;
    std::vector<std::uint32_t> known_in_;  // number of known centres, by line
};

/// Returns the number of a line's first run.
inline std::size_t first_run(const RunRows& rows, std::size_t line) {
    return static_cast<std::size_t>(rows.line(line).data() - rows.runs().data());
}

}  // namespace lamella
