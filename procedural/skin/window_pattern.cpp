// Cuts the shell's runs by windows in closed form, or walks along them in steps as long as the pattern
// allows.
#include "procedural/skin/window_pattern.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/field/crossing_bracket.h"
#include "engine/field/slice_context.h"
#include "engine/solids/closed_slice.h"

namespace lamella {
namespace {

constexpr int quarter = run_unit / 4;
constexpr int cells_per_unit = 16;  // resolution of a crossing, per run unit
constexpr int chords = 6;           // rounds of interpolation before bisection

/// Cuts the runs on the lines of a band.
class LineWalk {
  public:
    LineWalk(const WindowPattern& pattern, const RowBand& band, double z)
        : pattern_(pattern),
          band_(band),
          z_(z),
          step_(std::abs(band.along_pitch) / 4),
          axis_(band.axis == Axis::x ? 0 : 1) {}

    /// Appends the solid parts of the runs of a line.
    void cut(int line, std::span<const Run> runs, RunRows& out) {
        across_ = band_.line(line);
        for (const Run& run : runs) {
            if (!cut_closed(run, out)) cut(run, out);
        }
        out.end_line();
    }

  private:
    dvec3 point(double along) const {
        return band_.axis == Axis::x ? dvec3(along, across_, z_) : dvec3(across_, along, z_);
    }
    double value(double u) { return pattern_.value_near(point(band_.along(u)), hint_); }
    WindowPattern::Stretch stretch(double u) {
        return pattern_.stretch_near(point(band_.along(u)), axis_, band_.along_pitch > 0, hint_);
    }

    bool cut_closed(const Run& run, RunRows& out) {
        const double a = band_.along(run.begin), b = band_.along(run.end);
        windows_.clear();
        if (!pattern_.windows_on(point(a), axis_, {std::min(a, b), std::max(a, b)}, hint_, windows_))
            return false;
        if (b < a) std::ranges::reverse(windows_);
        std::int32_t from = run.begin;
        for (const Interval& window : windows_) {
            const double first = band_.coordinate(window.lo), last = band_.coordinate(window.hi);
            push(run, from, round_run(std::min(first, last)), out);
            from = round_run(std::max(first, last));
        }
        push(run, from, run.end, out);
        return true;
    }

    void cut(const Run& run, RunRows& out) {
        // Count quarters from the band's origin, so that runs do not depend on how lines are split.
        std::int32_t u = run.begin >= 0 ? run.begin / quarter * quarter
                                        : -((-run.begin + quarter - 1) / quarter * quarter);
        WindowPattern::Stretch here = stretch(u);
        std::int32_t from = run.begin;
        while (u < run.end) {
            const double quarters = std::min(here.same / step_, 1e6);
            const std::int32_t step = std::max(static_cast<std::int32_t>(quarters), 1) * quarter;
            const auto next = u + step < run.end || step == quarter ? stretch(u + step) : here;
            if ((here.value < 0) != (next.value < 0)) {
                const std::int32_t turn = round_run(crossing(u, step, here.value, next.value));
                if (here.value < 0) push(run, from, turn, out);
                from = turn;
            }
            u += step;
            here = next;
        }
        if (here.value < 0) push(run, from, run.end, out);
    }

    static void push(const Run& run, std::int32_t begin, std::int32_t end, RunRows& out) {
        out.push(std::max(begin, run.begin), std::min(end, run.end));
    }

    /// Returns the position of the crossing between two samples, in run coordinates.
    double crossing(std::int32_t u, std::int32_t step, double v, double next) {
        Bracket bracket{0, step * cells_per_unit, v, next};
        const auto at = [&](int border) { return u + static_cast<double>(border) / cells_per_unit; };
        for (int round = 0; bracket.hi - bracket.lo > 1; ++round) {
            const Bracket::Borders borders = bracket.next(round < chords ? Search::chord : Search::halves);
            for (std::size_t n = 0; n < borders.count; ++n) {
                if (bracket.lo < borders.at[n] && borders.at[n] < bracket.hi)
                    bracket.take(borders.at[n], value(at(borders.at[n])), v < 0);
            }
        }
        return (at(bracket.lo) + at(bracket.hi)) * 0.5;
    }

    const WindowPattern& pattern_;
    const RowBand& band_;
    double z_;
    double step_;  ///< mm
    int axis_;     ///< of the lines
    double across_ = 0;
    std::uint32_t hint_ = 0;
    std::vector<Interval> windows_;
};

class PatternedSlice : public SampledSlice {
  public:
    PatternedSlice(const Field& field, const SliceField& shell, const WindowPattern& pattern, double z)
        : SampledSlice(field, z), shell_(shell), pattern_(pattern), z_(z) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        const auto whole = scratch.rows();
        shell_.runs(band, scratch, *whole);
        out.clear();
        LineWalk walk(pattern_, band, z_);
        for (int l = 0; l < band.lines(); ++l) walk.cut(l, whole->line(static_cast<std::size_t>(l)), out);
    }
    Rect bounds() const override { return shell_.bounds(); }

  private:
    const SliceField& shell_;
    const WindowPattern& pattern_;
    double z_;
};

class PatternedShell : public Field {
  public:
    PatternedShell(FieldPtr shell, std::shared_ptr<const WindowPattern> pattern)
        : shell_(std::move(shell)), pattern_(std::move(pattern)) {}

    double value(dvec3 p) const override { return std::max(shell_->value(p), pattern_->value(p)); }
    Interval range(const Box& box) const override {
        const Interval shell = shell_->range(box);
        if (shell.lo > 0) return shell;
        const Interval pattern = pattern_->range(box);
        return {std::max(shell.lo, pattern.lo), std::max(shell.hi, pattern.hi)};
    }
    Metric metric() const override { return shell_->metric() == Metric::sign ? Metric::sign : Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<PatternedSlice>(*this, context.slice(*shell_, z), *pattern_, z);
    }
    Box bounds() const override { return shell_->bounds(); }

  private:
    FieldPtr shell_;
    std::shared_ptr<const WindowPattern> pattern_;
};

}  // namespace

Interval WindowPattern::range(const Box& box) const {
    const double reach = 0.5 * diagonal(box);
    if (!std::isfinite(reach)) return {-infinity, infinity};
    constexpr double least = std::numeric_limits<double>::min();
    const double v = value(box.center());
    return {v > reach ? least : -infinity, v < -reach ? -least : infinity};
}

FieldPtr make_patterned_shell(FieldPtr shell, std::shared_ptr<const WindowPattern> pattern) {
    if (!shell || !pattern) throw InputError("a patterned skin needs a shell and a pattern");
    return std::make_shared<PatternedShell>(std::move(shell), std::move(pattern));
}

}  // namespace lamella
