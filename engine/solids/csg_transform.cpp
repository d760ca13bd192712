// Affine maps of solids. An axis-aligned map only rewrites the requested band.
#include "engine/base/box_image.h"
#include "engine/base/error.h"
#include "engine/solids/closed_slice.h"
#include "engine/solids/csg.h"

namespace lamella {
namespace {

/// The slice of a solid under p -> scale * p + shift, separately per axis.
class AlignedSlice : public SliceField {
  public:
    AlignedSlice(const SliceField& inner, dvec2 scale, dvec2 shift, double value_scale)
        : inner_(inner), scale_(scale), shift_(shift), value_scale_(value_scale) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
        RowBand inner = band;
        inner.along_origin = (band.along_origin - shift_[along]) / scale_[along];
        inner.along_pitch = band.along_pitch / scale_[along];
        inner.across_origin = (band.across_origin - shift_[across]) / scale_[across];
        inner.across_pitch = band.across_pitch / scale_[across];
        inner_.runs(inner, scratch, out);
    }
    Interval range(const Rect& r) const override {
        const dvec2 a = (r.lo - shift_) / scale_, b = (r.hi - shift_) / scale_;
        const Interval v = inner_.range({glm::min(a, b), glm::max(a, b)});
        return {v.lo * value_scale_, v.hi * value_scale_};
    }
    void sample(const Tile& tile, std::span<float> out) const override {
        inner_.sample({(tile.origin - shift_) / scale_, tile.step / scale_, tile.nx, tile.ny}, out);
        for (float& v : out) v = static_cast<float>(v * value_scale_);
    }
    Rect bounds() const override {
        const Rect r = inner_.bounds();
        if (r.empty()) return r;
        const dvec2 a = r.lo * scale_ + shift_, b = r.hi * scale_ + shift_;
        return {glm::min(a, b), glm::max(a, b)};
    }

  private:
    const SliceField& inner_;
    dvec2 scale_, shift_;
    double value_scale_;
};

/// Smallest stretch of the map: 1 over the largest singular value of the inverse, bounded by its Frobenius
/// norm. Exact for similarities, whose columns are orthogonal and of equal length.
struct Stretch {
    double least;
    bool similarity;
};

Stretch stretch_of(const glm::dmat3& linear, const glm::dmat3& inverse) {
    const glm::dmat3 gram = glm::transpose(linear) * linear;
    const double square = gram[0][0];
    double off = 0, frobenius = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            off = std::max(off, std::abs(gram[i][j] - (i == j ? square : 0.0)));
            frobenius += inverse[i][j] * inverse[i][j];
        }
    }
    if (off <= 1e-12 * square) return {std::sqrt(square), true};
    const bool diagonal = gram[0][1] == 0 && gram[0][2] == 0 && gram[1][2] == 0;
    if (diagonal) return {std::sqrt(std::min(gram[0][0], std::min(gram[1][1], gram[2][2]))), false};
    return {1 / std::sqrt(frobenius), false};
}

class Transformed : public Field {
  public:
    Transformed(FieldPtr solid, const glm::dmat3& linear, dvec3 translation)
        : solid_(std::move(solid)),
          linear_(linear),
          inverse_(glm::inverse(linear)),
          translation_(translation),
          stretch_(stretch_of(linear, inverse_)) {}

    double value(dvec3 p) const override {
        return solid_->value(inverse_ * (p - translation_)) * stretch_.least;
    }
    Interval range(const Box& box) const override {
        const Interval v = solid_->range(image_of(box, inverse_, -(inverse_ * translation_)));
        return {v.lo * stretch_.least, v.hi * stretch_.least};
    }
    void values(std::span<const dvec3> points, std::span<double> out) const override {
        std::vector<dvec3> inner;
        inner.reserve(points.size());
        for (const dvec3& p : points) inner.push_back(inverse_ * (p - translation_));
        solid_->values(inner, out);
        for (double& value : out) value *= stretch_.least;
    }
    void ranges(std::span<const Box> boxes, std::span<Interval> out) const override {
        std::vector<Box> inner;
        inner.reserve(boxes.size());
        for (const Box& box : boxes) inner.push_back(image_of(box, inverse_, -(inverse_ * translation_)));
        solid_->ranges(inner, out);
        for (Interval& v : out) v = {v.lo * stretch_.least, v.hi * stretch_.least};
    }
    bool takes_many() const override { return solid_->takes_many(); }
    Metric metric() const override {
        const Metric inner = solid_->metric();
        return inner == Metric::exact && !stretch_.similarity ? Metric::bound : inner;
    }
    FieldPtr offset(double d) const override {
        if (!stretch_.similarity) return nullptr;
        FieldPtr moved = solid_->offset(d / stretch_.least);
        return moved ? make_transform(std::move(moved), linear_, translation_) : nullptr;
    }
    const SliceField& slice(SliceContext& context, double z) const override {
        const bool aligned = linear_[0][1] == 0 && linear_[0][2] == 0 && linear_[1][0] == 0 &&
                             linear_[1][2] == 0 && linear_[2][0] == 0 && linear_[2][1] == 0;
        if (!aligned) return Field::slice(context, z);
        const SliceField& inner = context.slice(*solid_, (z - translation_.z) / linear_[2][2]);
        return context.make<AlignedSlice>(inner, dvec2(linear_[0][0], linear_[1][1]), dvec2(translation_),
                                          stretch_.least);
    }
    Box bounds() const override { return image_of(solid_->bounds(), linear_, translation_); }

  private:
    FieldPtr solid_;
    glm::dmat3 linear_, inverse_;
    dvec3 translation_;
    Stretch stretch_;
};

}  // namespace

FieldPtr make_transform(FieldPtr solid, const glm::dmat3& linear, dvec3 translation) {
    if (!solid) throw InputError("a transform was given a missing solid");
    const double determinant = glm::determinant(linear);
    if (!std::isfinite(determinant) || determinant == 0) {
        throw InputError("a transform's matrix must be invertible");
    }
    return std::make_shared<Transformed>(std::move(solid), linear, translation);
}

}  // namespace lamella
