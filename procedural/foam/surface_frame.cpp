// Beams along the curves on faces, and beams clipped at the surface.
#include "procedural/foam/surface_frame.h"

#include <algorithm>

#include "procedural/foam/enclosed_pieces.h"

namespace lamella {
namespace {

constexpr double flatness = 0.02;  // maximum distance of a beam from its curve, as a share of the radius
constexpr std::size_t max_faces = 5000;

}  // namespace

/// Adds the beams along a polyline.
void SurfaceFrame::add_line(const SurfaceCurve& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) tapered_.add(line[i], line[i + 1]);
}

void SurfaceFrame::add_curve(const SurfaceCurve& curve) {
    std::vector<double> radii(curve.size());
    tapered_.radius().grading().numbers(curve, radii);
    double least = infinity;
    for (const double radius : radii) least = std::min(least, radius);
    add_line(simplified(curve, flatness * least));
}

const std::vector<SurfaceCurve>& SurfaceFrame::curves_on(const CellFaces::Face& face, const SeedKey& own) {
    const auto keys = std::minmax(face.other, own);
    const auto [entry, fresh] = known_.try_emplace({keys.first, keys.second});
    if (fresh) tracer_.trace(face.ring, entry->second);
    return entry->second;
}

std::size_t SurfaceFrame::append(const VoronoiCell& cell, const Seed& own, std::span<const Seed> sites,
                                 const Stretch& stretch, std::vector<Beam>& beams) {
    Box box;
    for (std::size_t v = 0; v < cell.vertex_count(); ++v) box.include(own.position + cell.vertex(v));
    if (tracer_.side_of(stretch.to_part(box)) != SurfaceTracer::Side::both) return 0;
    const std::size_t left_out = faces_.list(cell, own, sites, stretch, CellFaces::Which::all);
    if (known_.size() > max_faces) known_.clear();
    const std::size_t first = beams.size();
    curves_.clear();
    for (const CellFaces::Face& face : faces_.faces()) {
        const std::vector<SurfaceCurve>& curves = curves_on(face, own.key);
        curves_.insert(curves_.end(), curves.begin(), curves.end());
        if (face.other < own.key) continue;
        for (const SurfaceCurve& curve : curves) add_curve(curve);
    }
    for (const SurfaceCurve& line : joints_.joints(faces_.faces(), curves_, tracer_, own, sites, stretch))
        add_line(line);
    for (const SurfaceCurve& line : enclosed_pieces(faces_.faces(), curves_, tracer_, own, sites, stretch))
        add_line(line);
    tapered_.append(beams);
    for (std::size_t i = first; i < beams.size(); ++i) {
        beams[i].ra += growth_;
        beams[i].rb += growth_;
    }
    return left_out;
}

void SurfaceFrame::append_inside(const Beam& beam, std::vector<Beam>& parts) {
    const std::vector<dvec3> ends = tracer_.inside(beam.a, beam.b);
    const dvec3 along = beam.b - beam.a;
    const double square = glm::dot(along, along);
    const auto radius = [&](dvec3 p) {
        if (p == beam.a || !(square > 0)) return beam.ra;
        if (p == beam.b) return beam.rb;
        return beam.ra + (beam.rb - beam.ra) * (glm::dot(p - beam.a, along) / square);
    };
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
        parts.push_back({ends[i], radius(ends[i]), ends[i + 1], radius(ends[i + 1])});
    }
}

}  // namespace lamella
