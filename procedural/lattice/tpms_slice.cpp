// Runs of one period per line, repeated; with gradings, from a walk along the lines.
#include "procedural/lattice/tpms_slice.h"

#include <array>

#include "engine/solids/closed_slice.h"
#include "procedural/lattice/line_walk.h"
#include "procedural/lattice/wall_line.h"
#include "procedural/lattice/wave_runs.h"

namespace lamella {
namespace {

constexpr int columns_at_once = 64;

Interval along(const Rect& rect, Axis axis) {
    return axis == Axis::x ? Interval{rect.lo.x, rect.hi.x} : Interval{rect.lo.y, rect.hi.y};
}

Interval across(const Rect& rect, Axis axis) { return along(rect, axis == Axis::x ? Axis::y : Axis::x); }

Rect region_at(const Box& region, double z) {
    return region.lo.z <= z && z <= region.hi.z ? region.rect() : Rect{};
}

/// The solid's value along the lines of a band; `plane` may be null.
class TpmsLines : public LineFunction {
  public:
    TpmsLines(const TpmsSolid& solid, const RowBand& band, const std::vector<int>& lines, double z,
              const WallPlane* plane)
        : solid_(solid),
          band_(band),
          along_(band.axis == Axis::x ? 0 : 1),
          z_(z),
          unit_(std::abs(band.along_pitch) / run_unit) {
        const double period = solid.period(), center = solid.center()[1 - along_];
        for (const int l : lines) {
            places_.push_back(band.line(l));
            if (plane != nullptr) walls_.emplace_back(*plane, band.axis, (places_.back() - center) / period);
        }
    }

    void values(std::span<const LinePoint> points, std::span<double> out) const override {
        std::vector<dvec3> places(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            places[i].z = z_;
            places[i][along_] = band_.along(points[i].u);
            places[i][1 - along_] = places_[points[i].line];
        }
        if (walls_.empty()) return solid_.bounds(places, out);
        const double period = solid_.period(), center = solid_.center()[along_];
        solid_.thicknesses(places, out);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double turns = (places[i][along_] - center) / period;
            const double half = TpmsSolid::half_angle(out[i], period);
            out[i] = walls_[points[i].line].bound(turns, half) * (period / (2 * pi));
        }
    }
    double steepest(std::size_t /*line*/) const override { return unit_ * solid_.steepest(along_); }

  private:
    const TpmsSolid& solid_;
    const RowBand& band_;
    int along_;
    double z_, unit_;
    std::vector<double> places_;   // of the lines, mm
    std::vector<WallLine> walls_;  // along the lines, where they can be tabulated
};

}  // namespace

TpmsSlice::TpmsSlice(const Field& field, const TpmsSolid& solid, double z)
    : SampledSlice(field, z),
      solid_(solid),
      z_(z),
      region_(region_at(solid.region(), z)),
      height_(TpmsSolid::angle(z - solid.center().z, solid.period())) {
    if (solid.wall() != nullptr && solid.has_constant_period() && !region_.empty())
        plane_.emplace(*solid.wall(), height_);
}

void TpmsSlice::runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const {
    out.clear();
    if (solid_.is_constant()) {
        closed_spans(band, out);
    } else {
        walked_spans(band, out);
    }
}

void TpmsSlice::closed_spans(const RowBand& band, RunRows& out) const {
    const double period = solid_.period();
    const int along_axis = band.axis == Axis::x ? 0 : 1, across_axis = 1 - along_axis;
    const Interval lines = across(region_, band.axis), extent = along(region_, band.axis);
    // One pixel more than the band, because runs are clipped after rounding.
    const Interval wanted = along(grown(band.rect(), std::abs(band.along_pitch)), band.axis);
    const Interval clip{std::max(extent.lo, wanted.lo), std::min(extent.hi, wanted.hi)};
    std::vector<Interval> parts, intervals;
    for (int l = 0; l < band.lines(); ++l) {
        const double place = band.line(l);
        intervals.clear();
        if (lines.contains(place)) {
            const double distance = place - solid_.center()[across_axis];
            if (plane_) {
                WallLine(*plane_, band.axis, distance / period).find_runs(solid_.central_half(), parts);
            } else {
                const SineCosine turn = TpmsSolid::angle(distance, period);
                solid_.find_network_runs(band.axis, turn, height_, parts);
            }
            append_periodic_runs(parts, solid_.center()[along_axis], period, clip, intervals);
        }
        push_intervals(band, intervals, out);
    }
}

void TpmsSlice::walked_spans(const RowBand& band, RunRows& out) const {
    const Interval lines = across(region_, band.axis), extent = along(region_, band.axis);
    const double u0 = band.coordinate(extent.lo), u1 = band.coordinate(extent.hi);
    const std::int32_t lo = std::max(band.lo * run_unit, round_run(std::min(u0, u1)));
    const std::int32_t hi = std::min(band.hi * run_unit, round_run(std::max(u0, u1)));
    std::vector<int> walked;
    for (int l = 0; lo < hi && l < band.lines(); ++l) {
        if (lines.contains(band.line(l))) walked.push_back(l);
    }
    const auto end_lines = [&out](int count) {
        for (int l = 0; l < count; ++l) out.end_line();
    };
    end_lines(walked.empty() ? band.lines() : walked.front());
    walk_lines(TpmsLines(solid_, band, walked, z_, plane_ ? &*plane_ : nullptr), walked.size(), lo, hi, out);
    if (!walked.empty()) end_lines(band.lines() - 1 - walked.back());
}

void TpmsSlice::sample(const Tile& tile, std::span<float> out) const {
    if (!solid_.has_constant_period()) return SampledSlice::sample(tile, out);
    std::array<SineCosine, columns_at_once> columns;
    for (int first = 0; first < tile.nx; first += columns_at_once) {
        const int count = std::min(columns_at_once, tile.nx - first);
        for (int i = 0; i < count; ++i) {
            const double x = tile.origin.x + (first + i) * tile.step.x;
            columns[static_cast<std::size_t>(i)] = TpmsSolid::angle(x - solid_.center().x, solid_.period());
        }
        const std::span used(columns.data(), static_cast<std::size_t>(count));
        for (int j = 0; j < tile.ny; ++j) {
            sample_row(tile, first, used, tile.origin.y + j * tile.step.y,
                       out.subspan(static_cast<std::size_t>(j) * static_cast<std::size_t>(tile.nx) +
                                   static_cast<std::size_t>(first)));
        }
    }
}

void TpmsSlice::sample_row(const Tile& tile, int first, std::span<const SineCosine> columns, double y,
                           std::span<float> out) const {
    const double period = solid_.period();
    const SineCosine row = TpmsSolid::angle(y - solid_.center().y, period);
    std::array<dvec3, columns_at_once> places;
    std::array<double, columns_at_once> thicknesses;
    for (std::size_t i = 0; i < columns.size(); ++i)
        places[i] = {tile.origin.x + (first + static_cast<int>(i)) * tile.step.x, y, z_};
    solid_.thicknesses(std::span(places).first(columns.size()), std::span(thicknesses).first(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i)
        out[i] = static_cast<float>(solid_.value_at({columns[i], row, height_}, period, thicknesses[i]));
}

}  // namespace lamella
