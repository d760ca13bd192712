// A tree of boxes; beams where shapes are beams, else cuts in their frames.
#include "procedural/elements/element_field.h"

#include <algorithm>
#include <utility>

#include "engine/base/error.h"
#include "engine/field/slice_context.h"
#include "engine/mesh/box_tree.h"
#include "engine/solids/beam_slice.h"
#include "engine/solids/closed_slice.h"
#include "engine/solids/plane_index.h"
#include "engine/solids/primitives.h"

namespace lamella {

namespace {

class ElementField : public Field {
  public:
    ElementField(std::vector<ElementShapePtr> shapes, std::vector<PlacedElement> elements,
                 std::optional<Interval> upright);

    double value(dvec3 p) const override { return value_within(p, infinity); }
    double value_within(dvec3 p, double limit) const override;
    Metric metric() const override { return Metric::bound; }
    const SliceField& slice(SliceContext& context, double z) const override;
    Box bounds() const override { return tree_.bounds(); }

    /// Returns the beam that an element is, if its shape is one, as it meets the plane at height z.
    std::optional<Beam> beam(std::uint32_t element, double z) const {
        const PlacedElement& placed = elements_[element];
        const auto shape = shapes_[placed.shape]->beam();
        if (!shape) return std::nullopt;
        const auto at = [&](dvec3 p) {
            p = placed.at + placed.turn * (placed.scale * p);
            return upright_ ? dvec3(p.x, p.y, z) : p;
        };
        return Beam{at(shape->a), placed.scale * shape->ra, at(shape->b), placed.scale * shape->rb};
    }
    const Box& box(std::uint32_t element) const { return boxes_[element]; }
    /// Appends the intervals of t in which the line p + t * way of a plane lies inside an element.
    void cut(std::uint32_t element, dvec3 p, dvec3 way, std::vector<Interval>& inside) const {
        const PlacedElement& placed = elements_[element];
        dvec3 from = placed.local(p);
        if (upright_) from.z = 0;
        shapes_[placed.shape]->cut(from, placed.local_direction(way), inside);
    }

  private:
    std::vector<Box> boxes() const;
    Box box_of(const PlacedElement& element) const;
    double distance(std::uint32_t element, dvec3 p) const;

    std::vector<ElementShapePtr> shapes_;
    std::vector<PlacedElement> elements_;
    std::optional<Interval> upright_;
    std::vector<Box> boxes_;
    BoxTree tree_;
};

class ElementSlice : public SampledSlice {
  public:
    ElementSlice(const ElementField& field, const std::vector<std::uint32_t>& elements, double z)
        : SampledSlice(field, z), field_(field), z_(z) {
        std::vector<Rect> rects;
        std::vector<Beam> beams;
        for (const std::uint32_t element : elements) {
            if (const auto beam = field.beam(element, z)) {
                beams.push_back(*beam);
            } else {
                cut_.push_back(element);
                rects.push_back(field.box(element).rect());
            }
        }
        beams_ = BeamRows(beams, z);
        sections_ = PlaneIndex(std::move(rects));
    }
    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override;
    Rect bounds() const override { return unite(sections_.bounds(), beams_.bounds()); }

  private:
    const ElementField& field_;
    double z_;
    BeamRows beams_;
    std::vector<std::uint32_t> cut_;  ///< elements that are no beams
    PlaneIndex sections_;             ///< theirs
};

/// An element's first run on each line goes into one piece of the collector, further ones into their own.
void ElementSlice::runs(const RowBand& band, Scratch& scratch, RunRows& out) const {
    scratch.collector.clear();
    beams_.collect(band, scratch.collector);
    std::vector<Interval> inside;
    std::vector<Run> firsts;
    const dvec3 way = band.axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    sections_.visit(band, {0, band.lines()}, [&](std::uint32_t i, const LineRange& lines) {
        firsts.assign(static_cast<std::size_t>(lines.last - lines.first), {0, 0});
        for (int line = lines.first; line < lines.last; ++line) {
            inside.clear();
            const dvec3 from(on_plane(band.axis, 0, band.line(line)), z_);
            field_.cut(cut_[i], from, way, inside);
            for (std::size_t k = 0; k < inside.size(); ++k) {
                const double p = band.coordinate(inside[k].lo), q = band.coordinate(inside[k].hi);
                const Run run{round_run(std::min(p, q)), round_run(std::max(p, q))};
                if (k == 0) {
                    firsts[static_cast<std::size_t>(line - lines.first)] = run;
                } else {
                    const RunCollector::Segment further = scratch.collector.add(line, 1);
                    *further.begin = run.begin;
                    *further.end = run.end;
                }
            }
        }
        const RunCollector::Segment piece = scratch.collector.add(lines.first, lines.last - lines.first);
        for (std::size_t k = 0; k < firsts.size(); ++k) {
            piece.begin[k] = firsts[k].begin;
            piece.end[k] = firsts[k].end;
        }
    });
    scratch.collector.merge(band, out);
}

ElementField::ElementField(std::vector<ElementShapePtr> shapes, std::vector<PlacedElement> elements,
                           std::optional<Interval> upright)
    : shapes_(std::move(shapes)),
      elements_(std::move(elements)),
      upright_(upright),
      boxes_(boxes()),
      tree_(boxes_) {}

std::vector<Box> ElementField::boxes() const {
    std::vector<Box> boxes;
    boxes.reserve(elements_.size());
    for (const PlacedElement& element : elements_) boxes.push_back(box_of(element));
    return boxes;
}

Box ElementField::box_of(const PlacedElement& element) const {
    const Box local = shapes_[element.shape]->bounds();
    const dvec3 half = 0.5 * element.scale * local.size();
    const glm::dmat3 turn = glm::mat3_cast(element.turn);
    const dvec3 centre = element.at + turn * (element.scale * local.center());
    dvec3 reach(0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) reach[row] += std::abs(turn[column][row]) * half[column];
    }
    Box box{centre - reach, centre + reach};
    if (upright_) {
        box.lo.z = upright_->lo;
        box.hi.z = upright_->hi;
    }
    return box;
}

double ElementField::distance(std::uint32_t element, dvec3 p) const {
    const PlacedElement& placed = elements_[element];
    dvec3 local = placed.local(p);
    if (!upright_) return placed.scale * shapes_[placed.shape]->distance(local);
    local.z = 0;
    const double in_plane = placed.scale * shapes_[placed.shape]->distance(local);
    const double up = std::max(upright_->lo - p.z, p.z - upright_->hi);
    return in_plane > 0 && up > 0 ? length(dvec2(in_plane, up)) : std::max(in_plane, up);
}

double ElementField::value_within(dvec3 p, double limit) const {
    return tree_.least(p, limit, [&](std::uint32_t element) { return distance(element, p); });
}

const SliceField& ElementField::slice(SliceContext& context, double z) const {
    std::vector<std::uint32_t> meeting;
    if (!upright_ || (upright_->lo <= z && z < upright_->hi)) meeting = tree_.at_height(z);
    return context.make<ElementSlice>(*this, meeting, z);
}

}  // namespace

FieldPtr make_element_field(std::vector<ElementShapePtr> shapes, std::vector<PlacedElement> elements,
                            std::optional<Interval> upright) {
    if (elements.empty()) return make_empty();
    for (const PlacedElement& element : elements) {
        if (element.shape >= shapes.size())
            throw InputError("an element names shape " + std::to_string(element.shape) + ", and there are " +
                             std::to_string(shapes.size()) + "; accepted: numbers below that");
    }
    return std::make_shared<ElementField>(std::move(shapes), std::move(elements), upright);
}

}  // namespace lamella
