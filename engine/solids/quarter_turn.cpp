// Lines along x become lines along y, and the other way round.
#include "engine/solids/quarter_turn.h"

#include <utility>
#include <vector>

#include "engine/field/slice_context.h"

namespace lamella {
namespace {

int quarters_within_turn(int quarters) { return ((quarters % 4) + 4) % 4; }

/// Turns points of the plane by right angles.
class PlaneTurn {
  public:
    explicit PlaneTurn(int quarters) : quarters_(quarters) {}

    dvec2 operator()(dvec2 p) const {
        for (int k = 0; k < quarters_; ++k) p = {-p.y, p.x};
        return p;
    }
    dvec2 back(dvec2 p) const {
        for (int k = 0; k < quarters_; ++k) p = {p.y, -p.x};
        return p;
    }
    Rect operator()(const Rect& r) const { return spanned((*this)(r.lo), (*this)(r.hi)); }
    Rect back(const Rect& r) const { return spanned(back(r.lo), back(r.hi)); }
    Box operator()(const Box& b) const { return lifted((*this)(b.rect()), b); }
    Box back(const Box& b) const { return lifted(back(b.rect()), b); }

    /// Returns the lines of the solid that become these.
    RowBand back(RowBand band) const {
        for (int k = 0; k < quarters_; ++k) {
            // A line along x at some y lies along -y at x = that y; one along y at some x along x at -y.
            double& origin = band.axis == Axis::x ? band.along_origin : band.across_origin;
            double& pitch = band.axis == Axis::x ? band.along_pitch : band.across_pitch;
            origin = -origin;
            pitch = -pitch;
            band.axis = band.axis == Axis::x ? Axis::y : Axis::x;
        }
        return band;
    }
    Tile back(const Tile& tile) const {
        const bool swaps = quarters_ % 2 != 0;
        Tile turned = tile;
        turned.origin = back(tile.origin);
        const dvec2 along = back(dvec2(tile.step.x, 0)), across = back(dvec2(0, tile.step.y));
        turned.step = along + across;
        if (swaps) std::swap(turned.nx, turned.ny);
        return turned;
    }
    bool swaps() const { return quarters_ % 2 != 0; }

  private:
    static Rect spanned(dvec2 a, dvec2 b) { return {glm::min(a, b), glm::max(a, b)}; }
    static Box lifted(const Rect& r, const Box& b) { return {{r.lo, b.lo.z}, {r.hi, b.hi.z}}; }

    int quarters_;
};

class QuarterTurnSlice : public SliceField {
  public:
    QuarterTurnSlice(const SliceField& solid, PlaneTurn turn) : solid_(solid), turn_(turn) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        solid_.runs(turn_.back(band), scratch, out);
    }
    Interval range(const Rect& r) const override { return solid_.range(turn_.back(r)); }
    void sample(const Tile& tile, std::span<float> out) const override {
        if (!turn_.swaps()) return solid_.sample(turn_.back(tile), out);
        std::vector<float> columns(out.size());
        solid_.sample(turn_.back(tile), columns);
        std::size_t k = 0;
        for (int j = 0; j < tile.ny; ++j) {
            for (int i = 0; i < tile.nx; ++i, ++k) {
                out[k] = columns[static_cast<std::size_t>(i) * static_cast<std::size_t>(tile.ny) +
                                 static_cast<std::size_t>(j)];
            }
        }
    }
    Rect bounds() const override {
        const Rect rect = solid_.bounds();
        return rect.empty() ? rect : turn_(rect);
    }

  private:
    const SliceField& solid_;
    PlaneTurn turn_;
};

class QuarterTurn : public Field {
  public:
    QuarterTurn(FieldPtr solid, int quarters)
        : solid_(std::move(solid)), quarters_(quarters), turn_(quarters) {}

    double value(dvec3 p) const override { return solid_->value(back(p)); }
    double value_within(dvec3 p, double limit) const override { return solid_->value_within(back(p), limit); }
    bool clear_of_surface(dvec3 p, double distance) const override {
        return solid_->clear_of_surface(back(p), distance);
    }
    Interval range(const Box& box) const override { return solid_->range(turn_.back(box)); }
    Metric metric() const override { return solid_->metric(); }
    FieldPtr offset(double d) const override {
        const FieldPtr moved = solid_->offset(d);
        return moved ? make_quarter_turn(moved, quarters_) : nullptr;
    }
    const SliceField& slice(SliceContext& context, double z) const override {
        return context.make<QuarterTurnSlice>(context.slice(*solid_, z), turn_);
    }
    Box bounds() const override {
        const Box box = solid_->bounds();
        return box.empty() ? box : turn_(box);
    }

  private:
    dvec3 back(dvec3 p) const { return {turn_.back(dvec2(p)), p.z}; }

    FieldPtr solid_;
    int quarters_;
    PlaneTurn turn_;
};

}  // namespace

Rect quarter_turned(const Rect& rect, int quarters) {
    return PlaneTurn(quarters_within_turn(quarters))(rect);
}

FieldPtr make_quarter_turn(FieldPtr solid, int quarters) {
    const int turns = quarters_within_turn(quarters);
    return turns == 0 ? solid : std::make_shared<QuarterTurn>(std::move(solid), turns);
}

}  // namespace lamella
