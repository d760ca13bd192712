// Prepares beams for the row kernel, one per lane. Compiled for every SIMD target; all do the same IEEE
// operations on doubles in the same order, so that every target gives the same bits.
#include "engine/solids/beam_group.h"

#include <cmath>

using std::isnan;  // of libhwy where there are no vectors, which expects that of <math.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/solids/beam_group.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

#ifndef LAMELLA_BEAM_GROUP_LIMITS
#define LAMELLA_BEAM_GROUP_LIMITS
namespace lamella {

/// Below this value of cos^2 - ux^2 the line is nearly parallel to the beam, and the kernel's quotient loses
/// digits.
constexpr double min_beam_slope = 1e-4;
/// Beams longer than this many radii lose digits in single precision.
constexpr double longest_beam_in_radii = 100;

}  // namespace lamella
#endif

HWY_BEFORE_NAMESPACE();
namespace lamella {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, BeamGroup::most>;
using DoubleLanes = hn::Vec<Doubles>;

HWY_INLINE void put(DoubleLanes v, float* to) {
    const hn::Rebind<float, Doubles> d;
    hn::StoreU(hn::DemoteTo(d, v), d, to);
}

/// Stores integral values, small enough for 32 bits.
HWY_INLINE void put(DoubleLanes v, std::int32_t* to) {
    const Doubles d;
    const hn::Rebind<std::int32_t, Doubles> di;
    const auto limit = hn::Set(d, 1e9);
    hn::StoreU(hn::DemoteTo(di, hn::Min(hn::Max(v, hn::Neg(limit)), limit)), di, to);
}

/// Returns twice the midpoint of the part of the axis whose balls can meet the plane, as a parameter in [0,
/// 1].
HWY_INLINE DoubleLanes twice_middle_near_plane(DoubleLanes a_z, DoubleLanes rise, DoubleLanes reach,
                                               DoubleLanes z) {
    const Doubles d;
    const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
    const auto s0 = hn::Div(hn::Sub(hn::Sub(z, reach), a_z), rise),
               s1 = hn::Div(hn::Sub(hn::Add(z, reach), a_z), rise);
    const auto lo = hn::Max(zero, hn::Min(s0, s1)), hi = hn::Min(one, hn::Max(s0, s1));
    return hn::IfThenElse(hn::Eq(rise, zero), one, hn::Add(lo, hi));
}

void prepare_beams(const BeamGroup::Ends& ends, const RowBand& band, double plane_z,
                   BeamGroup::InPlane& out) {
    const Doubles d;
    const auto set = [&](double v) HWY_ATTR { return hn::Set(d, v); };
    const auto half = set(0.5);
    const double line_pitch = band.across_pitch / band.sub;
    for (std::size_t i = 0; i < BeamGroup::most; i += hn::Lanes(d)) {
        const auto get = [&](const BeamGroup::Lanes<double>& v) HWY_ATTR { return hn::LoadU(d, &v[i]); };
        const auto a_along = get(ends.a_along), a_across = get(ends.a_across), a_z = get(ends.a_z),
                   ra = get(ends.ra);
        const auto b_along = get(ends.b_along), b_across = get(ends.b_across), b_z = get(ends.b_z),
                   rb = get(ends.rb);
        const auto along = hn::Sub(b_along, a_along), across = hn::Sub(b_across, a_across),
                   rise = hn::Sub(b_z, a_z);
        const auto squared =
            hn::Add(hn::Add(hn::Mul(along, along), hn::Mul(across, across)), hn::Mul(rise, rise));
        const auto length = hn::Sqrt(squared), growth = hn::Sub(ra, rb);
        const auto ux = hn::Div(along, length), uy = hn::Div(across, length), uz = hn::Div(rise, length);
        const auto sine = hn::Div(growth, length), sine2 = hn::Mul(sine, sine),
                   cos2 = hn::Sub(set(1.0), sine2);
        const auto slope = hn::Sub(hn::Add(hn::Mul(uy, uy), hn::Mul(uz, uz)), sine2);
        const auto one_ball = hn::Le(length, hn::Abs(growth)),
                   is_long = hn::Gt(length, hn::Mul(set(longest_beam_in_radii), hn::Min(ra, rb))),
                   is_parallel = hn::Lt(slope, set(min_beam_slope));

        const auto s =
            hn::Mul(hn::Mul(twice_middle_near_plane(a_z, rise, hn::Max(ra, rb), set(plane_z)), half), length);
        const auto at_along = hn::Add(a_along, hn::Mul(ux, s)), at_across = hn::Add(a_across, hn::Mul(uy, s)),
                   at_z = hn::Add(a_z, hn::Mul(uz, s));
        const auto radius = hn::Sub(ra, hn::Mul(s, sine)), z = hn::Sub(set(plane_z), at_z);
        const auto radius_sine = hn::Mul(radius, sine);
        put(ux, &out.ux[i]);
        put(uy, &out.uy[i]);
        put(z, &out.z[i]);
        put(hn::Mul(z, uz), &out.qz[i]);
        put(slope, &out.a[i]);
        put(cos2, &out.cos2[i]);
        put(sine, &out.sine[i]);
        put(radius, &out.radius[i]);
        put(hn::Sub(radius_sine, hn::Mul(s, cos2)), &out.low[i]);
        put(hn::Add(radius_sine, hn::Mul(hn::Sub(length, s), cos2)), &out.high[i]);
        const auto first_up = hn::Sub(z, hn::Sub(a_z, at_z)), second_up = hn::Sub(z, hn::Sub(b_z, at_z));
        put(hn::Sub(a_along, at_along), &out.ax[i]);
        put(hn::Sub(a_across, at_across), &out.ay[i]);
        put(hn::Sub(hn::Mul(ra, ra), hn::Mul(first_up, first_up)), &out.ah[i]);
        put(hn::Sub(b_along, at_along), &out.bx[i]);
        put(hn::Sub(b_across, at_across), &out.by[i]);
        put(hn::Sub(hn::Mul(rb, rb), hn::Mul(second_up, second_up)), &out.bh[i]);

        const auto origin = set(band.across_origin), pitch = set(line_pitch);
        const auto line = hn::Floor(hn::Sub(hn::Div(hn::Sub(at_across, origin), pitch), half));
        const auto position = hn::Add(origin, hn::Mul(hn::Add(line, half), pitch));
        const auto unit =
                       hn::Mul(hn::Sub(at_along, set(band.along_origin)), set(run_unit / band.along_pitch)),
                   unit0 = hn::Floor(unit);
        put(hn::Sub(position, at_across), &out.line0[i]);
        put(hn::Sub(unit, unit0), &out.shift[i]);
        put(hn::Sub(get(ends.first_line), line), &out.first[i]);
        put(unit0, &out.unit0[i]);
        const auto exactly = hn::Or(one_ball, hn::Or(is_long, is_parallel));
        put(hn::IfThenElseZero(exactly, set(1.0)), &out.needs_doubles[i]);
    }
    const hn::CappedTag<float, BeamGroup::most> df;
    for (std::size_t i = 0; i < BeamGroup::most; i += hn::Lanes(df))
        hn::StoreU(hn::Div(hn::Set(df, 1.0F), hn::LoadU(df, &out.a[i])), df, &out.inverse_a[i]);
}

}  // namespace HWY_NAMESPACE
}  // namespace lamella
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lamella {

HWY_EXPORT(prepare_beams);

void BeamGroup::add(const Beam& beam, const LineRange& lines) {
    const int along = band_.axis == Axis::x ? 0 : 1, across = 1 - along;
    beams_[size_] = &beam;
    lines_[size_] = lines;
    ends_.a_along[size_] = beam.a[along];
    ends_.a_across[size_] = beam.a[across];
    ends_.a_z[size_] = beam.a.z;
    ends_.ra[size_] = beam.ra;
    ends_.b_along[size_] = beam.b[along];
    ends_.b_across[size_] = beam.b[across];
    ends_.b_z[size_] = beam.b.z;
    ends_.rb[size_] = beam.rb;
    ends_.first_line[size_] = band_.number(lines.first);
    ++size_;
}

void BeamGroup::prepare() { HWY_DYNAMIC_DISPATCH(prepare_beams)(ends_, band_, z_, in_plane_); }

BeamInPlane BeamGroup::in_plane(std::size_t i) const {
    const InPlane& p = in_plane_;
    return {p.ux[i],  p.uy[i],   p.z[i],  p.qz[i], p.a[i],  p.inverse_a[i], p.cos2[i], p.sine[i], p.radius[i],
            p.low[i], p.high[i], p.ax[i], p.ay[i], p.ah[i], p.bx[i],        p.by[i],   p.bh[i]};
}

LineFrame BeamGroup::frame(std::size_t i) const {
    return {.line0 = in_plane_.line0[i],
            .line_pitch = static_cast<float>(band_.across_pitch / band_.sub),
            .first = in_plane_.first[i],
            .step = band_.step,
            .scale = static_cast<float>(run_unit / band_.along_pitch),
            .shift = in_plane_.shift[i],
            .unit0 = in_plane_.unit0[i]};
}

}  // namespace lamella
#endif
