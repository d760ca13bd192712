// Compiled for every SIMD target. No fused operations and no approximations: every target gives the same
// bits.
#include "engine/gap_limits.h"

#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/gap_limits.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

#ifndef LAMELLA_GAP_REACHES
#define LAMELLA_GAP_REACHES
namespace lamella {

/// How far a source reaches on the lines of a block: read from the table, or calculated where its ball is
/// another one.
class SourceReaches {
  public:
    SourceReaches(const LayerLattice& lattice, const BallReaches& table, const LineBlock& block)
        : lattice_(lattice), table_(table), block_(block) {}

    void look_up(const GapSource& source) {
        const std::int32_t layers = block_.layer - source.layer, lines = block_.line - source.line;
        if (!table_.are_of(source.weight)) return calculate(source.weight, layers, lines);
        ahead_ = table_.ahead(layers, lines);
        back_ = table_.back(layers, lines);
        stride_ = table_.stride();
    }
    /// Of the lines of a layer, counted from the block's first.
    const std::int32_t* ahead(std::size_t layer) const { return ahead_ + layer * stride_; }
    const std::int32_t* back(std::size_t layer) const { return back_ + layer * stride_; }
    std::size_t layers() const { return static_cast<std::size_t>(block_.layers); }

  private:
    void calculate(double weight, std::int32_t layers, std::int32_t lines) {
        for (std::int32_t z = 0; z < block_.layers; ++z) {
            for (std::int32_t l = 0; l < GapLimits::edge; ++l) {
                const double across = (lines + l) * lattice_.row_pitch;
                const double up = (layers + z) * lattice_.layer_pitch;
                const double left = weight - across * across - up * up;
                const std::size_t i = GapLimits::place(z, l);
                own_ahead_[i] = own_back_[i] = BallReaches::none;
                if (left < 0) continue;
                const BallReach reach(std::sqrt(left));
                own_ahead_[i] = reach.ahead;
                own_back_[i] = reach.back;
            }
        }
        ahead_ = own_ahead_.data();
        back_ = own_back_.data();
        stride_ = GapLimits::edge;
    }

    LayerLattice lattice_;
    const BallReaches& table_;
    LineBlock block_;
    const std::int32_t *ahead_ = nullptr, *back_ = nullptr;
    std::size_t stride_ = 0;
    std::array<std::int32_t, GapLimits::lines> own_ahead_, own_back_;
};

}  // namespace lamella
#endif

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lines = hn::CappedTag<std::int32_t, GapLimits::edge>;

/// Ends that look one way: those of a gap's begin to the right, of its end to the left. Calculates in signs
/// in which all look to the right.
struct LookAhead {
    static std::int32_t end(const GapSource& source) { return source.end; }
    static const std::int32_t* reaches(const SourceReaches& of, std::size_t layer) { return of.ahead(layer); }
};
struct LookBack {
    static std::int32_t end(const GapSource& source) { return -source.begin; }
    static const std::int32_t* reaches(const SourceReaches& of, std::size_t layer) { return of.back(layer); }
};

/// The least of one side's ends on lines where the gap is still open.
HWY_INLINE std::int32_t least_open(const std::int32_t* ends, const std::int32_t* other_ends) {
    const Lines d;
    const auto zero = hn::Zero(d), far = hn::Set(d, std::numeric_limits<std::int32_t>::max());
    auto least = far;
    for (std::size_t i = 0; i < GapLimits::lines; i += hn::Lanes(d)) {
        const auto a = hn::Load(d, ends + i), b = hn::Load(d, other_ends + i);
        least = hn::Min(least, hn::IfThenElse(hn::Lt(hn::Add(a, b), zero), a, far));
    }
    return hn::GetLane(hn::MinOfLanes(d, least));
}

template <typename Look>
HWY_INLINE void grow_into_gap(SourceReaches& reaches, std::span<const GapSource> sources, std::int32_t* ends,
                              const std::int32_t* other_ends) {
    constexpr int between_looks = 16;
    const Lines d;
    std::int32_t least = std::numeric_limits<std::int32_t>::min();
    int since_look = between_looks;
    for (const GapSource& source : sources) {
        const std::int32_t end = Look::end(source);
        if (end + source.most <= least) continue;
        reaches.look_up(source);
        const auto from = hn::Set(d, end);
        for (std::size_t z = 0; z < reaches.layers(); ++z) {
            const std::int32_t* const row = Look::reaches(reaches, z);
            std::int32_t* const at = ends + z * GapLimits::edge;
            for (std::size_t l = 0; l < GapLimits::edge; l += hn::Lanes(d)) {
                const auto reached = hn::Add(from, hn::LoadU(d, row + l));
                hn::Store(hn::Max(hn::Load(d, at + l), reached), d, at + l);
            }
        }
        if (++since_look >= between_looks) {
            least = least_open(ends, other_ends);
            since_look = 0;
        }
    }
}

void grow_from_left(SourceReaches& reaches, std::span<const GapSource> sources, std::int32_t* begins,
                    const std::int32_t* ends) {
    grow_into_gap<LookAhead>(reaches, sources, begins, ends);
}

void grow_from_right(SourceReaches& reaches, std::span<const GapSource> sources, const std::int32_t* begins,
                     std::int32_t* ends) {
    grow_into_gap<LookBack>(reaches, sources, ends, begins);
}

void grow_inside(SourceReaches& reaches, std::span<const GapSource> sources, std::int32_t* begins,
                 std::int32_t* ends, std::array<std::vector<Run>, GapLimits::lines>& islands) {
    const Lines d;
    const auto zero = hn::Zero(d);
    HWY_ALIGN std::int32_t island_begins[GapLimits::edge], island_ends[GapLimits::edge];
    for (const GapSource& source : sources) {
        reaches.look_up(source);
        const auto begin = hn::Set(d, -source.begin), end = hn::Set(d, source.end);
        for (std::size_t z = 0; z < reaches.layers(); ++z) {
            for (std::size_t l = 0; l < GapLimits::edge; l += hn::Lanes(d)) {
                const std::size_t at = z * GapLimits::edge + l;
                const auto from = hn::Load(d, begins + at), to = hn::Load(d, ends + at);
                const auto b = hn::Add(begin, hn::LoadU(d, reaches.back(z) + l)),
                           e = hn::Add(end, hn::LoadU(d, reaches.ahead(z) + l));
                // The gap is open, and reached from either end.
                const auto concerned =
                    hn::And(hn::Lt(hn::Add(from, to), zero), hn::And(hn::Lt(from, e), hn::Lt(to, b)));
                if (hn::AllFalse(d, concerned)) continue;
                const auto at_left = hn::AndNot(hn::Lt(hn::Add(from, b), zero), concerned),
                           at_right = hn::AndNot(hn::Lt(hn::Add(e, to), zero), concerned);
                hn::Store(hn::IfThenElse(at_left, e, from), d, begins + at);
                hn::Store(hn::IfThenElse(at_right, b, to), d, ends + at);
                const auto alone = hn::AndNot(hn::Or(at_left, at_right), concerned);
                if (hn::AllFalse(d, alone)) continue;
                hn::Store(hn::Neg(b), d, island_begins);
                hn::Store(hn::IfThenElse(alone, e, hn::Neg(b)), d, island_ends);
                for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
                    if (island_begins[i] < island_ends[i])
                        islands[at + i].push_back({island_begins[i], island_ends[i]});
                }
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(grow_from_left);
HWY_EXPORT(grow_from_right);
HWY_EXPORT(grow_inside);

void GapLimits::begin(const LineBlock& block, Run gap) {
    begins_.fill(0);
    ends_.fill(0);
    for (std::int32_t z = 0; z < block.layers; ++z) {
        for (std::int32_t l = 0; l < block.lines; ++l) {
            begins_[place(z, l)] = gap.begin;
            ends_[place(z, l)] = -gap.end;
        }
    }
}

void GapLimits::grow_left(const LayerLattice& lattice, const BallReaches& reaches, const LineBlock& block,
                          std::span<const GapSource> sources) {
    if (sources.empty()) return;
    SourceReaches of_sources(lattice, reaches, block);
    HWY_DYNAMIC_DISPATCH(grow_from_left)
    (of_sources, sources, begins_.data(), ends_.data());
}

void GapLimits::grow_right(const LayerLattice& lattice, const BallReaches& reaches, const LineBlock& block,
                           std::span<const GapSource> sources) {
    if (sources.empty()) return;
    SourceReaches of_sources(lattice, reaches, block);
    HWY_DYNAMIC_DISPATCH(grow_from_right)
    (of_sources, sources, begins_.data(), ends_.data());
}

void GapLimits::grow_within(const LayerLattice& lattice, const BallReaches& reaches, const LineBlock& block,
                            std::span<const GapSource> sources,
                            std::array<std::vector<Run>, lines>& islands) {
    if (sources.empty()) return;
    SourceReaches of_sources(lattice, reaches, block);
    HWY_DYNAMIC_DISPATCH(grow_inside)
    (of_sources, sources, begins_.data(), ends_.data(), islands);
}

}  // namespace lamella
#endif
