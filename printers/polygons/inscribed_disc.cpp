// The largest disc's centre is a node of the medial axis.
#include "printers/polygons/inscribed_disc.h"

#include <algorithm>

#include "printers/polygons/medial_axis.h"

namespace lamella {

InscribedDisc::InscribedDisc(const Polygons& piece) : piece_(piece) {
    constexpr double any = 1;  // mm: radii along curves lie between those of their ends
    const auto axis = traced_medial_axis(piece, any);
    if (!axis) return;
    greatest_ = 0;
    for (const MedialNode& node : axis->nodes) greatest_ = std::max(*greatest_, node.radius);
}

bool InscribedDisc::fits(double radius) const {
    return greatest_ ? radius <= *greatest_ : !offset_polygons(piece_, -radius).empty();
}

}  // namespace lamella
