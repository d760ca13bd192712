// In-plane offsets: discs centred where lattice lines cross a section's border, added to the section or
// subtracted from it.
#include "engine/morphology/in_plane_offset.h"

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/runs/plane_lattice.h"
#include "engine/solids/line_frame.h"

namespace lamella {
namespace {

constexpr int lines_per_strip = 64;

/// Returns the points of a rectangle, and some around it, where lattice lines cross the section's border. Run
/// ends that only come from clipping lie outside the rectangle.
std::vector<dvec2> border_points(const SliceField& section, const Rect& rect, double pitch,
                                 Scratch& scratch) {
    std::vector<dvec2> points;
    const Rect met = intersect(rect, section.bounds());
    if (met.empty()) return points;
    const auto rows = scratch.rows();
    for (const Axis axis : {Axis::x, Axis::y}) {
        const RowBand all = plane_lattice(axis, met, pitch);
        RowBand band = all;
        for (; band.first < all.first + all.count; band.first += lines_per_strip) {
            band.count = std::min(lines_per_strip, all.first + all.count - band.first);
            section.runs(band, scratch, *rows);
            for (int l = 0; l < band.lines(); ++l) {
                const double across = band.line(l);
                const auto add = [&](std::int32_t u) {
                    const double along = band.along(u);
                    points.push_back(axis == Axis::x ? dvec2(along, across) : dvec2(across, along));
                };
                for (const Run& run : rows->line(static_cast<std::size_t>(l))) {
                    add(run.begin);
                    add(run.end);
                }
            }
        }
    }
    return points;
}

/// Rounds to the nearest run coordinate, halves upward, with the same result as round_run. Uses only
/// operations that compilers vectorise.
std::int32_t rounded(double u) {
    constexpr double limit = 1 << 30;
    const double up = std::min(std::max(u, -limit), limit) + 0.5;
    const auto towards_zero = static_cast<std::int32_t>(up);
    return towards_zero - static_cast<std::int32_t>(up < towards_zero);
}

/// Discs of one radius as runs on the lines of a band.
class DiscRows {
  public:
    DiscRows(const RowBand& band, double radius)
        : band_(band), radius_(radius), units_per_mm_(run_unit / std::abs(band.along_pitch)) {
        for (int l = 0; l < band.lines(); ++l) positions_.push_back(band.line(l));
    }

    void collect(dvec2 center, RunCollector& collector) const {
        const int along = band_.axis == Axis::x ? 0 : 1;
        const double across = center[1 - along], middle = band_.coordinate(center[along]);
        // Rounding differs between bands and must not decide whether the disc meets a line: the range is
        // widened a little.
        constexpr double margin = 1e-6;
        const LineRange lines = lines_across(band_, {across - radius_ - margin, across + radius_ + margin});
        const int count = lines.last - lines.first;
        if (count <= 0) return;
        const auto runs = collector.add(lines.first, count);
        const double* const positions = positions_.data() + lines.first;
        const double square = radius_ * radius_;
        for (int i = 0; i < count; ++i) {
            const double off = positions[i] - across;
            const double half = std::sqrt(std::max(square - off * off, 0.0)) * units_per_mm_;
            runs.begin[i] = rounded(middle - half);
            runs.end[i] = rounded(middle + half);
        }
    }

  private:
    const RowBand& band_;
    double radius_, units_per_mm_;
    std::vector<double> positions_;  ///< of the lines, across them, mm
};

class OffsetSlice : public SliceField {
  public:
    OffsetSlice(const SliceField& section, double by, double pitch)
        : section_(section), by_(by), radius_(std::abs(by)), pitch_(pitch) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        const auto points = border_points(section_, grown(band.rect(), radius_), pitch_, scratch);
        const auto discs = scratch.rows();
        scratch.collector.clear();
        const DiscRows disc(band, radius_);
        for (const dvec2 p : points) disc.collect(p, scratch.collector);
        scratch.collector.merge(band, *discs);
        const auto before = scratch.rows();
        section_.runs(band, scratch, *before);
        if (by_ > 0) {
            unite(*before, *discs, out);
        } else {
            subtract(*before, *discs, out);
        }
    }

    Interval range(const Rect& r) const override { return moved(section_.range(r)); }

    /// The value of a disc is the signed distance to it, clamped to the radius.
    void sample(const Tile& tile, std::span<float> out) const override {
        section_.sample(tile, out);
        std::vector<double> nearest(out.size(), 4 * radius_ * radius_);
        Scratch scratch;
        const dvec2 far = tile.origin + tile.step * dvec2(tile.nx - 1, tile.ny - 1);
        const Rect rect{glm::min(tile.origin, far), glm::max(tile.origin, far)};
        for (const dvec2 p : border_points(section_, grown(rect, 2 * radius_), pitch_, scratch)) {
            visit_near(tile, p, 2 * radius_,
                       [&](std::size_t k, double square) { nearest[k] = std::min(nearest[k], square); });
        }
        for (std::size_t k = 0; k < out.size(); ++k) {
            const double disc = std::sqrt(nearest[k]) - radius_, v = out[k];
            out[k] = static_cast<float>(moved_value(v, disc));
        }
    }

    Rect bounds() const override {
        const Rect rect = section_.bounds();
        return rect.empty() || by_ < 0 ? rect : grown(rect, by_);
    }

  private:
    /// Combines the section's value v with the value `disc` of the nearest disc (-radius to radius). A NaN v
    /// counts as outside.
    double moved_value(double v, double disc) const {
        if (by_ > 0) return std::isnan(v) ? (disc < 0 ? disc : v) : std::min(v, disc);
        return std::isnan(v) ? v : std::max(v, -disc);
    }
    Interval moved(Interval v) const {
        if (by_ > 0) return {std::min(v.lo, -radius_), std::min(v.hi, radius_)};
        return {std::max(v.lo, -radius_), std::max(v.hi, radius_)};
    }

    /// Calls visit(k, squared distance) for the sample points of a tile near `place`.
    template <typename Visit>
    static void visit_near(const Tile& tile, dvec2 place, double reach, const Visit& visit) {
        const auto from = [&](int axis, int count) {
            const double a = (place[axis] - reach - tile.origin[axis]) / tile.step[axis],
                         b = (place[axis] + reach - tile.origin[axis]) / tile.step[axis];
            const auto index = [&](double i) {
                return static_cast<int>(std::min(std::max(i, 0.0), static_cast<double>(count)));
            };
            return std::pair(index(std::ceil(std::min(a, b))), index(std::floor(std::max(a, b)) + 1));
        };
        const auto [i0, i1] = from(0, tile.nx);
        const auto [j0, j1] = from(1, tile.ny);
        for (int j = j0; j < j1; ++j) {
            for (int i = i0; i < i1; ++i) {
                const dvec2 off = tile.origin + tile.step * dvec2(i, j) - place;
                visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(tile.nx) +
                          static_cast<std::size_t>(i),
                      off.x * off.x + off.y * off.y);
            }
        }
    }

    const SliceField& section_;
    double by_, radius_, pitch_;
};

class InPlaneOffset : public Field {
  public:
    InPlaneOffset(FieldPtr solid, OutlineOffset offset, double pitch)
        : solid_(std::move(solid)), offset_(std::move(offset)), pitch_(pitch) {}

    double value(dvec3 p) const override {
        SliceContext context;
        float v = 0;
        slice(context, p.z).sample({dvec2(p), dvec2(1), 1, 1}, std::span(&v, 1));
        return v;
    }
    Interval range(const Box& box) const override {
        const Interval v = solid_->range(box);
        const double grows = std::max(offset_.limits.hi, 0.0), shrinks = std::max(-offset_.limits.lo, 0.0);
        return {grows > 0 ? std::min(v.lo, -grows) : v.lo, shrinks > 0 ? std::max(v.hi, shrinks) : v.hi};
    }
    Metric metric() const override { return Metric::sign; }
    const SliceField& slice(SliceContext& context, double z) const override {
        const SliceField& section = context.slice(*solid_, z);
        const double by = offset_.at(z);
        return by == 0 ? section : context.make<OffsetSlice>(section, by, pitch_);
    }
    Box bounds() const override {
        Box box = solid_->bounds();
        const double by = std::max(offset_.limits.hi, 0.0);
        if (box.empty()) return box;
        box.lo -= dvec3(by, by, 0);
        box.hi += dvec3(by, by, 0);
        return box;
    }

  private:
    FieldPtr solid_;
    OutlineOffset offset_;
    double pitch_;
};

}  // namespace

FieldPtr make_in_plane_offset(FieldPtr solid, OutlineOffset offset, double tolerance) {
    if (!solid || !offset.at) throw InputError("an in-plane offset needs a solid and a distance");
    if (!std::isfinite(offset.limits.lo) || !std::isfinite(offset.limits.hi))
        throw InputError("an in-plane offset needs finite distances");
    if (!(tolerance > 0) || !std::isfinite(tolerance))
        throw InputError("an in-plane offset needs a positive, finite tolerance");
    return std::make_shared<InPlaneOffset>(std::move(solid), std::move(offset), tolerance);
}

}  // namespace lamella
