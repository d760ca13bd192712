// Runs of a layer's boxes, by themselves or subtracted from a solid's runs.
#include "engine/solids/box_solid.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/field/tile_walk.h"
#include "engine/solids/line_frame.h"

namespace lamella {
namespace {

/// Returns the lines of the band in the half-open interval [lo, hi), whichever way lines are counted.
/// Compares the lines' own positions, so that the answer for a line is the same in every band.
LineRange owned_lines(const RowBand& band, const Interval& across) {
    LineRange lines = lines_across(band, across);
    lines.first = std::max(0, lines.first - 1);
    lines.last = std::min(band.lines(), lines.last + 1);
    const auto owned = [&](int l) { return across.lo <= band.line(l) && band.line(l) < across.hi; };
    while (lines.first < lines.last && !owned(lines.first)) ++lines.first;
    while (lines.first < lines.last && !owned(lines.last - 1)) --lines.last;
    return lines;
}

/// Computes the runs of the boxes at height z on the lines of the band. Returns false, and leaves `out` as it
/// was, when there are none.
bool box_spans(const RunBoxes& plan, double z, const RowBand& band, RunCollector& boxes, RunRows& out) {
    const int along = band.axis == Axis::x ? 0 : 1, across = 1 - along;
    const Rect rect = band.rect();
    boxes.clear();
    bool any = false;
    for (const PlacedRun& run : plan.at(z)) {
        const Rect box = plan.grid().box(run).rect();
        if (intersect(box, rect).empty()) continue;
        const LineRange lines = owned_lines(band, {box.lo[across], box.hi[across]});
        const int count = lines.last - lines.first;
        if (count <= 0) continue;
        any = true;
        const double u = band.coordinate(box.lo[along]), v = band.coordinate(box.hi[along]);
        const auto segment = boxes.add(lines.first, count);
        std::fill_n(segment.begin, count, round_run(std::min(u, v)));
        std::fill_n(segment.end, count, round_run(std::max(u, v)));
    }
    if (any) boxes.merge(band, out);
    return any;
}

/// Returns the depth of a point in the box that holds it. Always positive, because a box owns its lower
/// faces.
double depth_in(const Box& box, dvec3 p) {
    const dvec3 depth = glm::min(p - box.lo, box.hi - p);
    const double inner = std::min(depth.x, std::min(depth.y, depth.z));
    return std::max(inner, std::numeric_limits<double>::denorm_min());
}

/// Computes the runs of a slice without the boxes at a height of their grid.
void runs_without(const SliceField& solid, const RunBoxes& boxes, double z, const RowBand& band,
                  Scratch& scratch, RunRows& out) {
    solid.runs(band, scratch, out);
    const auto taken = scratch.rows(), rest = scratch.rows();
    if (!box_spans(boxes, z, band, scratch.collector, *taken)) return;
    subtract(out, *taken, *rest);
    std::swap(out, *rest);
}

/// Adjusts the samples of a slice at a height of the boxes' grid.
template <typename Without>
void sample_without(const Tile& tile, double z, const Without& without, std::span<float> out) {
    std::size_t k = 0;
    for (int j = 0; j < tile.ny; ++j) {
        for (int i = 0; i < tile.nx; ++i, ++k) {
            const dvec2 p = tile.origin + dvec2(i, j) * tile.step;
            out[k] = static_cast<float>(without.adjusted(dvec3(p, z), out[k]));
        }
    }
}

class WithoutBoxes : public Field {
  public:
    WithoutBoxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes)
        : solid_(std::move(solid)), boxes_(std::move(boxes)) {}

    double value(dvec3 p) const override { return adjusted(p, solid_->value(p)); }
    Interval range(const Box& box) const override;
    Metric metric() const override { return solid_->metric() == Metric::sign ? Metric::sign : Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override;
    Box bounds() const override { return solid_->bounds(); }

    /// Returns the value at p of the solid without the boxes; v is that of the whole solid.
    double adjusted(dvec3 p, double v) const {
        if (const PlacedRun* run = boxes_->find(p)) {
            return std::max(v, depth_in(boxes_->grid().box(*run), p));
        }
        return v < 0 ? std::max(v, -boxes_->distance_within(p, -v)) : v;
    }

  private:
    FieldPtr solid_;
    std::shared_ptr<const RunBoxes> boxes_;
};

class WithoutBoxesSlice : public SampledSlice {
  public:
    WithoutBoxesSlice(const WithoutBoxes& field, const SliceField& solid, const RunBoxes& boxes, double z)
        : SampledSlice(field, z), field_(field), solid_(solid), boxes_(boxes), z_(z) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        runs_without(solid_, boxes_, z_, band, scratch, out);
    }
    void sample(const Tile& tile, std::span<float> out) const override {
        solid_.sample(tile, out);
        sample_without(tile, z_, field_, out);
    }
    Rect bounds() const override { return solid_.bounds(); }

  private:
    const WithoutBoxes& field_;
    const SliceField& solid_;
    const RunBoxes& boxes_;
    double z_;
};

Interval WithoutBoxes::range(const Box& box) const {
    Interval r = solid_->range(box);
    if (boxes_->empty()) return r;
    // Inside a box the value is at most half its height; near a box, a solid point is no deeper than its
    // distance.
    const double margin = boxes_->grid().pitch;
    if (boxes_->meets(box)) {
        r.hi = std::max(r.hi, boxes_->grid().layer_height / 2);
    } else {
        r.hi = std::max(r.hi, boxes_->meets(grown(box, margin)) ? 0.0 : -margin);
    }
    return r;
}

const SliceField& WithoutBoxes::slice(SliceContext& context, double z) const {
    const SliceField& solid = context.slice(*solid_, z);
    if (boxes_->empty()) return solid;
    return context.make<WithoutBoxesSlice>(*this, solid, *boxes_, z);
}

/// Boxes by layer, looked up at the middles of the layers.
class WithoutLayerBoxes : public Field {
  public:
    WithoutLayerBoxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes,
                      std::function<int(double z)> layer_of)
        : solid_(std::move(solid)), boxes_(std::move(boxes)), layer_of_(std::move(layer_of)) {}

    double value(dvec3 p) const override { return adjusted(in_grid(p), solid_->value(p)); }
    Interval range(const Box& box) const override {
        return raised(solid_->range(box), {in_grid(box.lo), in_grid(box.hi)});
    }
    Metric metric() const override { return Metric::sign; }
    const SliceField& slice(SliceContext& context, double z) const override;
    Box bounds() const override { return solid_->bounds(); }

    /// Returns an interval that encloses the values in a box of the grid, from one for the whole solid.
    Interval raised(Interval whole, const Box& box) const {
        if (boxes_->meets(grown(box, boxes_->grid().pitch)))
            whole.hi = std::max(whole.hi, 0.5 * boxes_->grid().layer_height);
        return whole;
    }
    /// Returns the value at a point of the grid; v is that of the whole solid.
    double adjusted(dvec3 p, double v) const {
        const PlacedRun* run = boxes_->find(p);
        return run != nullptr ? std::max(v, depth_in(boxes_->grid().box(*run), p)) : v;
    }

  private:
    dvec3 in_grid(dvec3 p) const { return {p.x, p.y, layer_of_(p.z) + 0.5}; }

    FieldPtr solid_;
    std::shared_ptr<const RunBoxes> boxes_;
    std::function<int(double z)> layer_of_;
};

class WithoutLayerBoxesSlice : public SliceField {
  public:
    /// `height` is that of the boxes' grid.
    WithoutLayerBoxesSlice(const WithoutLayerBoxes& field, const SliceField& solid, const RunBoxes& boxes,
                           double height)
        : field_(field), solid_(solid), boxes_(boxes), height_(height) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        runs_without(solid_, boxes_, height_, band, scratch, out);
    }
    Interval range(const Rect& r) const override {
        return field_.raised(solid_.range(r), {{r.lo, height_}, {r.hi, height_}});
    }
    void sample(const Tile& tile, std::span<float> out) const override {
        solid_.sample(tile, out);
        sample_without(tile, height_, field_, out);
    }
    Rect bounds() const override { return solid_.bounds(); }

  private:
    const WithoutLayerBoxes& field_;
    const SliceField& solid_;
    const RunBoxes& boxes_;
    double height_;
};

const SliceField& WithoutLayerBoxes::slice(SliceContext& context, double z) const {
    const SliceField& solid = context.slice(*solid_, z);
    const double height = layer_of_(z) + 0.5;
    if (boxes_->at(height).empty()) return solid;
    return context.make<WithoutLayerBoxesSlice>(*this, solid, *boxes_, height);
}

class BoxSolid : public Field {
  public:
    explicit BoxSolid(std::shared_ptr<const RunBoxes> boxes) : boxes_(std::move(boxes)) {}

    double value(dvec3 p) const override {
        if (const PlacedRun* run = boxes_->find(p)) return -depth_in(boxes_->grid().box(*run), p);
        return boxes_->distance_within(p, infinity);
    }
    Interval range(const Box& box) const override;
    const SliceField& slice(SliceContext& context, double z) const override;
    Box bounds() const override { return boxes_->bounds(); }

    const RunBoxes& boxes() const { return *boxes_; }

  private:
    std::shared_ptr<const RunBoxes> boxes_;
};

class BoxSolidSlice : public SampledSlice {
  public:
    BoxSolidSlice(const BoxSolid& field, double z) : SampledSlice(field, z), field_(field), z_(z) {}
    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        if (box_spans(field_.boxes(), z_, band, scratch.collector, out)) return;
        out.clear();
        for (int l = 0; l < band.lines(); ++l) out.end_line();
    }

  private:
    const BoxSolid& field_;
    double z_;
};

Interval BoxSolid::range(const Box& box) const {
    const double half = diagonal(box) / 2, middle = value(box.center());
    if (!boxes_->meets(box)) return {std::max(0.0, middle - half), middle + half};
    const SurveyGrid& grid = boxes_->grid();
    return {-std::min(grid.pitch, grid.layer_height) / 2, std::max(0.0, middle + half)};
}

const SliceField& BoxSolid::slice(SliceContext& context, double z) const {
    return context.make<BoxSolidSlice>(*this, z);
}

}  // namespace

FieldPtr make_without_boxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes) {
    if (!solid || !boxes) throw InputError("a solid without boxes needs a solid and a survey's plan");
    return std::make_shared<WithoutBoxes>(std::move(solid), std::move(boxes));
}

FieldPtr make_without_layer_boxes(FieldPtr solid, std::shared_ptr<const RunBoxes> boxes,
                                  std::function<int(double z)> layer_of) {
    if (!solid || !boxes || !layer_of)
        throw InputError("a solid without boxes of layers needs a solid, boxes and their layers");
    return std::make_shared<WithoutLayerBoxes>(std::move(solid), std::move(boxes), std::move(layer_of));
}

FieldPtr make_box_solid(std::shared_ptr<const RunBoxes> boxes) {
    if (!boxes) throw InputError("a solid of boxes needs a survey's plan");
    return std::make_shared<BoxSolid>(std::move(boxes));
}

}  // namespace lamella
