// Finds where the edges of a lattice cross the surface, and takes central differences there.
#include "procedural/grading/field_slope.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"

namespace lamella {
namespace {

constexpr int slope_cells = 24;
constexpr int halvings = 24;  // of an edge: finds the surface to 1e-7 of it
constexpr double step_in_cells = 1e-3;
// The slope is measured again over a step shorter by this factor. It stays the same for smooth values, and
// grows by this factor at a jump.
constexpr double jump = 4;

double slope_at(const Field& field, dvec3 p, double step) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        dvec3 along(0);
        along[axis] = step;
        const double slope = (field.value(p + along) - field.value(p - along)) / (2 * step);
        square += slope * slope;
    }
    return std::sqrt(square);
}

/// Returns a point of the surface between a point inside and one outside, by bisection.
dvec3 crossing(const Field& field, dvec3 inside, dvec3 outside) {
    for (int i = 0; i < halvings; ++i) {
        const dvec3 middle = (inside + outside) * 0.5;
        (field.value(middle) < 0 ? inside : outside) = middle;
    }
    return (inside + outside) * 0.5;
}

/// Visits the lattice's edges plane by plane.
class SurfaceSlopes {
  public:
    SurfaceSlopes(const Field& field, const Box& box) : field_(field), box_(box) {
        const dvec3 size = box.size();
        pitch_ = std::max({size.x, size.y, size.z}) / slope_cells;
        count_ = glm::ivec3(glm::max(glm::ceil(size / pitch_), dvec3(1))) + 1;
    }

    double greatest() {
        std::vector<double> below, here;
        for (int k = 0; k < count_.z; ++k) {
            below.swap(here);
            here.clear();
            for (int j = 0; j < count_.y; ++j) {
                for (int i = 0; i < count_.x; ++i) {
                    const auto at = here.size();
                    here.push_back(field_.value(point({i, j, k})));
                    if (i > 0) edge({i, j, k}, here[at], 0, here[at - 1]);
                    if (j > 0) edge({i, j, k}, here[at], 1, here[at - static_cast<std::size_t>(count_.x)]);
                    if (k > 0) edge({i, j, k}, here[at], 2, below[at]);
                }
            }
        }
        return greatest_ > 0 ? greatest_ : 1;
    }

  private:
    dvec3 point(glm::ivec3 i) const { return box_.lo + box_.size() * dvec3(i) / dvec3(count_ - 1); }

    /// Measures the slope on the edge to a point from the previous one along an axis.
    void edge(glm::ivec3 to, double value, int axis, double value_before) {
        if ((value < 0) == (value_before < 0)) return;
        glm::ivec3 from = to;
        --from[axis];
        const dvec3 a = point(from), b = point(to);
        const dvec3 p = value < 0 ? crossing(field_, b, a) : crossing(field_, a, b);
        const double step = step_in_cells * pitch_;
        const double slope = slope_at(field_, p, step), closer = slope_at(field_, p, step / jump);
        if (!std::isfinite(slope) || !std::isfinite(closer)) return;
        if (closer > slope * (jump / 2)) {
            throw InputError(
                fmt::format("its values jump at ({:.4g}, {:.4g}, {:.4g}) mm, which leaves no width to "
                            "blend over; accepted: blend = 0, or values that pass through 0",
                            p.x, p.y, p.z));
        }
        greatest_ = std::max(greatest_, slope);
    }

    const Field& field_;
    Box box_;
    double pitch_ = 0;
    glm::ivec3 count_{0};
    double greatest_ = 0;
};

class DividedSlice : public SliceField {
  public:
    DividedSlice(const SliceField& slice, double divisor) : slice_(slice), divisor_(divisor) {}
    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        slice_.runs(band, scratch, out);
    }
    Interval range(const Rect& r) const override {
        const Interval all = slice_.range(r);
        return {all.lo / divisor_, all.hi / divisor_};
    }
    void sample(const Tile& tile, std::span<float> out) const override {
        slice_.sample(tile, out);
        for (float& v : out) v = static_cast<float>(v / divisor_);
    }
    Rect bounds() const override { return slice_.bounds(); }

  private:
    const SliceField& slice_;
    double divisor_;
};

/// A field with values divided by a number; the solid is the same.
class Divided : public Field {
  public:
    Divided(FieldPtr field, double divisor) : field_(std::move(field)), divisor_(divisor) {}
    double value(dvec3 p) const override { return field_->value(p) / divisor_; }
    Interval range(const Box& box) const override {
        const Interval r = field_->range(box);
        return {r.lo / divisor_, r.hi / divisor_};
    }
    Metric metric() const override { return field_->metric(); }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<DividedSlice>(context.slice(*field_, z), divisor_);
    }
    Box bounds() const override { return field_->bounds(); }

  private:
    FieldPtr field_;
    double divisor_;
};

}  // namespace

double slope_at_surface(const Field& field, const Box& box) { return SurfaceSlopes(field, box).greatest(); }

FieldPtr make_unit_slope(FieldPtr field, const Box& box) {
    const double slope = slope_at_surface(*field, box);
    return std::make_shared<Divided>(std::move(field), slope);
}

}  // namespace lamella
