// Mended outlines: on lattice lines fixed in the plane, runs of disc centres (cores) are found; their discs
// are united with the section.
#include "engine/morphology/mended_outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/morphology/layer_offset.h"
#include "engine/morphology/thin_features.h"
#include "engine/runs/plane_lattice.h"
#include "engine/runs/row_sets.h"
#include "engine/solids/line_frame.h"

namespace lamella {
namespace {

constexpr double outline_slack_share = 1.5;  // slack as a share of the radius; see Thinness
constexpr int levels = 4;                    // number of radii that are tried in thin parts

/// A segment along x; discs are centred at all of its points. Lengths in mm.
struct Core {
    double from, to;
    double y;
};

/// How a section is mended. Lengths in mm.
struct Mending {
    double pitch;   ///< pitch of the lattice
    double ball;    ///< radius of the ball that measures thickness
    double radius;  ///< radius of the discs that are added
    /// Finds the cores in rows of the section. Lengths in run units.
    void (*cores)(const RunRows& rows, double radius, RunRows& out);
};

void grow(const RunRows& rows, double radius, RunRows& out) {
    grow_rows(WeightedRows(rows, radius), run_unit, out);
}

/// Finds the disc centres that widen thin walls: with discs of `radius` there, no wall is thinner than a
/// disc.
void cores_of_thin(const RunRows& rows, double radius, RunRows& out) {
    RunRows thin, shrunk, larger, some, all;
    thin_rows(rows, FeatureKind::wall, {radius, outline_slack_share * radius + run_unit}, run_unit, thin);
    out = empty_rows(rows.lines());
    for (int level = levels - 1; level >= 0 && !thin.runs().empty(); --level) {
        const double r = radius * level / levels;
        shrink_rows(rows, r, run_unit, shrunk);
        intersect(shrunk, thin, some);
        unite(out, some, all);
        std::swap(out, all);
        // Parts near a disc of this radius need no smaller one.
        grow(some, (1 + outline_slack_share) * r + run_unit, larger);
        subtract(thin, larger, some);
        std::swap(thin, some);
    }
}

void cores_of_narrow(const RunRows& rows, double radius, RunRows& out) {
    thin_rows(rows, FeatureKind::gap, {radius, outline_slack_share * radius + run_unit}, run_unit, out);
}

class MendedSlice : public SliceField {
  public:
    MendedSlice(const SliceField& section, const Mending& mending) : section_(section), mending_(mending) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        const auto discs = scratch.rows();
        const std::vector<Core> cores = cores_about(band.rect(), scratch);
        if (cores.empty()) return section_.runs(band, scratch, out);
        scratch.collector.clear();
        for (const Core& core : cores) {
            if (band.axis == Axis::x) {
                collect_row(core, band, scratch.collector);
            } else {
                collect_column(core, band, scratch.collector);
            }
        }
        scratch.collector.merge(band, *discs);
        const auto before = scratch.rows();
        section_.runs(band, scratch, *before);
        unite(*before, *discs, out);
    }

    Interval range(const Rect& r) const override {
        const Interval v = section_.range(r);
        return {std::min(v.lo, -mending_.radius), v.hi};
    }

    /// Up to one radius outside a disc, the value is at most the signed distance to the disc.
    void sample(const Tile& tile, std::span<float> out) const override {
        section_.sample(tile, out);
        Scratch scratch;
        const dvec2 far = tile.origin + tile.step * dvec2(tile.nx - 1, tile.ny - 1);
        const Rect rect = grown({glm::min(tile.origin, far), glm::max(tile.origin, far)}, mending_.radius);
        for (const Core& core : cores_about(rect, scratch)) {
            for (std::size_t k = 0; k < out.size(); ++k) {
                const auto nx = static_cast<std::size_t>(tile.nx);
                const dvec2 p = tile.origin + tile.step * dvec2(k % nx, k / nx);
                const double dx = std::max({core.from - p.x, p.x - core.to, 0.0}), dy = p.y - core.y;
                const double disc = std::sqrt(dx * dx + dy * dy) - mending_.radius;
                if (!(disc < mending_.radius)) continue;
                out[k] = std::isnan(out[k]) ? (disc < 0 ? static_cast<float>(disc) : out[k])
                                            : std::min(out[k], static_cast<float>(disc));
            }
        }
    }

    Rect bounds() const override {
        const Rect rect = section_.bounds();
        return rect.empty() ? rect : grown(rect, mending_.radius);
    }

  private:
    /// Returns the cores whose discs may reach a rectangle.
    std::vector<Core> cores_about(const Rect& rect, Scratch& scratch) const {
        std::vector<Core> cores;
        // Whether a point is a core depends on the section within the ball's diameter and slack.
        const double away = mending_.radius + (2 + outline_slack_share) * mending_.ball + 3 * mending_.pitch;
        if (intersect(grown(rect, mending_.radius), section_.bounds()).empty()) return cores;
        const Rect met = intersect(grown(rect, away), section_.bounds());
        if (met.empty()) return cores;
        const RowBand lines = plane_lattice(Axis::x, met, mending_.pitch);
        const auto rows = scratch.rows(), found = scratch.rows();
        section_.runs(lines, scratch, *rows);
        if (rows->runs().empty()) return cores;
        mending_.cores(*rows, mending_.ball / mending_.pitch * run_unit, *found);
        const Rect near = grown(rect, mending_.radius);
        for (std::size_t l = 0; l < found->lines(); ++l) {
            const double y = lines.line(static_cast<int>(l));
            if (y < near.lo.y || y > near.hi.y) continue;
            for (const Run& run : found->line(l)) {
                const Core core{lines.along(run.begin), lines.along(run.end), y};
                if (core.to >= near.lo.x && core.from <= near.hi.x) cores.push_back(core);
            }
        }
        return cores;
    }

    void collect_row(const Core& core, const RowBand& band, RunCollector& collector) const {
        const double r = mending_.radius;
        const LineRange lines = lines_across(band, {core.y - r, core.y + r});
        const int count = lines.last - lines.first;
        if (count <= 0) return;
        const auto runs = collector.add(lines.first, count);
        const double a = band.coordinate(core.from), b = band.coordinate(core.to),
                     per_mm = run_unit / std::abs(band.along_pitch);
        for (int i = 0; i < count; ++i) {
            const double off = band.line(lines.first + i) - core.y;
            const double half = std::sqrt(std::max(r * r - off * off, 0.0)) * per_mm;
            runs.begin[i] = round_run(std::min(a, b) - half);
            runs.end[i] = round_run(std::max(a, b) + half);
        }
    }
    void collect_column(const Core& core, const RowBand& band, RunCollector& collector) const {
        const double r = mending_.radius;
        const LineRange lines = lines_across(band, {core.from - r, core.to + r});
        const int count = lines.last - lines.first;
        if (count <= 0) return;
        const auto runs = collector.add(lines.first, count);
        const double middle = band.coordinate(core.y), per_mm = run_unit / std::abs(band.along_pitch);
        for (int i = 0; i < count; ++i) {
            const double x = band.line(lines.first + i);
            const double off = std::max({core.from - x, x - core.to, 0.0});
            const double half = std::sqrt(std::max(r * r - off * off, 0.0)) * per_mm;
            runs.begin[i] = round_run(middle - half);
            runs.end[i] = round_run(middle + half);
        }
    }

    const SliceField& section_;
    Mending mending_;
};

class MendedOutline : public Field {
  public:
    MendedOutline(FieldPtr solid, const Mending& mending) : solid_(std::move(solid)), mending_(mending) {}

    double value(dvec3 p) const override {
        SliceContext context;
        float v = 0;
        slice(context, p.z).sample({dvec2(p), dvec2(1), 1, 1}, std::span(&v, 1));
        return v;
    }
    Interval range(const Box& box) const override {
        const Interval v = solid_->range(box);
        return {std::min(v.lo, -mending_.radius), v.hi};
    }
    Metric metric() const override { return Metric::sign; }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<MendedSlice>(context.slice(*solid_, z), mending_);
    }
    Box bounds() const override {
        Box box = solid_->bounds();
        if (box.empty()) return box;
        box.lo -= dvec3(mending_.radius, mending_.radius, 0);
        box.hi += dvec3(mending_.radius, mending_.radius, 0);
        return box;
    }

  private:
    FieldPtr solid_;
    Mending mending_;
};

void check(const FieldPtr& solid, double thickness, double pitch) {
    if (!solid) throw InputError("mending an outline needs a solid");
    if (!(thickness > 0) || !std::isfinite(thickness) || !(pitch > 0) || !(4 * pitch <= thickness))
        throw InputError("mending an outline needs a thickness and a pitch of at most a fourth of it");
}

}  // namespace

FieldPtr make_thickened(FieldPtr solid, double thickness, double pitch) {
    check(solid, thickness, pitch);
    return std::make_shared<MendedOutline>(std::move(solid),
                                           Mending{pitch, 0.5 * thickness, 0.5 * thickness, cores_of_thin});
}

FieldPtr make_gaps_filled(FieldPtr solid, double gap, double pitch) {
    check(solid, gap, pitch);
    // Discs with a radius of one pitch leave no gap between neighbouring lines, nor between them and the
    // solid.
    return std::make_shared<MendedOutline>(std::move(solid),
                                           Mending{pitch, 0.5 * gap, pitch, cores_of_narrow});
}

}  // namespace lamella
