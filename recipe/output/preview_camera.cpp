// Long lenses flatter parts.
#include "recipe/output/preview_camera.h"

namespace lamella {
namespace {

constexpr double half_view = 14 * pi / 180;  // half the angle of view
constexpr double margin = 0.86;              // share of the picture that the part fills

/// Half the picture's sides, the shorter one being 1.
dvec2 half_sides(const PreviewOptions& options) {
    const double shorter = std::min(options.width, options.height);
    return dvec2(options.width, options.height) / shorter;
}

dvec3 forward_of(const PreviewOptions& options) {
    const double a = options.azimuth * pi / 180, e = options.elevation * pi / 180;
    return -dvec3(std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e));
}

/// Returns the distance from which all corners of a box are seen.
double distance_for(const Box& bounds, const PreviewCamera& camera, dvec2 view_extent) {
    double back = 0;
    for (int c = 0; c < 8; ++c) {
        const dvec3 corner = dvec3(c & 1, c >> 1 & 1, c >> 2) * bounds.size() - bounds.size() * 0.5;
        const double x = std::abs(glm::dot(corner, camera.right)) / view_extent.x;
        const double y = std::abs(glm::dot(corner, camera.up)) / view_extent.y;
        back = std::max(back, std::max(x, y) - glm::dot(corner, camera.forward));
    }
    return back;
}

}  // namespace

PreviewCamera camera_before(const Box& bounds, const PreviewOptions& options) {
    PreviewCamera camera{};
    camera.reach = std::tan(half_view);
    camera.forward = forward_of(options);
    camera.right = glm::normalize(glm::cross(camera.forward, dvec3(0, 0, 1)));
    camera.up = glm::cross(camera.right, camera.forward);
    const dvec2 view_extent = half_sides(options) * (camera.reach * margin);
    // The sphere around the bounds looks the same from everywhere.
    const double back = options.steady ? length(bounds.size()) / 2 / std::sin(half_view * margin)
                                       : distance_for(bounds, camera, view_extent);
    camera.eye = bounds.center() - camera.forward * back;
    return camera;
}

void zoom_to(PreviewCamera& camera, std::span<const dvec3> points, const PreviewOptions& options) {
    Rect seen;
    for (const dvec3& point : points) {
        const dvec3 d = point - camera.eye;
        const double depth = glm::dot(d, camera.forward);
        const dvec2 p{glm::dot(d, camera.right) / depth, glm::dot(d, camera.up) / depth};
        seen.lo = glm::min(seen.lo, p);
        seen.hi = glm::max(seen.hi, p);
    }
    if (seen.empty()) return;
    const dvec2 half = seen.size() * 0.5 / half_sides(options);
    camera.shift = seen.center();
    camera.reach = std::max(half.x, half.y) / margin;
}

PreviewCut cut_plane(const Box& bounds, const PreviewOptions& options) {
    PreviewCut plane;
    if (options.printed_to) {
        if (*options.printed_to < bounds.hi.z) plane = {2, *options.printed_to, 1};
        return plane;
    }
    if (options.cut < 'x' || options.cut > 'z') return plane;
    plane.axis = options.cut - 'x';
    plane.at = bounds.lo[plane.axis] + options.cut_at * bounds.size()[plane.axis];
    plane.side = forward_of(options)[plane.axis] <= 0 ? 1 : -1;
    return plane;
}

Box kept_by(const PreviewCut& plane, const Box& bounds) {
    Box kept = bounds;
    if (plane.axis >= 0) (plane.side > 0 ? kept.hi : kept.lo)[plane.axis] = plane.at;
    return kept;
}

}  // namespace lamella
