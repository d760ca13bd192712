// Distances to contours in layers, bounded from below by the layer beneath.
#include "procedural/optimization/overhang_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/base/parallel.h"

namespace lamella {

namespace {

using glm::dvec2;

constexpr int band = 3;  // elements: distances beyond are not told apart

double distance_to_segment(dvec2 p, dvec2 a, dvec2 b) {
    const dvec2 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * along);
}

/// The contour of a layer, where its values pass 0; they are negative inside.
class LayerContour {
  public:
    LayerContour(glm::ivec3 size, std::vector<double> values)
        : width_(size.x), height_(size.y), values_(std::move(values)), distances_(values_.size(), band) {}

    /// Returns the distance of each element's centre to the contour, in elements; negative inside.
    std::vector<double> distances() {
        for (int y = 0; y + 1 < height_; ++y) {
            for (int x = 0; x + 1 < width_; ++x) add_contour(x, y);
        }
        for (std::size_t i = 0; i < values_.size(); ++i) {
            if (values_[i] < 0) distances_[i] = -distances_[i];
        }
        return std::move(distances_);
    }

  private:
    std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    double value(int x, int y) const { return values_[place(x, y)]; }

    /// Adds the contour in the square between four centres (marching squares).
    void add_contour(int x, int y) {
        static constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        std::array<dvec2, 4> crossing{};
        std::size_t crossings = 0;
        double sum = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const auto [ax, ay] = corners[c];
            const auto [bx, by] = corners[(c + 1) % 4];
            const double a = value(x + ax, y + ay), b = value(x + bx, y + by);
            sum += a;
            if ((a < 0) == (b < 0)) continue;
            crossing[crossings++] = dvec2(x + ax, y + ay) + a / (a - b) * dvec2(bx - ax, by - ay);
        }
        if (crossings == 2) add_segment(crossing[0], crossing[1]);
        if (crossings < 4) return;
        // A saddle: its middle says which pair of corners is joined.
        const bool cuts_first_corner = (sum < 0) != (value(x, y) < 0);
        add_segment(crossing[0], crossing[cuts_first_corner ? 3 : 1]);
        add_segment(crossing[2], crossing[cuts_first_corner ? 1 : 3]);
    }

    void add_segment(dvec2 a, dvec2 b) {
        const auto from = [](double u, double v) {
            return std::max(0, static_cast<int>(std::min(u, v)) - band);
        };
        const auto to = [](double u, double v, int size) {
            return std::min(size - 1, static_cast<int>(std::max(u, v)) + band + 1);
        };
        for (int y = from(a.y, b.y); y <= to(a.y, b.y, height_); ++y) {
            for (int x = from(a.x, b.x); x <= to(a.x, b.x, width_); ++x) {
                double& d = distances_[place(x, y)];
                d = std::min(d, distance_to_segment(dvec2(x, y), a, b));
            }
        }
    }

    int width_, height_;
    std::vector<double> values_, distances_;
};

/// Replaces each value by a quarter of its neighbours along an axis and half of itself; beyond the grid it
/// goes on as it is.
void smooth(const DensityGrid& grid, int axis, std::vector<double>& values) {
    std::vector<double> former = values;
    parallel_for(grid.size.y * grid.size.z, [&](int row) {
        for (int x = 0; x < grid.size.x; ++x) {
            const glm::ivec3 at(x, row % grid.size.y, row / grid.size.y);
            glm::ivec3 before = at, after = at;
            before[axis] = std::max(0, at[axis] - 1);
            after[axis] = std::min(grid.size[axis] - 1, at[axis] + 1);
            values[grid.place(at)] = 0.5 * former[grid.place(at)] +
                                     0.25 * (former[grid.place(before)] + former[grid.place(after)]);
        }
    });
}

/// Returns g for the shape above a level.
std::vector<double> limited_distances(const DensityGrid& grid, double level, double slope) {
    const std::size_t count = grid.place({0, 0, 1});
    std::vector<double> distance;
    distance.reserve(grid.density.size());
    std::vector<double> least(count, -band), layer(count);
    for (std::size_t first = 0; first < grid.density.size(); first += count) {
        for (std::size_t i = 0; i < count; ++i) layer[i] = level - grid.density[first + i];
        if (first > 0) {
            layer = LayerContour(grid.size, std::move(layer)).distances();
            for (std::size_t i = 0; i < count; ++i) {
                const bool stays = grid.use[first + i] == ElementUse::solid;
                least[i] = stays ? -band : distance[first - count + i] - slope;
                layer[i] = std::max(layer[i], least[i]);
            }
        }
        // Where the layer below cut it, the maximum is no distance to the contour: too small near corners.
        layer = LayerContour(grid.size, std::move(layer)).distances();
        for (std::size_t i = 0; i < count; ++i) distance.push_back(std::max(layer[i], least[i]));
    }
    return distance;
}

}  // namespace

DensityGrid with_limited_overhang(const DensityGrid& grid, double volume, int factor, double slope) {
    constexpr double middle = 0.5;
    const auto become = [&](DensityGrid& g, const std::vector<double>& distance) {
        for (std::size_t i = 0; i < distance.size(); ++i) g.density[i] = middle - distance[i] / (2.0 * band);
    };
    // What is cut off below is made up for before the cut: afterwards, members may be parted.
    DensityGrid limited = grid;
    Interval level{0, 1};
    constexpr int halvings = 10;
    for (int k = 0; k < halvings; ++k) {
        const double tried = 0.5 * (level.lo + level.hi);
        std::vector<double> distance = limited_distances(grid, tried, slope);
        for (int axis = 0; axis < 3; ++axis) smooth(grid, axis, distance);
        become(limited, distance);
        (solid_volume(limited, middle) > volume ? level.lo : level.hi) = tried;
    }
    DensityGrid fine = refined(limited, factor);
    become(fine, limited_distances(fine, middle, slope));
    return fine;
}

}  // namespace lamella
