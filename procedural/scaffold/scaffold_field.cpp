// A tree of boxes, and two kinds of pieces: beams and prisms.
#include "procedural/scaffold/scaffold_field.h"

#include <array>

#include "engine/field/slice_context.h"
#include "engine/mesh/box_tree.h"
#include "engine/solids/beam_slice.h"
#include "engine/solids/closed_slice.h"
#include "engine/solids/primitives.h"
#include "procedural/scaffold/prism.h"

namespace lamella {
namespace {

/// Pieces by index: prisms first, then beams.
class Pieces {
  public:
    Pieces(std::vector<Prism> uprights, std::vector<Beam> beams)
        : uprights_(std::move(uprights)), beams_(std::move(beams)), tree_(boxes()) {}

    const Box& box() const { return tree_.bounds(); }
    double distance(dvec3 p, double limit) const {
        return tree_.least(p, limit, [&](std::uint32_t i) { return signed_distance(i, p); });
    }
    void at_height(double z, std::vector<Prism>& uprights, std::vector<Beam>& beams) const {
        for (const std::uint32_t i : tree_.at_height(z)) {
            if (i >= uprights_.size()) {
                beams.push_back(beams_[i - uprights_.size()]);
            } else if (const Prism& upright = uprights_[i]; upright.lo <= z && z < upright.hi) {
                uprights.push_back(upright);
            }
        }
    }

  private:
    std::vector<Box> boxes() const {
        std::vector<Box> boxes;
        for (const Prism& upright : uprights_) boxes.push_back(bounds(upright));
        for (const Beam& beam : beams_) boxes.push_back(lamella::bounds(beam));
        return boxes;
    }
    double signed_distance(std::uint32_t i, dvec3 p) const {
        return i < uprights_.size() ? lamella::signed_distance(uprights_[i], p)
                                    : lamella::signed_distance(beams_[i - uprights_.size()], p);
    }
    std::vector<Prism> uprights_;
    std::vector<Beam> beams_;
    BoxTree tree_;
};

class ScaffoldSlice : public SampledSlice {
  public:
    ScaffoldSlice(const Field& field, const std::vector<Prism>& uprights, const std::vector<Beam>& beams,
                  double z)
        : SampledSlice(field, z), uprights_(uprights), beams_(beams, z) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        scratch.collector.clear();
        uprights_.collect(band, scratch.collector);
        beams_.collect(band, {0, band.lines()}, scratch.collector);
        scratch.collector.merge(band, out);
    }
    Rect bounds() const override { return unite(uprights_.bounds(), beams_.bounds()); }

  private:
    UprightRows uprights_;
    BeamRows beams_;
};

class ScaffoldField : public Field {
  public:
    ScaffoldField(std::vector<Prism> uprights, std::vector<Beam> beams)
        : pieces_(std::move(uprights), std::move(beams)) {}

    double value(dvec3 p) const override { return pieces_.distance(p, infinity); }
    double value_within(dvec3 p, double limit) const override { return pieces_.distance(p, limit); }
    Box bounds() const override { return pieces_.box(); }
    const SliceField& slice(SliceContext& context, double z) const override {
        std::vector<Prism> uprights;
        std::vector<Beam> beams;
        pieces_.at_height(z, uprights, beams);
        return context.make<ScaffoldSlice>(*this, uprights, beams, z);
    }

  private:
    Pieces pieces_;
};

Prism bar_piece(const ScaffoldBar& bar, const ScaffoldShape& shape) {
    const dvec2 way = dvec2(bar.b) - dvec2(bar.a);
    const double length = std::sqrt(glm::dot(way, way));
    Prism piece;
    piece.center = (dvec2(bar.a) + dvec2(bar.b)) * 0.5;
    piece.direction = length > 0 ? way / length : dvec2(1, 0);
    piece.half = dvec2(length + shape.bar_width, shape.bar_width) * 0.5;
    piece.lo = bar.a.z - shape.bar_height;
    piece.hi = bar.a.z;
    return piece;
}

void append_pillar(const ScaffoldPillar& pillar, const ScaffoldShape& shape, std::vector<Prism>& pieces) {
    const double half = shape.pillar / 2;
    Prism piece{pillar.at, {1, 0}, dvec2(half), pillar.bottom, pillar.top, shape.round_pillars};
    if (shape.round_pillars) {
        pieces.push_back(piece);
    } else {
        piece.half = {half, shape.wall / 2};
        pieces.push_back(piece);
        piece.half = {shape.wall / 2, half};
        pieces.push_back(piece);
    }
    if (pillar.foot > 0) {
        const double top = std::min(pillar.bottom + shape.foot_height, pillar.top);
        pieces.push_back({pillar.at, {1, 0}, dvec2(pillar.foot), pillar.bottom, top, true});
    }
}

}  // namespace

FieldPtr make_scaffold_field(const Scaffold& scaffold) {
    std::vector<Prism> uprights;
    for (const ScaffoldPillar& pillar : scaffold.pillars) append_pillar(pillar, scaffold.shape, uprights);
    for (const ScaffoldBar& bar : scaffold.bars) uprights.push_back(bar_piece(bar, scaffold.shape));
    if (uprights.empty() && scaffold.connectors.empty()) return make_empty();
    return std::make_shared<ScaffoldField>(std::move(uprights), scaffold.connectors);
}

}  // namespace lamella
