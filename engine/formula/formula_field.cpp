// The field of a formula cut to its bounds: values at points, ranges over boxes, and slices by the tile walk
// with a program that is shortened from tile to tile.
#include "engine/formula/formula_field.h"

#include <algorithm>

#include "engine/field/slice_context.h"
#include "engine/field/tile_walk.h"
#include "engine/formula/formula_batch.h"
#include "engine/formula/formula_builder.h"
#include "engine/formula/formula_inputs.h"
#include "engine/formula/formula_slope.h"

namespace lamella {
namespace {

/// Maps NaN to outside (+infinity), so that a tile counts as full only if it surely has no NaN.
Interval field_range(const FormulaRange& r) {
    if (r.values.empty()) return {infinity, infinity};
    return {r.values.lo, r.maybe_nan ? infinity : r.values.hi};
}

/// The gradings of a formula, and which of them it reads.
struct Others {
    std::vector<GradingPtr> gradings;
    std::vector<std::size_t> read;
};

/// The formula in one plane, for the tile walk.
class WalkedFormula : public TileSampledSolid {
  public:
    WalkedFormula(const Formula& formula, const Others& others, double z, FormulaKeeps keeps)
        : stack_(formula, keeps), keeps_(keeps), others_(others), z_(z) {}

    Interval enter(const Rect& tile) override {
        fill_ranges({{tile.lo, z_}, {tile.hi, z_}}, others_.gradings, others_.read, ranges_);
        tile_ = tile;
        return field_range(stack_.enter(ranges_));
    }

    void leave() override { stack_.leave(); }

    SlopeBound slope(Axis lines) override {
        const std::uint32_t along = lines == Axis::x ? 0 : 1;
        const double length = lines == Axis::x ? tile_.hi.x - tile_.lo.x : tile_.hi.y - tile_.lo.y;
        return slopes_.bound(stack_.tape(), stack_.ranges(), along, length);
    }

    bool signs_only() const override { return keeps_ == FormulaKeeps::signs; }

    void values(const WalkPoints& points, std::span<double> out) override {
        if (prepared_ != stack_.version()) batch_.prepare(stack_.tape());
        prepared_ = stack_.version();
        const std::size_t width = points.along.size();
        const std::size_t lines = points.lattice ? points.across.size() : 1;
        // Pieces whose registers fit the first-level cache; long lists of points are cut along the line,
        // lattices across.
        const std::size_t piece = std::min(width, static_cast<std::size_t>(FormulaBatch::good_grid));
        const std::size_t high = std::max<std::size_t>(1, FormulaBatch::good_grid / piece);
        for (std::size_t i = 0; i < width; i += piece) {
            const std::size_t n = std::min(piece, width - i);
            for (std::size_t l = 0; l < lines; l += high) {
                const std::size_t m = std::min(high, lines - l);
                WalkPoints part = points;
                part.along = points.along.subspan(i, n);
                part.across = points.lattice ? points.across.subspan(l, m) : points.across.subspan(i, n);
                if (n == width) {
                    evaluate(part, m, n, out.subspan(l * width, m * n));
                } else {
                    piece_.resize(m * n);
                    evaluate(part, m, n, piece_);
                    for (std::size_t k = 0; k < m; ++k)
                        std::copy_n(piece_.data() + k * n, n, out.data() + (l + k) * width + i);
                }
            }
        }
    }

  private:
    void evaluate(const WalkPoints& points, std::size_t lines, std::size_t width, std::span<double> out) {
        const BatchInput along{points.along.data(), false, true};
        const BatchInput across{points.across.data(), points.lattice, !points.lattice};
        const bool rows = points.axis == Axis::x;
        inputs_.assign(3 + others_.gradings.size(), {});
        inputs_[0] = rows ? along : across;
        inputs_[1] = rows ? across : along;
        inputs_[2] = {&z_, false, false};
        graded_.resize(others_.read.size() * lines * width);
        places_.clear();
        if (!others_.read.empty()) points.each([&](dvec2 p) { places_.emplace_back(p, z_); });
        double* to = graded_.data();
        for (const std::size_t i : others_.read) {
            inputs_[3 + i] = {to, true, true};
            others_.gradings[i]->numbers(places_, {to, places_.size()});
            to += places_.size();
        }
        batch_.run(inputs_, static_cast<int>(lines), static_cast<int>(width), out);
    }

    FormulaStack stack_;
    FormulaKeeps keeps_;
    FormulaSlopes slopes_;
    FormulaBatch batch_;
    Rect tile_;
    const Others& others_;
    double z_;
    std::uint64_t prepared_ = ~std::uint64_t{0};  ///< version of the program in the batch
    std::vector<FormulaRange> ranges_;
    std::vector<BatchInput> inputs_;
    std::vector<dvec3> places_;
    std::vector<double> graded_, piece_;
};

/// Returns the formula with z fixed; subexpressions of z alone are folded.
Formula in_plane(const Formula& formula, double z) {
    FormulaBuilder builder;
    builder.fix_input(2, z);
    return builder.finish(builder.include(formula));
}

class FormulaSlice : public SliceField {
  public:
    FormulaSlice(const Formula& formula, const Others& others, const Box& bounds, Metric metric, double z)
        : fixed_(in_plane(formula, z)),
          others_{others.gradings, read_others(fixed_)},
          metric_(metric),
          z_(z),
          bounds_(bounds.lo.z < z && z < bounds.hi.z ? bounds.rect() : Rect{}) {}

    void runs(const RowBand& band, Scratch& /*scratch*/, RunRows& out) const override {
        WalkedFormula solid(fixed_, others_, z_,
                            metric_ == Metric::sign ? FormulaKeeps::signs : FormulaKeeps::numbers);
        sampled_spans(solid, metric_, band, out);
    }

    Interval range(const Rect& r) const override {
        std::vector<FormulaRange> inputs;
        fill_ranges({{r.lo, z_}, {r.hi, z_}}, others_.gradings, others_.read, inputs);
        return field_range(lamella::range(fixed_, inputs));
    }

    void sample(const Tile& tile, std::span<float> out) const override {
        if (tile.nx <= 0 || tile.ny <= 0) return;
        std::vector<double> along, across,
            values(static_cast<std::size_t>(tile.nx) * static_cast<std::size_t>(tile.ny));
        for (int i = 0; i < tile.nx; ++i) along.push_back(tile.origin.x + i * tile.step.x);
        for (int j = 0; j < tile.ny; ++j) across.push_back(tile.origin.y + j * tile.step.y);
        WalkedFormula solid(fixed_, others_, z_, FormulaKeeps::numbers);
        const dvec2 a(along.front(), across.front()), b(along.back(), across.back());
        solid.enter({glm::min(a, b), glm::max(a, b)});
        solid.values({Axis::x, along, across, true}, values);
        std::transform(values.begin(), values.end(), out.begin(),
                       [](double v) { return static_cast<float>(v); });
    }

    Rect bounds() const override { return bounds_; }

  private:
    Formula fixed_;
    Others others_;
    Metric metric_;
    double z_;
    Rect bounds_;
};

class FormulaField : public Field {
  public:
    FormulaField(Formula formula, std::vector<GradingPtr> others, const Box& bounds, Metric metric)
        : formula_(std::move(formula)),
          others_{std::move(others), read_others(formula_)},
          bounds_(bounds),
          metric_(metric) {}

    double value(dvec3 p) const override { return formula_at(formula_, others_.gradings, others_.read, p); }

    Interval range(const Box& box) const override {
        std::vector<FormulaRange> inputs;
        fill_ranges(box, others_.gradings, others_.read, inputs);
        return field_range(lamella::range(formula_, inputs));
    }

    Metric metric() const override { return metric_; }

    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<FormulaSlice>(formula_, others_, bounds_, metric_, z);
    }

    Box bounds() const override { return bounds_; }

  private:
    Formula formula_;
    Others others_;
    Box bounds_;
    Metric metric_;
};

/// Returns the formula's solid within the box: the maximum of the formula and the distance to the nearest
/// face.
Formula cut_to_box(const Formula& formula, const Box& box) {
    FormulaBuilder f;
    FormulaBuilder::Node faces = -1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto p = f.input(axis);
        const auto face = f.binary(FormulaOp::max, f.binary(FormulaOp::sub, f.constant(box.lo[axis]), p),
                                   f.binary(FormulaOp::sub, p, f.constant(box.hi[axis])));
        faces = faces < 0 ? face : f.binary(FormulaOp::max, faces, face);
    }
    return f.finish(f.binary(FormulaOp::max, f.include(formula), faces));
}

}  // namespace

FieldPtr make_formula_field(const Formula& formula, std::vector<GradingPtr> others, const Box& bounds,
                            Metric metric) {
    require_inputs(formula, others);
    const dvec3 size = bounds.size();
    if (!(size.x > 0 && size.y > 0 && size.z > 0) || !std::isfinite(size.x + size.y + size.z))
        throw InputError("a formula's solid needs a finite box with three positive sides");
    return std::make_shared<FormulaField>(cut_to_box(formula, bounds), std::move(others), bounds, metric);
}

}  // namespace lamella
