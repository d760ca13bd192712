// Beams go through the row kernel, or through the exact path where single precision is too coarse.
#include "engine/solids/beam_slice.h"

#include "engine/field/slice_context.h"
#include "engine/solids/beam_group.h"

namespace lamella {
namespace {

/// Returns the part of the beam's axis whose balls can meet the plane, as a range of its parameter in [0, 1].
Interval axis_near_plane(const Beam& beam, double z) {
    const double reach = std::max(beam.ra, beam.rb), dz = beam.b.z - beam.a.z;
    if (dz == 0) return std::abs(z - beam.a.z) <= reach ? Interval{0, 1} : Interval{};
    const double s0 = (z - reach - beam.a.z) / dz, s1 = (z + reach - beam.a.z) / dz;
    return {std::max(0.0, std::min(s0, s1)), std::min(1.0, std::max(s0, s1))};
}

/// Bounds the beam's section along one axis of the plane by two enclosures: the balls that meet the plane,
/// and the ellipse in which the plane cuts the infinite cylinder around all balls.
Interval extent(const Beam& beam, const Interval& part, double z, int axis) {
    const dvec3 d = beam.b - beam.a;
    const double reach = std::max(beam.ra, beam.rb);
    const double p = beam.a[axis] + d[axis] * part.lo, q = beam.a[axis] + d[axis] * part.hi;
    const Interval balls{std::min(p, q) - reach, std::max(p, q) + reach};
    if (d.z == 0) return balls;
    const double slope = d[axis] / d.z;  // of the axis, over the height
    const double center = beam.a[axis] + (z - beam.a.z) * slope;
    // A margin covers rounding: the ellipse of a nearly horizontal beam is wide and of no use anyway.
    const double half = reach * std::sqrt(1 + slope * slope) * (1 + 1e-6);
    return {std::max(balls.lo, center - half), std::min(balls.hi, center + half)};
}

void collect_exactly(const Beam& beam, const RowBand& band, const LineRange& lines, double z,
                     RunCollector& runs) {
    const auto out = runs.add(lines.first, lines.last - lines.first);
    const dvec3 direction = band.axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    for (int l = lines.first; l < lines.last; ++l) {
        const double across = band.line(l);
        const dvec3 p = band.axis == Axis::x ? dvec3(0, across, z) : dvec3(across, 0, z);
        std::int32_t& begin = out.begin[l - lines.first];
        std::int32_t& end = out.end[l - lines.first];
        begin = end = 0;
        if (const auto solid = cut(beam, p, direction)) {
            const double u = band.coordinate(solid->lo), v = band.coordinate(solid->hi);
            begin = round_run(std::min(u, v));
            end = round_run(std::max(u, v));
        }
    }
}

/// Adds the runs of a group's beams, and empties the group.
void collect_group(BeamGroup& group, const RowBand& band, double z, RunCollector& runs) {
    group.prepare();
    for (std::size_t i = 0; i < group.size(); ++i) {
        const LineRange& lines = group.lines(i);
        if (group.needs_doubles(i)) {
            collect_exactly(group.beam(i), band, lines, z, runs);
        } else {
            const int count = lines.last - lines.first;
            const auto out = runs.add(lines.first, count);
            beam_rows(group.frame(i), group.in_plane(i), count, out.begin, out.end);
        }
    }
    group.clear();
}

}  // namespace

BeamRows::BeamRows(const std::vector<Beam>& beams, double z) : z_(z) {
    std::vector<Rect> sections;
    for (const Beam& beam : beams) {
        const Interval part = axis_near_plane(beam, z);
        if (part.empty()) continue;
        beams_.push_back(beam);
        const Interval x = extent(beam, part, z, 0), y = extent(beam, part, z, 1);
        sections.push_back({{x.lo, y.lo}, {x.hi, y.hi}});
    }
    sections_ = PlaneIndex(std::move(sections));
}

void BeamRows::collect(const RowBand& band, const LineRange& lines, RunCollector& runs) const {
    BeamGroup group(band, z_);
    sections_.visit(band, lines, [&](std::uint32_t i, const LineRange& met) {
        group.add(beams_[i], met);
        if (group.full()) collect_group(group, band, z_, runs);
    });
    if (group.size() > 0) collect_group(group, band, z_, runs);
}

void BeamSlice::runs(const RowBand& band, Scratch& scratch, RunRows& out) const {
    scratch.collector.clear();
    rows_.collect(band, scratch.collector);
    scratch.collector.merge(band, out);
}

}  // namespace lamella
