// Distances and their slopes at equal steps, from the nearest points of the surface.
#include "procedural/lattice/wall_line.h"

namespace lamella {

WallLine::WallLine(const TpmsWall& wall, Axis axis, const SineCosine& across, const SineCosine& z)
    : wall_(&wall), axis_(axis), across_(across), z_(z) {
    for (int i = 0; i < parts; ++i) {
        const TpmsPoint point = tpms_point_on(axis, sine_cosine(i * step), across, z);
        const auto nearest = wall.signed_distance(point);
        if (!nearest) continue;
        const double slope = axis == Axis::x ? nearest->normal.x : nearest->normal.y;
        nodes_[static_cast<std::size_t>(i)] = {nearest->distance, slope * step, true};
    }
    nodes_.back() = nodes_.front();
}

double WallLine::bound(double turns, double half) const {
    const double whole = std::floor(turns), place = (turns - whole) * parts;
    const auto i = std::min(static_cast<std::size_t>(place), std::size_t{parts - 1});
    const Node &a = nodes_[i], &b = nodes_[i + 1];
    if (!a.known || !b.known) {
        const SineCosine turn = sine_cosine((turns - whole) * (2 * pi));
        return wall_->bound(tpms_point_on(axis_, turn, across_, z_), half);
    }
    const double t = place - static_cast<double>(i), u = 1 - t;
    const double distance =
        u * u * ((1 + 2 * t) * a.distance + t * a.slope) + t * t * ((1 + 2 * u) * b.distance - u * b.slope);
    return std::abs(distance) - half;
}

}  // namespace lamella
