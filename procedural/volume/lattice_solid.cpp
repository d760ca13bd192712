// Pieces in a tree of boxes.
#include "procedural/volume/lattice_solid.h"

#include <array>

#include "engine/field/slice_context.h"
#include "engine/mesh/box_tree.h"
#include "engine/solids/beam_slice.h"
#include "engine/solids/plane_index.h"
#include "engine/solids/primitives.h"

namespace lamella {
namespace {

using FlatPiece = std::variant<Frustum, HalfBall>;

/// The sections of flat pieces in one plane, and their runs.
class FlatRows {
  public:
    FlatRows(std::vector<FlatPiece> pieces, double z) : pieces_(std::move(pieces)), z_(z) {
        std::vector<Rect> rects;
        for (const FlatPiece& piece : pieces_) {
            const Box box = std::visit([](const auto& p) { return lamella::bounds(p); }, piece);
            rects.push_back({dvec2(box.lo), dvec2(box.hi)});
        }
        sections_ = PlaneIndex(std::move(rects));
    }

    void collect(const RowBand& band, RunCollector& runs) const {
        const dvec3 direction = band.axis == Axis::x ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
        sections_.visit(band, {0, band.lines()}, [&](std::uint32_t i, const LineRange& lines) {
            const auto out = runs.add(lines.first, lines.last - lines.first);
            for (int l = lines.first; l < lines.last; ++l) {
                const double across = band.line(l);
                const dvec3 p = band.axis == Axis::x ? dvec3(0, across, z_) : dvec3(across, 0, z_);
                std::int32_t& begin = out.begin[l - lines.first];
                std::int32_t& end = out.end[l - lines.first];
                begin = end = 0;
                const auto solid =
                    std::visit([&](const auto& piece) { return cut(piece, p, direction); }, pieces_[i]);
                if (!solid) continue;
                const double u = band.coordinate(solid->lo), v = band.coordinate(solid->hi);
                begin = round_run(std::min(u, v));
                end = round_run(std::max(u, v));
            }
        });
    }
    Rect bounds() const { return sections_.bounds(); }

  private:
    std::vector<FlatPiece> pieces_;
    double z_;
    PlaneIndex sections_;
};

class LatticeSlice : public SampledSlice {
  public:
    LatticeSlice(const Field& field, const std::vector<Beam>& beams, std::vector<FlatPiece> flat, double z)
        : SampledSlice(field, z), beams_(beams, z), flat_(std::move(flat), z) {}

    void runs(const RowBand& band, Scratch& scratch, RunRows& out) const override {
        scratch.collector.clear();
        beams_.collect(band, scratch.collector);
        flat_.collect(band, scratch.collector);
        scratch.collector.merge(band, out);
    }
    Rect bounds() const override { return unite(beams_.bounds(), flat_.bounds()); }

  private:
    BeamRows beams_;
    FlatRows flat_;
};

/// Pieces by index: beams first, then those with a flat side.
class LatticeSolid : public Field {
    template <typename Take>
    auto visit(std::size_t i, const Take& take) const {
        return i < pieces_.beams.size() ? take(pieces_.beams[i])
                                        : std::visit(take, pieces_.flat[i - pieces_.beams.size()]);
    }

  public:
    explicit LatticeSolid(LatticePieces pieces) : pieces_(std::move(pieces)), tree_(boxes()) {}

    double value(dvec3 p) const override { return distance(p, infinity); }
    double value_within(dvec3 p, double limit) const override { return distance(p, limit); }
    Box bounds() const override { return tree_.bounds(); }

    /// Radii grow by d. Flat sides would get round edges, and eroded joints have no closed form.
    FieldPtr offset(double d) const override {
        if (d < 0 || !pieces_.flat.empty()) return nullptr;
        LatticePieces grown = pieces_;
        for (Beam& beam : grown.beams) {
            beam.ra += d;
            beam.rb += d;
        }
        return make_lattice_solid(std::move(grown));
    }

    const SliceField& slice(SliceContext& context, double z) const override {
        std::vector<Beam> beams;
        std::vector<FlatPiece> flat;
        for (const std::uint32_t i : tree_.at_height(z)) {
            if (i < pieces_.beams.size()) {
                beams.push_back(pieces_.beams[i]);
            } else {
                flat.push_back(pieces_.flat[i - pieces_.beams.size()]);
            }
        }
        return context.make<LatticeSlice>(*this, beams, std::move(flat), z);
    }

  private:
    std::vector<Box> boxes() const {
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            boxes.push_back(visit(i, [](const auto& piece) { return lamella::bounds(piece); }));
        return boxes;
    }
    double distance(dvec3 p, double limit) const {
        return tree_.least(p, limit, [&](std::uint32_t i) {
            return visit(i, [&](const auto& piece) { return signed_distance(piece, p); });
        });
    }

    LatticePieces pieces_;
    BoxTree tree_;
};

/// Adds the cap of a beam at one of its ends; `away` points out of the beam there, and is 0 for one without
/// length.
void append_cap(LatticePieces& pieces, BeamCap cap, dvec3 at, double radius, dvec3 away) {
    if (cap == BeamCap::sphere || (cap == BeamCap::hemisphere && away == dvec3(0)))
        pieces.beams.push_back({at, radius, at, radius});
    else if (cap == BeamCap::hemisphere)
        pieces.flat.emplace_back(HalfBall{at, radius, away});
}

}  // namespace

void append_pieces(LatticePieces& pieces, const LatticeOfMesh& lattice, std::span<const dvec3> vertices,
                   double scale) {
    for (const LatticeBeam& beam : lattice.beams) {
        const dvec3 a = vertices[beam.vertices[0]], b = vertices[beam.vertices[1]];
        const double ra = beam.radii[0] * scale, rb = beam.radii[1] * scale;
        const double length = std::sqrt(glm::dot(b - a, b - a));
        const bool round = beam.caps[0] != BeamCap::butt && beam.caps[1] != BeamCap::butt;
        if (ra == rb && round) {
            pieces.beams.push_back({a, ra, b, rb});
            continue;
        }
        if (length > 0) pieces.flat.emplace_back(Frustum{a, ra, b, rb});
        const dvec3 way = length > 0 ? (b - a) / length : dvec3(0);
        append_cap(pieces, beam.caps[0], a, ra, -way);
        append_cap(pieces, beam.caps[1], b, rb, way);
    }
    for (const LatticeBall& ball : lattice.balls) {
        const dvec3 at = vertices[ball.vertex];
        const double radius = ball.radius * scale;
        pieces.beams.push_back({at, radius, at, radius});
    }
}

FieldPtr make_lattice_solid(LatticePieces pieces) {
    if (pieces.size() == 0) return make_empty();
    return std::make_shared<LatticeSolid>(std::move(pieces));
}

}  // namespace lamella
