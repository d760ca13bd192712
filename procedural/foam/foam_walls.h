// WallMaker: makes the wall of each Voronoi face once, with or without a window, and the beams along its
// edges.
#pragma once

#include <span>
#include <vector>

#include "procedural/foam/cell_faces.h"
#include "procedural/foam/foam_piece.h"

namespace lamella {

/// Parameters of the walls. Gradings are sampled at nodes and at the centres of faces.
struct WallSettings {
    NodeRadius radius{0.1};  ///< half the thickness, mm, >= 0
    Graded window = 0.0;     ///< open share of a face's width: 0 is closed, 1 has no wall
    double growth = 0;       ///< added to every radius of a wall, mm
};

/// Makes the beams and walls that a cell owns: beams as BeamMaker does, and the walls of its faces towards
/// seeds of higher keys. Not thread-safe; keeps buffers for reuse.
///
/// A wall is a fan of round triangles around the centre (area centroid) of its face; a closed wall of
/// constant thickness is a fan from one of its nodes. A window is the face scaled about its centre; it is
/// left open and rimmed with beams of the wall's radius. A window that its rim would close in the middle is
/// not made. All edges of a round triangle are beams, but only those that can be visible are made as pieces:
/// along the face's edges where the foam's beams are thinner than the wall, around windows, and between
/// triangles where the thickness has a crest.
class WallMaker {
  public:
    using Piece = FoamPiece;
    WallMaker(BeamMaker beams, WallSettings walls) : beams_(std::move(beams)), walls_(std::move(walls)) {}

    double largest_growth() const {
        return std::max(beams_.largest_growth(), walls_.radius.largest() + walls_.growth);
    }
    double growth(const Box& box) const {
        return std::max(beams_.growth(box), walls_.radius.largest_in(box) + walls_.growth);
    }
    bool avoids(const Box& /*box*/) const { return false; }
    const Stretch& stretch() const { return beams_.stretch(); }

    /// Appends the pieces that `own` owns: beams first, then walls in order of the other seeds' keys; see
    /// BeamMaker::append. Returns the number of edges and faces skipped because they reach the start box.
    std::size_t append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                       std::vector<FoamPiece>& pieces);

  private:
    struct Corner {
        dvec3 place;
        double radius;
    };

    void append_wall(std::vector<FoamPiece>& pieces);
    void append_triangle(const Corner& a, const Corner& b, const Corner& c,
                         std::vector<FoamPiece>& pieces) const;
    void append_beam(const Corner& a, const Corner& b, std::vector<FoamPiece>& pieces) const;
    void append_rim(const Corner& a, const Corner& b, std::vector<FoamPiece>& pieces);
    Corner middle() const;
    double window(const Corner& middle) const;
    bool has_crest(const Corner& middle, std::size_t spoke) const;

    BeamMaker beams_;
    WallSettings walls_;
    CellFaces faces_;
    std::vector<Beam> made_;
    std::vector<Corner> corners_;  ///< of the current face
    std::vector<double> radii_;    ///< of the current face's corners
};

}  // namespace lamella
