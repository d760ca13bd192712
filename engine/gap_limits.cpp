// Compiled for every SIMD target. No fused operations and no approximations: every target gives the same
// bits.
#include "engine/gap_limits.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/gap_limits.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lines = hn::CappedTag<double, GapLimits::edge>;
using LineLanes = hn::Vec<Lines>;

constexpr std::size_t rows = GapLimits::edge;

/// The squares of how far one source still reaches on the lines of a block.
class Leftover {
  public:
    HWY_INLINE Leftover(const LayerLattice& lattice, const LineBlock& block, const GapSource& source,
                        std::size_t first_line)
        : layers_(block.layer - source.layer), layer_pitch_(lattice.layer_pitch) {
        const Lines d;
        const auto away =
            hn::Set(d, static_cast<double>(block.line - source.line) + static_cast<double>(first_line));
        const auto across = hn::Mul(hn::Add(hn::Iota(d, 0), away), hn::Set(d, lattice.row_pitch));
        beside_ = hn::Sub(hn::Set(d, source.weight), hn::Mul(across, across));
    }
    HWY_INLINE LineLanes in_layer(std::size_t z) const {
        const double up = (layers_ + static_cast<double>(z)) * layer_pitch_;
        return hn::Sub(beside_, hn::Set(Lines(), up * up));
    }

  private:
    double layers_, layer_pitch_;
    LineLanes beside_;
};

/// How far ends move, rounded as BallReach does.
HWY_INLINE LineLanes ahead_by(LineLanes reach) {
    const Lines d;
    return hn::Floor(hn::Mul(hn::Floor(hn::Add(hn::Add(reach, reach), hn::Set(d, 1))), hn::Set(d, 0.5)));
}
HWY_INLINE LineLanes back_by(LineLanes reach) {
    const Lines d;
    const auto ahead = ahead_by(reach);
    return hn::IfThenElse(hn::Eq(hn::Sub(ahead, reach), hn::Set(d, 0.5)), hn::Sub(ahead, hn::Set(d, 1)),
                          ahead);
}

/// Ends that look one way: those of a gap's begin to the right, of its end to the left. Calculates in signs
/// in which all look to the right.
struct LookAhead {
    static double end(const GapSource& source) { return source.end; }
    static HWY_INLINE LineLanes reached(LineLanes reach) { return ahead_by(reach); }
    static double sign() { return 1; }
};
struct LookBack {
    static double end(const GapSource& source) { return -static_cast<double>(source.begin); }
    static HWY_INLINE LineLanes reached(LineLanes reach) { return back_by(reach); }
    static double sign() { return -1; }
};

/// The least reach into the gap on lines where it is still open.
template <typename Look>
HWY_INLINE double least_open(const double* from, const double* to) {
    const Lines d;
    const auto sign = hn::Set(d, Look::sign()), far = hn::Set(d, std::numeric_limits<double>::infinity());
    auto least = far;
    for (std::size_t i = 0; i < GapLimits::lines; i += hn::Lanes(d)) {
        const auto a = hn::Mul(hn::Load(d, from + i), sign), b = hn::Mul(hn::Load(d, to + i), sign);
        least = hn::Min(least, hn::IfThenElse(hn::Lt(a, b), a, far));
    }
    return hn::GetLane(hn::MinOfLanes(d, least));
}

template <typename Look>
HWY_INLINE void grow_into_gap(const LayerLattice& lattice, const LineBlock& block,
                              std::span<const GapSource> sources, double* from, const double* to) {
    constexpr int between_looks = 16;
    const Lines d;
    const auto zero = hn::Zero(d), sign = hn::Set(d, Look::sign());
    double least = -std::numeric_limits<double>::infinity();
    int since_look = between_looks;
    for (const GapSource& source : sources) {
        const double end = Look::end(source);
        if (end + source.most <= least) continue;
        const auto ends = hn::Set(d, end);
        bool grew = false;
        for (std::size_t l = 0; l < static_cast<std::size_t>(block.lines); l += hn::Lanes(d)) {
            const Leftover leftover(lattice, block, source, l);
            for (std::size_t z = 0; z < static_cast<std::size_t>(block.layers); ++z) {
                double* const at = from + z * rows + l;
                const auto known = hn::Mul(hn::Load(d, at), sign);
                const auto left = leftover.in_layer(z);
                const auto way = hn::Max(hn::Sub(known, ends), zero);
                const auto farther = hn::Ge(left, hn::Mul(way, way));
                if (hn::AllFalse(d, farther)) continue;
                const auto reached = hn::Add(ends, Look::reached(hn::Sqrt(hn::Max(left, zero))));
                const auto now = hn::IfThenElse(farther, hn::Max(known, reached), known);
                hn::Store(hn::Mul(now, sign), d, at);
                grew = true;
            }
        }
        if (++since_look >= between_looks && grew) {
            least = least_open<Look>(from, to);
            since_look = 0;
        }
    }
}

void grow_from_left(const LayerLattice& lattice, const LineBlock& block, std::span<const GapSource> sources,
                    double* begins, const double* ends) {
    grow_into_gap<LookAhead>(lattice, block, sources, begins, ends);
}

void grow_from_right(const LayerLattice& lattice, const LineBlock& block, std::span<const GapSource> sources,
                     const double* begins, double* ends) {
    grow_into_gap<LookBack>(lattice, block, sources, ends, begins);
}

void grow_inside(const LayerLattice& lattice, const LineBlock& block, std::span<const GapSource> sources,
                 double* begins, double* ends, std::array<std::vector<Run>, GapLimits::lines>& islands) {
    const Lines d;
    const auto zero = hn::Zero(d);
    HWY_ALIGN double island_begins[rows], island_ends[rows];
    for (const GapSource& source : sources) {
        const auto begin = hn::Set(d, source.begin), end = hn::Set(d, source.end);
        for (std::size_t l = 0; l < static_cast<std::size_t>(block.lines); l += hn::Lanes(d)) {
            const Leftover leftover(lattice, block, source, l);
            for (std::size_t z = 0; z < static_cast<std::size_t>(block.layers); ++z) {
                const std::size_t at = z * rows + l;
                const auto left = leftover.in_layer(z);
                auto from = hn::Load(d, begins + at), to = hn::Load(d, ends + at);
                auto concerned = hn::And(hn::Ge(left, zero), hn::Lt(from, to));
                if (hn::AllFalse(d, concerned)) continue;
                const auto reach = hn::Sqrt(hn::Max(left, zero));
                const auto b = hn::Sub(begin, back_by(reach)), e = hn::Add(end, ahead_by(reach));
                concerned = hn::And(concerned, hn::And(hn::Lt(from, e), hn::Lt(b, to)));
                if (hn::AllFalse(d, concerned)) continue;
                const auto at_left = hn::And(concerned, hn::Le(b, from)),
                           at_right = hn::And(concerned, hn::Ge(e, to));
                from = hn::IfThenElse(at_left, hn::Max(from, e), from);
                to = hn::IfThenElse(at_right, hn::Min(to, b), to);
                hn::Store(from, d, begins + at);
                hn::Store(to, d, ends + at);
                const auto alone = hn::AndNot(hn::Or(at_left, at_right), concerned);
                if (hn::AllFalse(d, alone)) continue;
                hn::Store(b, d, island_begins);
                hn::Store(hn::IfThenElse(alone, e, b), d, island_ends);
                for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
                    if (island_begins[i] < island_ends[i])
                        islands[at + i].push_back({static_cast<std::int32_t>(island_begins[i]),
                                                   static_cast<std::int32_t>(island_ends[i])});
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
            ends_[place(z, l)] = gap.end;
        }
    }
}

void GapLimits::grow_left(const LayerLattice& lattice, const LineBlock& block,
                          std::span<const GapSource> sources) {
    HWY_DYNAMIC_DISPATCH(grow_from_left)(lattice, block, sources, begins_.data(), ends_.data());
}

void GapLimits::grow_right(const LayerLattice& lattice, const LineBlock& block,
                           std::span<const GapSource> sources) {
    HWY_DYNAMIC_DISPATCH(grow_from_right)(lattice, block, sources, begins_.data(), ends_.data());
}

void GapLimits::grow_within(const LayerLattice& lattice, const LineBlock& block,
                            std::span<const GapSource> sources,
                            std::array<std::vector<Run>, lines>& islands) {
    HWY_DYNAMIC_DISPATCH(grow_inside)(lattice, block, sources, begins_.data(), ends_.data(), islands);
}

}  // namespace lamella
#endif
