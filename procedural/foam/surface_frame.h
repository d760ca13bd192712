// SurfaceFrame: beams where a foam's Voronoi faces meet the body's surface, and the foam clipped to the body.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "procedural/foam/cell_faces.h"
#include "procedural/foam/frame_joints.h"
#include "procedural/foam/surface_curves.h"
#include "procedural/foam/tapered_beams.h"

namespace lamella {

/// Parameters of a surface frame.
struct FrameSettings {
    FieldPtr body;         ///< the frame follows its surface
    Graded radius = 0.3;   ///< of its beams, mm; where the foam's beams are thicker, their radius
    bool interior = true;  ///< whether the foam itself is made as well
};

/// Makes the frame's beams that a cell owns (the armature of Martinez, Dumas and Lefebvre 2016, as curves
/// instead of a distance): those along the curves in which its faces towards seeds of higher keys meet the
/// surface, its joints, and lines for pieces of the body enclosed in the cell. Axes on curves lie on the
/// surface, so half of each beam lies outside the body; the caller has to clip it. Each edge of the diagram
/// that pierces the surface does so at a node of the frame. Not thread-safe; keeps buffers for reuse.
class SurfaceFrame {
  public:
    SurfaceFrame(const FieldPtr& body, NodeRadius radius, bool interior)
        : tracer_(body), tapered_(radius), interior_(interior), joints_(std::move(radius), interior) {}

    /// Returns the same frame with beam radii larger by `by`, mm.
    SurfaceFrame grown(double by) const {
        SurfaceFrame thicker = *this;
        thicker.growth_ += by;
        return thicker;
    }

    /// Appends the beams that `own` owns; see BeamMaker::append. Returns the number of edges and faces
    /// skipped because they reach the start box.
    std::size_t append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                       const Stretch& stretch, std::vector<Beam>& beams);
    /// Appends the parts of a beam whose axis lies in the body.
    void append_inside(const Beam& beam, std::vector<Beam>& parts);

    double largest_radius() const { return tapered_.radius().largest() + growth_; }
    double largest_radius_in(const Box& box) const { return tapered_.radius().largest_in(box) + growth_; }
    SurfaceTracer::Side side_of(const Box& box) const { return tracer_.side_of(box); }
    bool interior() const { return interior_; }

  private:
    const std::vector<SurfaceCurve>& curves_on(const CellFaces::Face& face, const SeedKey& own);
    void add_line(const SurfaceCurve& line);
    void add_curve(const SurfaceCurve& curve);

    SurfaceTracer tracer_;
    TaperedBeams tapered_;
    bool interior_;
    double growth_ = 0;  ///< added to every radius at the end, mm
    FrameJoints joints_;
    CellFaces faces_;
    std::vector<SurfaceCurve> curves_;
    /// A cache of the curves on faces, which two cells share, by the keys of their seeds.
    std::map<std::pair<SeedKey, SeedKey>, std::vector<SurfaceCurve>> known_;
};

/// A maker of a foam's pieces (see CellSource), with a frame if there is one. The foam's beams then end where
/// their axes leave the body: at the frame's nodes.
template <typename Maker>
class FramedMaker {
  public:
    using Piece = typename Maker::Piece;
    FramedMaker(Maker foam, std::optional<SurfaceFrame> frame)
        : foam_(std::move(foam)), frame_(std::move(frame)) {}

    double largest_growth() const {
        return frame_ ? std::max(foam_.largest_growth(), frame_->largest_radius()) : foam_.largest_growth();
    }
    double growth(const Box& box) const {
        return frame_ ? std::max(foam_.growth(box), frame_->largest_radius_in(box)) : foam_.growth(box);
    }
    const Stretch& stretch() const { return foam_.stretch(); }
    /// With a frame, no axis passes outside its body; without an interior, none passes inside.
    bool avoids(const Box& box) const {
        if (!frame_) return foam_.avoids(box);
        const auto side = frame_->side_of(box);
        return side == SurfaceTracer::Side::outside ||
               (side == SurfaceTracer::Side::inside && !frame_->interior());
    }

    std::size_t append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                       std::vector<Piece>& pieces) {
        if (!frame_) return foam_.append(cell, own, sites, pieces);
        std::size_t left_out = 0;
        if (frame_->interior()) {
            made_.clear();
            left_out += foam_.append(cell, own, sites, made_);
            for (const Piece& piece : made_) append_inside(piece, pieces);
        }
        beams_.clear();
        left_out += frame_->append(cell, own, sites, stretch(), beams_);
        pieces.insert(pieces.end(), beams_.begin(), beams_.end());
        return left_out;
    }

  private:
    void append_inside(const Beam& beam, std::vector<Beam>& pieces) { frame_->append_inside(beam, pieces); }
    /// Walls are not cut here; clipping with the body ends them at the surface.
    template <typename... Kinds>
    void append_inside(const std::variant<Kinds...>& piece, std::vector<Piece>& pieces) {
        if (const Beam* beam = std::get_if<Beam>(&piece)) {
            beams_.clear();
            frame_->append_inside(*beam, beams_);
            pieces.insert(pieces.end(), beams_.begin(), beams_.end());
        } else {
            pieces.push_back(piece);
        }
    }

    Maker foam_;
    std::optional<SurfaceFrame> frame_;
    std::vector<Piece> made_;
    std::vector<Beam> beams_;
};

}  // namespace lamella
