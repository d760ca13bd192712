// Sections of foams of struts about as thin as a bead, as beads: every island printed, and all of it.
#include <catch2/catch.hpp>

#include "engine/contours/contours.h"
#include "engine/field/slice_context.h"
#include "printers/polygons/polygons.h"
#include "printers/toolpath/toolpath.h"
#include "procedural/foam/voronoi_foam.h"

namespace foam_toolpath_test {

using namespace lamella;

namespace {

constexpr double height = 0.2, edge = 20;  // mm

/// The outer contours with the holes directly in them.
std::vector<Polygons> islands_of(const std::vector<Contour>& contours) {
    std::vector<Polygons> islands(contours.size());
    for (std::size_t i = 0; i < contours.size(); ++i) {
        const std::size_t at = contours[i].hole ? static_cast<std::size_t>(contours[i].parent) : i;
        islands[at].push_back(to_polygon(contours[i].points));
    }
    std::erase_if(islands, [](const Polygons& island) { return island.empty(); });
    return islands;
}

bool covers(const Bead& bead, dvec2 p) {
    const std::size_t n = bead.points.size();
    for (std::size_t i = 0; i + (bead.closed ? 0 : 1) < n; ++i) {
        const std::size_t j = (i + 1) % n;
        const dvec2 a = bead.points[i], way = bead.points[j] - a;
        const double square = glm::dot(way, way);
        const double t = square > 0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0;
        const double width = bead.width_at(i) + (bead.width_at(j) - bead.width_at(i)) * t;
        if (glm::distance(p, a + way * t) <= width / 2) return true;
    }
    return false;
}

Rect box_of(const std::vector<dvec2>& points) {
    Rect box;
    for (const dvec2& p : points) box = unite(box, Rect{p, p});
    return box;
}

}  // namespace

TEST_CASE("no strut of a foam is left out, nor any part of one", "[toolpath]") {
    const double strut = GENERATE(0.6, 0.35);  // diameter, mm
    CAPTURE(strut);
    FoamSettings settings;
    settings.cell = 2;
    settings.beam_radius = strut / 2;
    settings.seed = 1;
    settings.region = {{0, 0, 0}, {edge, edge, edge}};
    const auto foam = make_voronoi_foam(settings);
    double area = 0, laid = 0, covered = 0, sampled = 0;
    int islands = 0, without = 0;
    for (int layer = 0; layer < 100; layer += 9) {
        SliceContext context;
        Scratch scratch;
        const SliceField& slice = context.slice(*foam, (layer + 0.5) * height);
        const std::vector<Contour> contours = trace_contours(slice, 0.025, scratch);
        const Toolpaths paths = plan_toolpaths(contours, {{0.45, height, 0.025}}, layer);
        std::vector<Rect> boxes;
        for (const Bead& bead : paths.beads) {
            laid += bead_volume(bead, height);
            Rect box = box_of(bead.points);
            box.lo -= dvec2(bead.width);
            box.hi += dvec2(bead.width);
            boxes.push_back(box);
        }
        for (const Polygons& island : islands_of(contours)) {
            area += area_of(island);
            const bool wide = !offset_polygons(island, -0.15).empty();
            bool printed = false;
            const Rect box = box_of(to_points(island.front()));
            constexpr double step = 0.05;
            for (double y = box.lo.y + step / 2; y < box.hi.y; y += step) {
                for (double x = box.lo.x + step / 2; x < box.hi.x; x += step) {
                    const ClipperLib::IntPoint point(static_cast<ClipperLib::cInt>(x * polygon_scale),
                                                     static_cast<ClipperLib::cInt>(y * polygon_scale));
                    int windings = 0;
                    for (const ClipperLib::Path& ring : island) {
                        if (ClipperLib::PointInPolygon(point, ring) != 0)
                            windings += ClipperLib::Orientation(ring) ? 1 : -1;
                    }
                    if (windings != 1) continue;
                    ++sampled;
                    const dvec2 p(x, y);
                    for (std::size_t b = 0; b < boxes.size(); ++b) {
                        if (p.x < boxes[b].lo.x || p.x > boxes[b].hi.x || p.y < boxes[b].lo.y ||
                            p.y > boxes[b].hi.y || !covers(paths.beads[b], p))
                            continue;
                        ++covered;
                        printed = true;
                        break;
                    }
                }
            }
            islands += wide ? 1 : 0;
            without += wide && !printed ? 1 : 0;
        }
    }
    CHECK(islands > 500);
    CHECK(without == 0);
    CHECK(laid == Approx(area * height).epsilon(0.01));
    CHECK(covered > 0.95 * sampled);
}

}  // namespace foam_toolpath_test
