// Rounds contours and drops points that coincide after rounding.
#include "printers/archive/grid_polygon.h"

#include <cmath>

namespace lamella {

std::vector<GridPolygon> on_grid(const std::vector<Contour>& contours) {
    std::vector<GridPolygon> polygons;
    for (const Contour& contour : contours) {
        GridPolygon polygon;
        polygon.hole = contour.hole;
        polygon.points.reserve(contour.points.size());
        for (const dvec2& p : contour.points) {
            const std::array<std::int64_t, 2> point{std::llround(p.x * grid_units_per_mm),
                                                    std::llround(p.y * grid_units_per_mm)};
            if (polygon.points.empty() || polygon.points.back() != point) polygon.points.push_back(point);
        }
        while (polygon.points.size() > 1 && polygon.points.back() == polygon.points.front())
            polygon.points.pop_back();
        if (polygon.points.size() >= 3) polygons.push_back(std::move(polygon));
    }
    return polygons;
}

double total_area(const std::vector<Contour>& contours) {
    double area = 0;
    for (const Contour& contour : contours) area += signed_area(contour.points);
    return area;
}

}  // namespace lamella
