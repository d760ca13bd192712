// If cells have one size, each owns the struts on its lower borders; otherwise equal struts are found by
// sorting.
#include "procedural/lattice/lattice_struts.h"

#include <algorithm>
#include <tuple>

namespace lamella {
namespace {

constexpr int cell_bits = 20;
constexpr std::int64_t cell_steps = std::int64_t{1} << cell_bits;

auto key(const glm::i64vec3& p) { return std::make_tuple(p.z, p.y, p.x); }

glm::i64vec3 on_grid(dvec3 p) { return glm::i64vec3(glm::floor(p * static_cast<double>(cell_steps) + 0.5)); }

void sort_unique(std::vector<GridStrut>& struts) {
    std::sort(struts.begin(), struts.end());
    struts.erase(std::unique(struts.begin(), struts.end()), struts.end());
}

/// Moves a strut in an upper face of its cell to the lower face: it belongs to the next cell.
void move_to_lower_border(GridStrut& strut) {
    for (int axis = 0; axis < 3; ++axis) {
        if (strut.a[axis] == cell_steps && strut.b[axis] == cell_steps) strut.a[axis] = strut.b[axis] = 0;
    }
}

}  // namespace

bool operator<(const GridStrut& s, const GridStrut& t) {
    const auto a = key(s.a), b = key(t.a);
    return a != b ? a < b : key(s.b) < key(t.b);
}

LatticeStruts::LatticeStruts(std::shared_ptr<const CellOctree> cells, const std::vector<Strut>& unit_cell)
    : cells_(std::move(cells)),
      step_(cells_->coarse_side() / static_cast<double>(cell_steps << CellOctree::max_halvings)) {
    for (const Strut& strut : unit_cell) {
        GridStrut s{on_grid(strut.a), on_grid(strut.b)};
        if (key(s.b) < key(s.a)) std::swap(s.a, s.b);
        if (cells_->levels() == 0) move_to_lower_border(s);
        cell_.push_back(s);
    }
    sort_unique(cell_);
}

dvec3 LatticeStruts::position(const glm::i64vec3& grid_point) const {
    return cells_->origin() + dvec3(grid_point) * step_;
}

std::vector<GridStrut> LatticeStruts::meeting(const Box& box) const {
    std::vector<GridStrut> found;
    cells_->for_each(box, [&](const OctreeCell& cell) {
        const int scale = CellOctree::max_halvings - cell.level;
        const glm::i64vec3 corner = cell.index * cell_steps;
        for (const GridStrut& s : cell_) {
            const GridStrut here{(corner + s.a) * (std::int64_t{1} << scale),
                                 (corner + s.b) * (std::int64_t{1} << scale)};
            const dvec3 a = position(here.a), b = position(here.b);
            if (!intersect(Box{glm::min(a, b), glm::max(a, b)}, box).empty()) found.push_back(here);
        }
    });
    if (cells_->levels() > 0) sort_unique(found);
    return found;
}

}  // namespace lamella
