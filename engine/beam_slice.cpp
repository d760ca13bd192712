// Prepares beams for the row kernel, and takes the exact path where single precision would not do.
#include "engine/beam_slice.h"

#include "engine/slice_context.h"

namespace lamella {
namespace {

/// Below this value of cos^2 - ux^2 the line is nearly parallel to the beam and the kernel's quotient loses
/// digits.
constexpr double least_slope = 1e-4;
/// Beams longer than this many radii lose digits in single precision.
constexpr double longest_in_radii = 100;

/// The part of the beam's axis whose balls can meet the plane, as a range of its parameter in [0, 1].
Interval axis_near_plane(const Beam& beam, double z) {
    const double reach = std::max(beam.ra, beam.rb), dz = beam.b.z - beam.a.z;
    if (dz == 0) return std::abs(z - beam.a.z) <= reach ? Interval{0, 1} : Interval{};
    const double s0 = (z - reach - beam.a.z) / dz, s1 = (z + reach - beam.a.z) / dz;
    return {std::max(0.0, std::min(s0, s1)), std::min(1.0, std::max(s0, s1))};
}

/// Encloses the beam's section along one axis of the plane: the balls that meet the plane, and the ellipse in
/// which the plane cuts the endless cylinder round all balls.
Interval extent(const Beam& beam, const Interval& part, double z, int axis) {
    const dvec3 d = beam.b - beam.a;
    const double reach = std::max(beam.ra, beam.rb);
    const double p = beam.a[axis] + d[axis] * part.lo, q = beam.a[axis] + d[axis] * part.hi;
    const Interval balls{std::min(p, q) - reach, std::max(p, q) + reach};
    if (d.z == 0) return balls;
    const double slope = d[axis] / d.z;  // of the axis, over the height
    const double center = beam.a[axis] + (z - beam.a.z) * slope;
    // With room for rounding: the ellipse of a beam that hardly climbs is wide, and of no use.
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
    sections_.visit(band, lines,
                    [&](std::uint32_t i, const LineRange& met) { collect_beam(beams_[i], band, met, runs); });
}

void BeamRows::collect_beam(const Beam& beam, const RowBand& band, const LineRange& lines,
                            RunCollector& runs) const {
    const int along_axis = band.axis == Axis::x ? 0 : 1, across_axis = 1 - along_axis;
    const dvec3 d = beam.b - beam.a;
    const double length = std::sqrt(glm::dot(d, d));
    const double least_radius = std::min(beam.ra, beam.rb);
    const bool one_ball = length <= std::abs(beam.ra - beam.rb);
    if (one_ball || length > longest_in_radii * least_radius)
        return collect_exactly(beam, band, lines, z_, runs);
    const dvec3 axis = d / length;
    const double sine = (beam.ra - beam.rb) / length, cos2 = 1 - sine * sine;
    const double a = axis[across_axis] * axis[across_axis] + axis.z * axis.z - sine * sine;
    if (a < least_slope) return collect_exactly(beam, band, lines, z_, runs);

    const Interval part = axis_near_plane(beam, z_);
    const double s = (part.lo + part.hi) * 0.5 * length;
    const dvec3 reference = beam.a + axis * s;
    const double radius = beam.ra - s * sine, z = z_ - reference.z;
    BeamInPlane p;
    p.ux = static_cast<float>(axis[along_axis]);
    p.uy = static_cast<float>(axis[across_axis]);
    p.z = static_cast<float>(z);
    p.qz = static_cast<float>(z * axis.z);
    p.a = static_cast<float>(a);
    p.inverse_a = 1.0F / p.a;
    p.cos2 = static_cast<float>(cos2);
    p.sine = static_cast<float>(sine);
    p.radius = static_cast<float>(radius);
    p.low = static_cast<float>(radius * sine - s * cos2);
    p.high = static_cast<float>(radius * sine + (length - s) * cos2);
    const dvec3 first = beam.a - reference, second = beam.b - reference;
    p.ax = static_cast<float>(first[along_axis]);
    p.ay = static_cast<float>(first[across_axis]);
    p.ah = static_cast<float>(beam.ra * beam.ra - (z - first.z) * (z - first.z));
    p.bx = static_cast<float>(second[along_axis]);
    p.by = static_cast<float>(second[across_axis]);
    p.bh = static_cast<float>(beam.rb * beam.rb - (z - second.z) * (z - second.z));

    const int count = lines.last - lines.first;
    const auto out = runs.add(lines.first, count);
    beam_rows(line_frame(band, lines.first, dvec2(reference)), p, count, out.begin, out.end);
}

void BeamSlice::spans(const RowBand& band, Scratch& scratch, SpanRows& out) const {
    scratch.collector.clear();
    rows_.collect(band, scratch.collector);
    scratch.collector.merge(band, out);
}

}  // namespace lamella
