// Surfaces and light both come from the grid; only the cut's face has runs of its own.
#include "recipe/output/preview_view.h"

namespace lamella {
namespace {

constexpr dvec3 part_colour{0.42, 0.52, 0.60};
constexpr dvec3 cut_colour{0.86, 0.30, 0.09};
constexpr dvec3 support_colour{0.82, 0.63, 0.28};
constexpr dvec3 support_cut_colour{0.95, 0.82, 0.45};
constexpr dvec3 fault_colour{0.80, 0.05, 0.04};
constexpr dvec3 sky_top{0.80, 0.84, 0.88};
constexpr dvec3 sky_bottom{0.93, 0.93, 0.92};
constexpr dvec3 key_light{1.00, 0.95, 0.88};
constexpr dvec3 fill_light{0.55, 0.65, 0.80};

/// Returns the interval of a ray inside a box.
Interval through(const Box& box, dvec3 start, dvec3 direction) {
    Interval inside{0, infinity};
    for (int k = 0; k < 3; ++k) {
        if (direction[k] == 0) {
            if (start[k] < box.lo[k] || start[k] > box.hi[k]) return {};
            continue;
        }
        const double a = (box.lo[k] - start[k]) / direction[k];
        const double b = (box.hi[k] - start[k]) / direction[k];
        inside.lo = std::max(inside.lo, std::min(a, b));
        inside.hi = std::min(inside.hi, std::max(a, b));
    }
    return inside;
}

PreviewCut in_cells(PreviewCut plane, const CoverageGrid& grid) {
    if (plane.axis >= 0) plane.at = grid.to_grid(dvec3(plane.at))[plane.axis];
    return plane;
}

}  // namespace

PreviewView::PreviewView(const CoverageGrid& grid, std::shared_ptr<const CutFace> face, const PreviewCut& cut,
                         const PreviewCamera& camera, const Box& bounds, const PreviewOptions& options)
    : grid_(grid),
      face_(std::move(face)),
      cut_mm_(cut),
      cut_(in_cells(cut, grid)),
      camera_(camera),
      eye_(grid.to_grid(camera.eye)),
      ground_(grid.to_grid(bounds.lo).z),
      options_(options) {
    const dvec3 size = grid.densities().size();
    inside_ = kept_by(cut_, {dvec3(0), size});
    const dvec3 side = camera.right * 0.35 - camera.forward * 0.6;
    key_ = glm::normalize(dvec3(side.x, side.y, 0) + dvec3(0, 0, 0.95));
    reach_ = size.x + size.y + size.z;
}

std::optional<PreviewHit> PreviewView::cut_hit(dvec3 direction, double t) const {
    const dvec3 point = eye_ + direction * t;
    if (!face_ || std::abs(point[cut_.axis] - cut_.at) > 1e-6 * (1 + t)) return std::nullopt;
    dvec3 p = grid_.to_part(point);
    p[cut_.axis] = cut_mm_.at;
    const CutFace::Kind kind = face_->at(p);
    if (kind == CutFace::Kind::none) return std::nullopt;
    PreviewHit hit{kind == CutFace::Kind::part ? Seen::part_cut : Seen::second_cut, t, point, dvec3(0)};
    hit.normal[cut_.axis] = cut_.side;
    return hit;
}

PreviewHit PreviewView::trace(dvec3 direction, double from) const {
    const Interval inside = through(inside_, eye_, direction);
    if (inside.empty()) return {};
    if (inside.lo >= from) {
        if (const auto face = cut_hit(direction, inside.lo)) return *face;
    }
    const auto t = grid_.surface(BrickMap::Ray(eye_, direction), std::max(inside.lo, from), inside.hi);
    if (!t) return {};
    const dvec3 p = eye_ + direction * *t;
    dvec3 normal = -grid_.densities().slope(p);
    // Where rays enter the solid, its surface cannot face away: drop that part of the normal.
    normal -= direction * std::max(glm::dot(normal, direction), 0.0);
    const double steepness = length(normal);
    normal = steepness > 0 ? normal / steepness : -direction;
    constexpr double below = 0.7;  // cells
    return {grid_.of_second(p - normal * below) ? Seen::second : Seen::part, *t, p, normal};
}

/// Returns the share of the sky visible from a surface: one cone along the normal and three leaning by 60
/// degrees.
double PreviewView::openness(dvec3 p, dvec3 n, double reach) const {
    const dvec3 aside = std::abs(n.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
    const dvec3 u = glm::normalize(glm::cross(n, aside));
    const dvec3 v = glm::cross(n, u);
    const dvec3 start = p + n * 1.5;
    const DensityPyramid& solid = grid_.densities();
    double sum = solid.cone(start, n, 1.15, reach, cut_);
    constexpr double root = 0.8660254;
    for (const dvec2 lean : {dvec2(root, 0), dvec2(-root / 2, 0.75), dvec2(-root / 2, -0.75)})
        sum += solid.cone(start, n * 0.5 + u * lean.x + v * lean.y, 1.15, reach, cut_);
    return sum / 4;
}

dvec3 PreviewView::colour_of(const PreviewHit& hit) const {
    const bool on_cut = hit.seen == Seen::part_cut || hit.seen == Seen::second_cut;
    if (hit.seen == Seen::second || hit.seen == Seen::second_cut) {
        if (options_.faults) return fault_colour;
        return on_cut ? support_cut_colour : support_colour;
    }
    if (options_.paint) return options_.paint(grid_.to_part(hit.point));
    return on_cut ? cut_colour : part_colour;
}

dvec3 PreviewView::shade(const PreviewHit& hit, dvec3 direction) const {
    const dvec3 p = hit.point, n = hit.normal;
    const dvec3 albedo = colour_of(hit);
    const double open = openness(p, n, reach_ * 0.15);
    const double facing = glm::dot(n, key_);
    const double sun =
        facing > 0 ? facing * grid_.densities().cone(p + n * 2.0, key_, 0.16, reach_, cut_) : 0;
    const double sky = 0.65 + 0.35 * n.z;
    const double front = std::max(0.0, -glm::dot(n, direction));
    const dvec3 half = glm::normalize(key_ - direction);
    const double gloss = sun * std::pow(std::max(0.0, glm::dot(n, half)), 40.0) * 0.25;
    return albedo *
               (key_light * (1.15 * sun) + fill_light * (0.75 * sky * open) + dvec3(0.22 * front * open)) +
           dvec3(gloss);
}

dvec3 PreviewView::backdrop(double y) const {
    const double k = std::clamp(0.5 + 0.5 * y, 0.0, 1.0);
    return sky_bottom * (1 - k) + sky_top * k;
}

double PreviewView::ground_light(dvec3 direction) const {
    const double t = (ground_ - eye_.z) / direction.z;
    if (!(direction.z < 0) || !(t > 0)) return 1;
    const dvec3 p = eye_ + direction * t;
    const dvec3 up(0, 0, 1);
    const double shadow = 1 - grid_.densities().cone(p + up * 1.0, key_, 0.30, reach_, cut_);
    const double contact = 1 - openness(p, up, reach_ * 0.25);
    return (1 - 0.38 * shadow) * (1 - 0.55 * contact);
}

}  // namespace lamella
