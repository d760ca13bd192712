// Searches pairs of positions, and a third position for the best pair.
#include "printers/vector/dowel_places.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lamella {
namespace {

constexpr int grid = 24;  // candidates along each axis
constexpr std::size_t max_border_points = 200;
constexpr double min_distance = 3;  // diameters

double distance(dvec2 a, dvec2 b) {
    const dvec2 way = b - a;
    return std::sqrt(way.x * way.x + way.y * way.y);
}

std::vector<dvec2> candidates(const Polygons& clear) {
    std::vector<dvec2> found;
    const Interval x = extent(clear, {1, 0}), y = extent(clear, {0, 1});
    for (int j = 0; j < grid; ++j) {
        for (int i = 0; i < grid; ++i) {
            const dvec2 p(x.lo + x.width() * (i + 0.5) / grid, y.lo + y.width() * (j + 0.5) / grid);
            if (is_inside(clear, p)) found.push_back(p);
        }
    }
    // Regions thinner than the grid are represented by their border.
    std::vector<dvec2> border;
    for (const ClipperLib::Path& polygon : clear) {
        for (const dvec2& p : to_points(polygon)) border.push_back(p);
    }
    const std::size_t step = border.size() / max_border_points + 1;
    for (std::size_t i = 0; i < border.size(); i += step) found.push_back(border[i]);
    return found;
}

/// Returns how far a pair, at its worst hole, is from its flipped or rotated image; the least of the three
/// transformations.
double asymmetry(dvec2 a, dvec2 b, dvec2 middle) {
    double least = infinity;
    for (const dvec2 sign : {dvec2(-1, 1), dvec2(1, -1), dvec2(-1, -1)}) {
        double most = 0;
        for (const dvec2 p : {a, b}) {
            const dvec2 image = middle + (p - middle) * sign;
            most = std::max(most, std::min(distance(image, a), distance(image, b)));
        }
        least = std::min(least, most);
    }
    return least;
}

bool fits_one_way(dvec2 a, dvec2 b, dvec2 c, double diameter) {
    std::array<double, 3> sides{distance(a, b), distance(b, c), distance(c, a)};
    std::ranges::sort(sides);
    const dvec2 ab = b - a, ac = c - a;
    const double height = std::abs(ab.x * ac.y - ab.y * ac.x) / sides[2];
    return sides[0] >= min_distance * diameter && sides[1] - sides[0] >= diameter &&
           sides[2] - sides[1] >= diameter && height >= diameter;
}

}  // namespace

bool is_inside(const Polygons& polygons, dvec2 point) {
    const ClipperLib::IntPoint p = to_polygon({point}).front();
    int depth = 0;
    for (const ClipperLib::Path& polygon : polygons) {
        const int where = ClipperLib::PointInPolygon(p, polygon);
        if (where < 0) return true;
        if (where > 0) depth += ClipperLib::Orientation(polygon) ? 1 : -1;
    }
    return depth > 0;
}

std::vector<dvec2> dowel_places(const Polygons& clear, dvec2 middle, int count, double diameter) {
    const std::vector<dvec2> all = candidates(clear);
    std::vector<dvec2> best;
    double most = min_distance * diameter;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double apart = distance(all[i], all[j]);
            if (apart <= most || asymmetry(all[j], all[i], middle) < diameter) continue;
            if (count == 2) {
                most = apart;
                best = {all[j], all[i]};
                continue;
            }
            double least = 0;
            dvec2 third{0};
            for (const dvec2& c : all) {
                const double near = std::min(distance(c, all[i]), distance(c, all[j]));
                if (near <= least || !fits_one_way(all[j], all[i], c, diameter)) continue;
                least = near;
                third = c;
            }
            if (least == 0) continue;
            most = apart;
            best = {all[j], all[i], third};
        }
    }
    return best;
}

}  // namespace lamella
