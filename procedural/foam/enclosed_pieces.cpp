// Subdivides the cell's box where the body may be, and groups the leaves into pieces.
#include "procedural/foam/enclosed_pieces.h"

#include <algorithm>

namespace lamella {
namespace {

// Leaves along the box, powers of two. Coarser for cells that the surface crosses, because there are many.
constexpr int leaves_in_crossed_cell = 8, leaves_in_cell = 16;

using Places = std::vector<glm::ivec3>;  // positions of leaves

/// The leaves of a cell's box whose centre lies in the cell and in the body.
class InsideLeaves {
  public:
    InsideLeaves(const Box& box, const SurfaceTracer& tracer, const Seed& own, std::span<const Seed> sites,
                 const Stretch& stretch, int along)
        : box_(box),
          along_(along),
          tracer_(tracer),
          own_(own),
          sites_(sites),
          stretch_(stretch),
          inside_(count(along) * count(along) * count(along), 0) {
        look_into({0, 0, 0}, along_);
    }

    dvec3 middle(glm::ivec3 leaf) const {
        return box_.lo + box_.size() * ((dvec3(leaf) + 0.5) / double(along_));
    }

    /// Removes the piece near a point.
    void leave_out(dvec3 p) {
        Places piece;
        const glm::ivec3 home(glm::floor((p - box_.lo) / box_.size() * double(along_)));
        for (int n = 0; n < 125; ++n) take(home + glm::ivec3(n % 5, n / 5 % 5, n / 25) - 2, piece);
        take_neighbours(piece);
    }

    /// Returns the connected components of leaves; diagonal contact connects.
    std::vector<Places> pieces() {
        std::vector<Places> pieces;
        for (std::size_t i = 0; i < inside_.size(); ++i) {
            if (!inside_[i]) continue;
            const auto n = static_cast<int>(i);
            Places piece;
            take({n % along_, n / along_ % along_, n / along_ / along_}, piece);
            take_neighbours(piece);
            pieces.push_back(std::move(piece));
        }
        return pieces;
    }

    /// Diagonal of a leaf, mm.
    double step() const { return diagonal(box_) / along_; }
    const Box& box() const { return box_; }

  private:
    static std::size_t count(int n) { return static_cast<std::size_t>(n); }
    char& held(glm::ivec3 leaf) {
        return inside_[(count(leaf.z) * count(along_) + count(leaf.y)) * count(along_) + count(leaf.x)];
    }
    void take(glm::ivec3 leaf, Places& piece) {
        const bool in_box = glm::all(glm::greaterThanEqual(leaf, glm::ivec3(0))) &&
                            glm::all(glm::lessThan(leaf, glm::ivec3(along_)));
        if (!in_box || !held(leaf)) return;
        held(leaf) = 0;
        piece.push_back(leaf);
    }

    /// Extends the piece by flood fill over touching leaves.
    void take_neighbours(Places& piece) {
        for (std::size_t k = 0; k < piece.size(); ++k) {
            const glm::ivec3 leaf = piece[k];
            for (int side = 0; side < 27; ++side) {
                take(leaf + glm::ivec3(side % 3, side / 3 % 3, side / 9) - 1, piece);
            }
        }
    }

    void look_into(glm::ivec3 first, int size) {
        const dvec3 leaf = box_.size() / double(along_);
        const Box part{box_.lo + leaf * dvec3(first), box_.lo + leaf * dvec3(first + size)};
        if (beyond_the_cell(part)) return;
        const SurfaceTracer::Side side = tracer_.side_of(part);
        if (side == SurfaceTracer::Side::outside) return;
        if (side == SurfaceTracer::Side::inside) return fill(first, size);
        if (size == 1) {
            const dvec3 p = middle(first);
            held(first) = !beyond_the_cell({p, p}) && tracer_.holds(p);
            return;
        }
        for (int octant = 0; octant < 8; ++octant) {
            look_into(first + glm::ivec3(octant & 1, octant >> 1 & 1, octant >> 2) * (size / 2), size / 2);
        }
    }

    /// Marks all leaves of a part inside the body. Some may be beyond the cell, which does no harm: a piece
    /// that reaches there is held by the cell's faces.
    void fill(glm::ivec3 first, int size) {
        for (int n = 0; n < size * size * size; ++n) {
            held(first + glm::ivec3(n % size, n / size % size, n / size / size)) = 1;
        }
    }

    /// Returns whether some other seed is nearer to all of the box.
    bool beyond_the_cell(const Box& box) const {
        const Box about = stretch_.to_seeds(box);
        const dvec3 middle = about.center(), half = about.size() * 0.5;
        return std::any_of(sites_.begin(), sites_.end(), [&](const Seed& site) {
            const dvec3 way = site.position - own_.position;
            return glm::dot(middle - (own_.position + site.position) * 0.5, way) >
                   glm::dot(glm::abs(way), half);
        });
    }

    Box box_;
    int along_;
    const SurfaceTracer& tracer_;
    const Seed& own_;
    std::span<const Seed> sites_;
    const Stretch& stretch_;
    std::vector<char> inside_;
};

/// Appends the lines from the deepest leaf of a piece along the six axes to the surface.
void append_star(const InsideLeaves& leaves, const Places& piece, const SurfaceTracer& tracer,
                 std::vector<SurfaceCurve>& lines) {
    const Field& body = tracer.body();
    dvec3 middle = leaves.middle(piece.front());
    double deepest = body.value(middle);
    for (const glm::ivec3& leaf : piece) {
        const dvec3 p = leaves.middle(leaf);
        const double v = body.value(p);
        if (!(v < deepest)) continue;
        deepest = v;
        middle = p;
    }
    const double step = leaves.step();
    for (int direction = 0; direction < 6; ++direction) {
        dvec3 way(0);
        way[direction / 2] = direction % 2 ? -step : step;
        dvec3 last = middle, next = middle + way;
        while (tracer.holds(next) && leaves.box().contains(next)) {
            last = next;
            next += way;
        }
        lines.push_back({middle, tracer.holds(next) ? next : tracer.crossing(last, next)});
    }
}

}  // namespace

std::vector<SurfaceCurve> enclosed_pieces(std::span<const CellFaces::Face> faces,
                                          std::span<const SurfaceCurve> curves, const SurfaceTracer& tracer,
                                          const Seed& own, std::span<const Seed> sites,
                                          const Stretch& stretch) {
    Box box;
    for (const CellFaces::Face& face : faces) {
        for (const dvec3& corner : face.ring) box.include(corner);
    }
    std::vector<SurfaceCurve> lines;
    if (box.empty()) return lines;
    std::vector<Seed> neighbours;
    for (const Seed& site : sites) {
        const auto beyond = [&](const CellFaces::Face& face) { return face.other == site.key; };
        if (std::any_of(faces.begin(), faces.end(), beyond)) neighbours.push_back(site);
    }
    InsideLeaves leaves(box, tracer, own, neighbours, stretch,
                        curves.empty() ? leaves_in_cell : leaves_in_crossed_cell);
    for (const SurfaceCurve& curve : curves) {
        for (const dvec3& p : curve) leaves.leave_out(p);
    }
    for (const CellFaces::Face& face : faces) {
        for (const dvec3& corner : face.ring) {
            if (tracer.holds(corner)) leaves.leave_out(corner);
        }
    }
    for (const Places& piece : leaves.pieces()) append_star(leaves, piece, tracer, lines);
    return lines;
}

}  // namespace lamella
