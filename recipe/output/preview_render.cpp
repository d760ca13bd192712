// Ray casting: the grid up to the first solid cell, the field for the surface and its normal, cone tracing
// for ambient light.
#include "recipe/output/preview_render.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/parallel.h"
#include "engine/solids/csg.h"
#include "recipe/output/voxel_grid.h"

namespace lamella {

namespace {

constexpr double half_view =
    14 * std::numbers::pi / 180;  // half the angle of view; long lenses flatter parts
constexpr double margin = 0.86;   // share of the picture that the part fills
constexpr dvec3 part_colour{0.42, 0.52, 0.60};
constexpr dvec3 cut_colour{0.86, 0.30, 0.09};
constexpr dvec3 support_colour{0.82, 0.63, 0.28};
constexpr dvec3 support_cut_colour{0.95, 0.82, 0.45};
constexpr dvec3 fault_colour{0.80, 0.05, 0.04};
constexpr dvec3 sky_top{0.80, 0.84, 0.88};
constexpr dvec3 sky_bottom{0.93, 0.93, 0.92};
constexpr dvec3 key_light{1.00, 0.95, 0.88};
constexpr dvec3 fill_light{0.55, 0.65, 0.80};
constexpr double contrast_of_edges = 0.08;  // difference between neighbours, in sRGB, above which more
                                            // samples are taken

struct Camera {
    dvec3 eye, forward, right, up;
    dvec2 shift{0};                      ///< shift of the picture's centre that centres the part
    double reach = std::tan(half_view);  ///< half the picture's shorter side at distance 1

    /// Returns the direction through a point of the picture; x and y from -1 to 1 across the shorter side.
    dvec3 ray(double x, double y) const {
        return glm::normalize(forward + right * (x * reach + shift.x) + up * (y * reach + shift.y));
    }
};

Camera frame(const Box& bounds, const PreviewOptions& options) {
    const double a = options.azimuth * std::numbers::pi / 180;
    const double e = options.elevation * std::numbers::pi / 180;
    Camera camera;
    camera.forward = -dvec3(std::sin(a) * std::cos(e), -std::cos(a) * std::cos(e), std::sin(e));
    camera.right = glm::normalize(glm::cross(camera.forward, dvec3(0, 0, 1)));
    camera.up = glm::cross(camera.right, camera.forward);
    const double shorter = std::min(options.width, options.height);
    const dvec2 view_extent = dvec2(options.width, options.height) / shorter * (std::tan(half_view) * margin);
    double back = 0;
    for (int c = 0; c < 8; ++c) {
        const dvec3 corner = dvec3(c & 1, c >> 1 & 1, c >> 2) * bounds.size() - bounds.size() * 0.5;
        const double x = std::abs(glm::dot(corner, camera.right)) / view_extent.x;
        const double y = std::abs(glm::dot(corner, camera.up)) / view_extent.y;
        back = std::max(back, std::max(x, y) - glm::dot(corner, camera.forward));
    }
    camera.eye = bounds.center() - camera.forward * back;
    return camera;
}

/// Turns the camera and narrows its view until these points just fit the picture.
void zoom_to(Camera& camera, const std::vector<dvec3>& points, const PreviewOptions& options) {
    Rect seen;
    for (const dvec3& point : points) {
        const dvec3 d = point - camera.eye;
        const double depth = glm::dot(d, camera.forward);
        const dvec2 p{glm::dot(d, camera.right) / depth, glm::dot(d, camera.up) / depth};
        seen.lo = glm::min(seen.lo, p);
        seen.hi = glm::max(seen.hi, p);
    }
    if (seen.empty()) return;
    const double shorter = std::min(options.width, options.height);
    const dvec2 half = seen.size() * 0.5 / (dvec2(options.width, options.height) / shorter);
    camera.shift = seen.center();
    camera.reach = std::max(half.x, half.y) / margin;
}

/// The plane of the cut: the part on the eye's side of it is removed.
struct CutAway {
    int axis = -1;    ///< -1: nothing is cut
    double at = 0;    ///< mm
    double side = 1;  ///< +1: the side above `at` is removed
    Box kept;
};

CutAway cut_away(const Box& bounds, const Camera& camera, const PreviewOptions& options) {
    CutAway cut;
    cut.kept = bounds;
    if (options.cut < 'x' || options.cut > 'z') return cut;
    cut.axis = options.cut - 'x';
    cut.at = bounds.lo[cut.axis] + options.cut_at * bounds.size()[cut.axis];
    cut.side = camera.forward[cut.axis] <= 0 ? 1 : -1;
    (cut.side > 0 ? cut.kept.hi : cut.kept.lo)[cut.axis] = cut.at;
    return cut;
}

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

struct Hit {
    dvec3 point;
    dvec3 normal;
    bool on_cut = false;
    bool on_support = false;
};

class Scene {
  public:
    /// `all` is the union of part and supports; `part` is null when they need no distinction.
    Scene(const Field& all, const Field* part, const Box& bounds, const CutAway& cut, const Camera& camera,
          const VoxelGrid& grid)
        : all_(all), part_(part), bounds_(bounds), cut_(cut), camera_(camera), grid_(grid) {
        const dvec3 side = camera.right * 0.35 - camera.forward * 0.6;
        key_ = glm::normalize(dvec3(side.x, side.y, 0) + dvec3(0, 0, 0.95));
        reach_ = grid_.size().x + grid_.size().y + grid_.size().z;
    }

    /// Gives the second solid a colour different from that of supports.
    void paint_second(dvec3 colour) { second_ = second_cut_ = colour; }
    /// Takes surfaces from the grid, and the part from a second grid; null when everything is part.
    void look_quickly(const VoxelGrid* part) {
        is_quick_ = true;
        part_grid_ = part;
    }
    /// Sets the part's colour at every point; empty: its default colour.
    void paint_part(std::function<dvec3(dvec3)> paint) { paint_ = std::move(paint); }

    /// Returns the linear light at a point of the picture.
    dvec3 colour(double x, double y) const {
        const dvec3 direction = camera_.ray(x, y);
        if (const auto hit = trace(direction)) return shade(*hit, direction);
        return backdrop(direction, y);
    }

  private:
    std::optional<Hit> trace(dvec3 direction) const {
        Box reach = grown(cut_.kept, grid_.pitch());
        if (cut_.axis >= 0) (cut_.side > 0 ? reach.hi : reach.lo)[cut_.axis] = cut_.at;
        const Interval inside = through(reach, camera_.eye, direction);
        if (inside.empty()) return std::nullopt;
        if (const auto face = cut_face(direction, inside.lo)) return face;
        const dvec3 start = grid_.to_grid(camera_.eye);
        const double h = grid_.pitch();
        double at = inside.lo;  // void up to here
        for (double from = inside.lo;;) {
            const auto cell = grid_.next_solid(start, direction / h, from, inside.hi);
            if (!cell) return std::nullopt;
            if (is_quick_) return cell_face(direction, *cell);
            from = cell->hi;
            at = std::max(at, cell->lo - h);
            if (const auto t = surface(direction, at, std::min(cell->hi + h, inside.hi))) {
                const dvec3 p = camera_.eye + direction * t->lo;
                return Hit{p, normal(p, direction), false, of_support(camera_.eye + direction * t->hi)};
            }
        }
    }

    std::optional<Hit> cut_face(dvec3 direction, double t) const {
        if (cut_.axis < 0) return std::nullopt;
        dvec3 p = camera_.eye + direction * t;
        if (std::abs(p[cut_.axis] - cut_.at) > 1e-6 * grid_.pitch() * 1024) return std::nullopt;
        p[cut_.axis] = cut_.at;
        if (!is_solid(p)) return std::nullopt;
        Hit hit{p, dvec3(0), true, of_support(p)};
        hit.normal[cut_.axis] = cut_.side;
        return hit;
    }

    /// Finds the surface where a ray enters a solid cell.
    Hit cell_face(dvec3 direction, Interval cell) const {
        const dvec3 p = camera_.eye + direction * cell.lo;
        const dvec3 inside = camera_.eye + direction * ((cell.lo + cell.hi) / 2);
        dvec3 normal = -grid_.slope(grid_.to_grid(p));
        // A grid cell's face can be hit where the surface itself faces away: drop that part of the normal.
        normal -= direction * std::max(glm::dot(normal, direction), 0.0);
        const double length = glm::length(normal);
        return {p, length > 0 ? normal / length : -direction, false, of_support(inside)};
    }

    bool is_solid(dvec3 p) const { return is_quick_ ? grid_.solid_at(grid_.to_grid(p)) : all_.value(p) < 0; }

    /// Returns true if a position inside the solid belongs to the supports.
    bool of_support(dvec3 inside) const {
        if (is_quick_) return part_grid_ != nullptr && !part_grid_->solid_at(grid_.to_grid(inside));
        return part_ != nullptr && !(part_->value(inside) < 0);
    }

    /// Brackets the first change from void to solid on an interval of the ray; `at` moves up to the last
    /// certain void.
    std::optional<Interval> surface(dvec3 direction, double& at, double end) const {
        const double least = grid_.pitch() / 4;
        const bool distances = all_.metric() != Metric::sign;
        double before = at;
        double v_before = grid_.pitch();
        while (at <= end) {
            const double v = all_.value(camera_.eye + direction * at);
            if (v < 0) return crossing(direction, before, v_before, at, v);
            before = at;
            v_before = v;
            at += distances ? std::clamp(v, least, grid_.pitch()) : least;
        }
        return std::nullopt;
    }

    /// Finds the crossing between two points of the ray by false position, kept away from the ends so that
    /// each step shrinks the bracket.
    Interval crossing(dvec3 direction, double outside, double v_outside, double inside,
                      double v_inside) const {
        for (int i = 0; i < 3; ++i) {
            const double line = v_outside / (v_outside - v_inside);
            const double share = std::isfinite(line) ? std::clamp(line, 0.1, 0.9) : 0.5;
            const double t = outside + share * (inside - outside);
            const double v = all_.value(camera_.eye + direction * t);
            (v < 0 ? inside : outside) = t;
            (v < 0 ? v_inside : v_outside) = v;
        }
        return {outside, inside};
    }

    /// Central differences over the corners of a tetrahedron: four values instead of six.
    dvec3 normal(dvec3 p, dvec3 direction) const {
        const double e = 0.15 * grid_.pitch();
        const dvec3 corners[4]{{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
        dvec3 sum(0);
        for (const dvec3& c : corners) sum += c * all_.value(p + c * e);
        const double length = glm::length(sum);
        return length > 0 && std::isfinite(length) ? sum / length : -direction;
    }

    /// Returns the share of the sky visible from a surface: one cone along the normal and five leaning by 60
    /// degrees.
    double openness(dvec3 p, dvec3 n, double reach) const {
        const dvec3 aside = std::abs(n.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
        const dvec3 u = glm::normalize(glm::cross(n, aside));
        const dvec3 v = glm::cross(n, u);
        const dvec3 start = grid_.to_grid(p) + n * 1.5;
        double sum = grid_.cone(start, n, 1.15, reach);
        for (int i = 0; i < 5; ++i) {
            const double a = 2 * std::numbers::pi * i / 5;
            const dvec3 d = n * 0.5 + (u * std::cos(a) + v * std::sin(a)) * 0.8660254;
            sum += 0.6 * grid_.cone(start, d, 1.15, reach);
        }
        return sum / 4;
    }

    dvec3 colour_of(const Hit& hit) const {
        if (hit.on_support) return hit.on_cut ? second_cut_ : second_;
        if (paint_) return paint_(hit.point);
        return hit.on_cut ? cut_colour : part_colour;
    }

    double lit(dvec3 p, dvec3 n) const { return grid_.cone(grid_.to_grid(p) + n * 2.0, key_, 0.16, reach_); }

    dvec3 shade(const Hit& hit, dvec3 direction) const {
        const dvec3 n = glm::dot(hit.normal, direction) > 0 ? -hit.normal : hit.normal;
        const dvec3 albedo = colour_of(hit);
        const double open = openness(hit.point, n, reach_ * 0.15);
        const double facing = glm::dot(n, key_);
        const double sun = facing > 0 ? facing * lit(hit.point, n) : 0;
        const double sky = 0.65 + 0.35 * n.z;
        const double front = std::max(0.0, -glm::dot(n, direction));
        const dvec3 half = glm::normalize(key_ - direction);
        const double gloss = sun * std::pow(std::max(0.0, glm::dot(n, half)), 40.0) * 0.25;
        return albedo * (key_light * (1.15 * sun) + fill_light * (0.75 * sky * open) +
                         dvec3(0.22 * front * open)) +
               dvec3(gloss);
    }

    dvec3 backdrop(dvec3 direction, double y) const {
        const double k = std::clamp(0.5 + 0.5 * y, 0.0, 1.0);
        const dvec3 sky = sky_bottom * (1 - k) + sky_top * k;
        const double t = (bounds_.lo.z - camera_.eye.z) / direction.z;
        if (!(direction.z < 0) || !(t > 0)) return sky;
        const dvec3 p = camera_.eye + direction * t;
        const dvec3 up(0, 0, 1);
        const double shadow = 1 - grid_.cone(grid_.to_grid(p) + up * 1.0, key_, 0.30, reach_);
        const double contact = 1 - openness(p, up, reach_ * 0.25);
        return sky * ((1 - 0.38 * shadow) * (1 - 0.55 * contact));
    }

    const Field& all_;
    const Field* part_;
    Box bounds_;
    CutAway cut_;
    Camera camera_;
    const VoxelGrid& grid_;
    bool is_quick_ = false;
    const VoxelGrid* part_grid_ = nullptr;
    dvec3 key_;
    double reach_;
    dvec3 second_ = support_colour, second_cut_ = support_cut_colour;
    std::function<dvec3(dvec3)> paint_;
};

/// Converts linear light to sRGB, 0 to 1.
dvec3 encoded(dvec3 c) {
    for (int k = 0; k < 3; ++k) {
        const double v = std::clamp(c[k], 0.0, 1.0);
        c[k] = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    }
    return c;
}

class Painter {
  public:
    Painter(const Scene& scene, int width, int height) : scene_(scene), width_(width), height_(height) {
        pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    }

    Picture render() {
        parallel_for(height_, [&](int j) {
            for (int i = 0; i < width_; ++i) pixels_[at(i, j)] = encoded(sample(i + 0.5, j + 0.5));
        });
        Picture image{width_, height_, std::vector<std::uint8_t>(pixels_.size() * 3)};
        parallel_for(height_, [&](int j) {
            for (int i = 0; i < width_; ++i) {
                const dvec3 c = on_edge(i, j) ? smoothed(i, j) : pixels_[at(i, j)];
                for (int k = 0; k < 3; ++k) {
                    image.rgb[at(i, j) * 3 + static_cast<std::size_t>(k)] =
                        static_cast<std::uint8_t>(std::lround(c[k] * 255));
                }
            }
        });
        return image;
    }

  private:
    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i);
    }

    dvec3 sample(double i, double j) const {
        const double half = std::min(width_, height_) / 2.0;
        return scene_.colour((i - width_ / 2.0) / half, (height_ / 2.0 - j) / half);
    }

    bool on_edge(int i, int j) const {
        const dvec3 c = pixels_[at(i, j)];
        const auto differs = [&](int x, int y) {
            if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
            const dvec3 d = glm::abs(pixels_[at(x, y)] - c);
            return std::max({d.x, d.y, d.z}) > contrast_of_edges;
        };
        return differs(i - 1, j) || differs(i + 1, j) || differs(i, j - 1) || differs(i, j + 1);
    }

    /// Returns the mean of a rotated 2 x 2 grid of samples.
    dvec3 smoothed(int i, int j) const {
        return encoded((sample(i + 0.375, j + 0.125) + sample(i + 0.875, j + 0.375) +
                        sample(i + 0.625, j + 0.875) + sample(i + 0.125, j + 0.625)) *
                       0.25);
    }

    const Scene& scene_;
    int width_;
    int height_;
    std::vector<dvec3> pixels_;  ///< sRGB, one sample each
};

}  // namespace

Picture render_preview(const FieldPtr& part, const FieldPtr& supports, const Box& bounds,
                       const PreviewOptions& options) {
    constexpr int max_cells = 512;
    const FieldPtr all = supports ? make_union({part, supports}) : part;
    ThreadArena arena(options.threads);
    return arena.execute([&] {
        Camera camera = frame(bounds, options);
        const CutAway cut = cut_away(bounds, camera, options);
        const int pixels = std::max(options.width, options.height);
        const int cells = std::clamp(options.quick ? pixels * 5 / 4 : pixels / 2, 64, max_cells);
        const auto mark = options.quick ? VoxelGrid::Mark::covered : VoxelGrid::Mark::touched;
        const VoxelGrid grid(*all, cut.kept, cells, mark);
        std::optional<VoxelGrid> part_grid;
        if (options.quick && supports) part_grid.emplace(*part, cut.kept, cells, mark);
        camera = frame(cut.kept, options);
        zoom_to(camera, grid.solid_places(), options);
        Scene scene(*all, supports ? part.get() : nullptr, bounds, cut, camera, grid);
        if (options.quick) scene.look_quickly(part_grid ? &*part_grid : nullptr);
        if (options.faults) scene.paint_second(fault_colour);
        scene.paint_part(options.paint);
        return Painter(scene, options.width, options.height).render();
    });
}

}  // namespace lamella
