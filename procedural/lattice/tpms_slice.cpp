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
constexpr double same_thickness = 1e-9;  // mm: rounding of a thickness that depends on z alone

Interval along(const Rect& rect, Axis axis) {
    return axis == Axis::x ? Interval{rect.lo.x, rect.hi.x} : Interval{rect.lo.y, rect.hi.y};
}

Interval across(const Rect& rect, Axis axis) { return along(rect, axis == Axis::x ? Axis::y : Axis::x); }

Rect region_at(const Box& region, double z) {
    return region.lo.z <= z && z <= region.hi.z ? region.rect() : Rect{};
}

/// g along a line.
struct WaveLine {
    Wave wave;
    double steepest;  ///< maximum slope, as a share of the maximum gradient of g
    double crest;     ///< angle of its maximum, turns

    WaveLine(const Wave& along, double steepest_wave) : wave(along), steepest(0), crest(0) {
        const double amplitude = wave.amplitude();
        if (!(amplitude > 0)) return;
        steepest = amplitude / steepest_wave;
        crest = turns_of(wave.cosine / amplitude, wave.sine / amplitude);
    }
    /// Whether the slope is greater than `change` all the way between two angles in turns.
    bool is_steeper(double from, double to, double change) const {
        // It is a sine of the angle from the crest, and a sine lies above its chords.
        const double a = 2 * (from - crest), b = 2 * (to - crest), half = std::floor(a);
        if (std::floor(b) != half) return false;
        return 2 * steepest * std::min(a - half, half + 1 - b) > change;
    }
};

/// The solid's value along the lines of a band; `plane` is of a sheet with a constant period, and may be
/// null.
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
        const bool has_waves = solid.has_constant_period() && solid.wall() == nullptr;
        const SineCosine height = TpmsSolid::angle(z - solid.center().z, period);
        for (const int l : lines) {
            places_.push_back(band.line(l));
            const double across = places_.back() - center;
            if (plane != nullptr) walls_.emplace_back(*plane, band.axis, across / period);
            if (!has_waves) continue;
            const SineCosine turn = TpmsSolid::angle(across, period);
            waves_.emplace_back(tpms_wave(solid.kind(), band.axis, turn, height), solid.steepest_wave());
        }
    }

    void values(std::span<const LinePoint> points, std::span<double> out) const override {
        std::vector<dvec3> places(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            places[i].z = z_;
            places[i][along_] = band_.along(points[i].u);
            places[i][1 - along_] = places_[points[i].line];
        }
        if (walls_.empty() && waves_.empty()) return solid_.bounds(places, out);
        solid_.thicknesses(places, out);
        if (waves_.empty()) {
            wall_values(points, places, out);
        } else {
            network_values(points, places, out);
        }
    }
    double steepest(std::size_t /*line*/) const override { return unit_ * solid_.steepest(along_); }
    bool is_monotone(std::size_t line, double u0, double u1) const override {
        if (walls_.empty() && waves_.empty()) return false;
        double from = turns_at(band_.along(u0)), to = turns_at(band_.along(u1));
        if (from > to) std::swap(from, to);
        const double change = solid_.graded_change(along_);
        return waves_.empty() ? walls_[line].is_monotone(from, to, change)
                              : waves_[line].is_steeper(from, to, change);
    }

  private:
    /// `out`: the thicknesses, and after it the values.
    void wall_values(std::span<const LinePoint> points, std::span<const dvec3> places,
                     std::span<double> out) const {
        const double period = solid_.period();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double half = TpmsSolid::half_angle(out[i], period);
            out[i] = walls_[points[i].line].bound(turns_at(places[i][along_]), half) * (period / (2 * pi));
        }
    }
    void network_values(std::span<const LinePoint> points, std::span<const dvec3> places,
                        std::span<double> out) const {
        std::vector<double> angles(points.size());
        std::vector<SineCosine> turns(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) angles[i] = turns_at(places[i][along_]) * (2 * pi);
        sines_cosines(angles, turns);
        for (std::size_t i = 0; i < points.size(); ++i)
            out[i] = solid_.network_value(waves_[points[i].line].wave.at(turns[i]), out[i]);
    }
    double turns_at(double place) const { return (place - solid_.center()[along_]) / solid_.period(); }

    const TpmsSolid& solid_;
    const RowBand& band_;
    int along_;
    double z_, unit_;
    std::vector<double> places_;  // of the lines, mm
    // Along the lines, if the period is constant: the distance from a sheet, or g of a network.
    std::vector<WallLine> walls_;
    std::vector<WaveLine> waves_;
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
    if (solid.has_constant_period() && !region_.empty()) {
        const Interval thickness = solid.thickness_over({{region_.lo, z}, {region_.hi, z}});
        if (thickness.width() <= same_thickness) thickness_ = solid.thickness_at({region_.center(), z});
    }
}

void TpmsSlice::runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const {
    out.clear();
    if (thickness_) {
        closed_spans(band, *thickness_, out);
    } else {
        walked_spans(band, out);
    }
}

void TpmsSlice::closed_spans(const RowBand& band, double thickness, RunRows& out) const {
    const double period = solid_.period(), half_angle = TpmsSolid::half_angle(thickness, period);
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
                WallLine(*plane_, band.axis, distance / period).find_runs(half_angle, parts);
            } else {
                const SineCosine turn = TpmsSolid::angle(distance, period);
                solid_.find_network_runs(band.axis, turn, height_, thickness, parts);
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
