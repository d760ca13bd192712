// Bounding boxes of rings.
#include "printers/polygons/placed_polygons.h"

#include <utility>

namespace lamella {

Rect box_of(const Polygons& polygons) {
    ClipperLib::cInt x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    bool any = false;
    for (const ClipperLib::Path& ring : polygons) {
        for (const ClipperLib::IntPoint& p : ring) {
            x0 = any ? std::min(x0, p.X) : p.X;
            x1 = any ? std::max(x1, p.X) : p.X;
            y0 = any ? std::min(y0, p.Y) : p.Y;
            y1 = any ? std::max(y1, p.Y) : p.Y;
            any = true;
        }
    }
    if (!any) return {};
    const auto mm = [](ClipperLib::cInt units) { return static_cast<double>(units) / polygon_scale; };
    return {{mm(x0), mm(y0)}, {mm(x1), mm(y1)}};
}

PlacedPolygons::PlacedPolygons(Polygons polygons) : rings_(std::move(polygons)) {
    boxes_.reserve(rings_.size());
    for (const ClipperLib::Path& ring : rings_) boxes_.push_back(box_of({ring}));
}

Polygons PlacedPolygons::near(const Rect& where) const {
    Polygons found;
    for (std::size_t i = 0; i < rings_.size(); ++i) {
        if (!intersect(boxes_[i], where).empty()) found.push_back(rings_[i]);
    }
    return found;
}

}  // namespace lamella
