// The picture's distance in the plane of the chart, combined with the strut along the seams.
#include "procedural/skin/image_windows.h"

#include <algorithm>
#include <limits>

namespace lamella {
namespace {

constexpr double cubes_in_a_strut = 4;

/// Returns the point on the picture, mm, rightward and upward as seen from outside the body.
dvec2 on_picture(Chart chart, const Box& bounds, dvec3 p) {
    // Seen from -y or from above, x points to the right; seen from +x, y does.
    const int right = chart.axis == 0 ? 1 : 0, up = chart.axis == 2 ? 1 : 2;
    const bool mirrored = chart.axis == 1 ? chart.positive : !chart.positive;
    return {mirrored ? bounds.hi[right] - p[right] : p[right] - bounds.lo[right], p[up] - bounds.lo[up]};
}

}  // namespace

ImageWindows::ImageWindows(StrutImage image, const Field& body, double strut, double depth)
    : image_(std::move(image)),
      half_strut_(0.5 * strut),
      bounds_(body.bounds()),
      charts_(body, strut / cubes_in_a_strut, depth) {}

double ImageWindows::value_near(dvec3 p, std::uint32_t& hint) const {
    const std::uint32_t leaf = charts_.leaf_at(p, hint);
    if (leaf == SurfaceCharts::none) return -std::numeric_limits<double>::min();
    hint = leaf;
    const dvec2 place = on_picture(charts_.chart(leaf), bounds_, p);
    const double image = image_.value(place.x, place.y);
    const double limit = std::abs(image) + half_strut_;
    const double seam = charts_.seam_distance(leaf, p, limit) - half_strut_;
    if (seam > 0 && image > 0) return std::min(seam, image);
    // The path to another chart's windows crosses the whole strut along the seam.
    return -std::max(-seam, std::min(-image, seam + 2 * half_strut_));
}

}  // namespace lamella
