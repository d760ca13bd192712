// Nearest points of the surface, each search beginning at the one found for the node before.
#include "procedural/lattice/wall_plane.h"

#include <array>

namespace lamella {

WallPlane::WallPlane(const TpmsWall& wall, const SineCosine& z) : wall_(wall), z_(z) {
    std::array<SineCosine, parts> turns;
    for (std::size_t i = 0; i < parts; ++i) turns[i] = sine_cosine(static_cast<double>(i) * step);
    nodes_.resize(std::size_t{parts} * parts);
    std::size_t k = 0;
    std::optional<dvec3> row_start, start;  // of a search, from the node
    for (const SineCosine& y : turns) {
        start = row_start;
        for (std::size_t i = 0; i < parts; ++i, ++k) {
            const auto nearest = wall.signed_distance({turns[i], y, z}, start);
            start.reset();
            if (nearest) start = nearest->foot - dvec3(step, 0, 0);
            if (i == 0) row_start.reset();
            if (i == 0 && nearest) row_start = nearest->foot - dvec3(0, step, 0);
            if (!nearest) {
                nodes_[k].distance = wall.least_distance({turns[i], y, z});
                continue;
            }
            const auto& [distance, normal, hessian, foot] = *nearest;
            nodes_[k] = {distance, normal.x * step, normal.y * step, hessian[0][1] * (step * step), true};
        }
    }
}

}  // namespace lamella
