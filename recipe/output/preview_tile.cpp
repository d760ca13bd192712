// Samples along edges borrow the light of a neighbouring pixel that shows the same surface, so that they cost
// a short ray only.
#include "recipe/output/preview_tile.h"

#include <array>
#include <cmath>

namespace lamella {
namespace {

constexpr int border_px = 1;  // px around the tile, neighbours of its pixels
constexpr int tile_edge = preview_tile + 2 * border_px;
constexpr float contrast_of_edges = 0.08F;  // difference between neighbours, in sRGB, above which more
                                            // samples are taken
constexpr double same_surface = 1.5;  // cells that a sample may lie off the plane of a neighbour's surface
constexpr double nearer = 4;          // cells by which a sample may lie nearer than all neighbours
constexpr int ground_step = 8;        // px between points of the ground whose light is computed
constexpr int ground_points = preview_tile / ground_step + 3;

double encoded_exactly(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

/// Converts linear light to sRGB, 0 to 1, by a table finer than the 8 bits of a picture.
float encoded(double light) {
    constexpr int steps = 8192;
    static const auto table = [] {
        std::array<float, steps + 1> values{};
        for (int i = 0; i <= steps; ++i)
            values[static_cast<std::size_t>(i)] = static_cast<float>(encoded_exactly(i / double{steps}));
        return values;
    }();
    return table[static_cast<std::size_t>(std::clamp(light, 0.0, 1.0) * steps)];
}

glm::vec3 encoded(glm::vec3 light) {
    return {encoded(double{light.x}), encoded(double{light.y}), encoded(double{light.z})};
}

struct Pixel {
    PreviewHit hit;
    glm::vec3 light{0};
    glm::vec3 code{0};  ///< the light in sRGB
};

class TilePainter {
  public:
    TilePainter(const PreviewView& view, int x, int y, Picture& picture)
        : view_(view), left_(x), top_(y), picture_(picture) {
        ground_.fill(-1);
    }

    void draw() {
        for (int j = 0; j < tile_edge; ++j) {
            for (int i = 0; i < tile_edge; ++i) pixels_[at(i, j)] = pixel(i, j);
        }
        for (int j = border_px; j < tile_edge - border_px && top_ + j - border_px < picture_.height; ++j) {
            for (int i = border_px; i < tile_edge - border_px && left_ + i - border_px < picture_.width;
                 ++i) {
                const glm::vec3 code =
                    view_.smooth() && on_edge(i, j) ? smoothed(i, j) : pixels_[at(i, j)].code;
                store(left_ + i - border_px, top_ + j - border_px, code);
            }
        }
    }

  private:
    static std::size_t at(int i, int j) {
        return static_cast<std::size_t>(std::ptrdiff_t{j} * tile_edge + i);
    }

    /// The point of the picture, -1 to 1 across its shorter side, at a place in the tile.
    dvec2 place(double i, double j) const {
        const double half = std::min(picture_.width, picture_.height) / 2.0;
        return {(left_ - border_px + i - picture_.width / 2.0) / half,
                (picture_.height / 2.0 - (top_ - border_px + j)) / half};
    }

    Pixel pixel(int i, int j) {
        const dvec2 p = place(i + 0.5, j + 0.5);
        const dvec3 direction = view_.ray(p.x, p.y);
        Pixel pixel{view_.trace(direction)};
        pixel.light = light_of(pixel.hit, direction, i + 0.5, j + 0.5);
        pixel.code = encoded(pixel.light);
        return pixel;
    }

    glm::vec3 light_of(const PreviewHit& hit, dvec3 direction, double i, double j) {
        if (hit.seen != Seen::ground) return glm::vec3(view_.shade(hit, direction));
        return glm::vec3(view_.backdrop(place(i, j).y) * ground_light(i, j));
    }

    /// Returns the light of the ground, which changes slowly, from a few points of it.
    double ground_light(double i, double j) {
        const double x = (i - border_px) / ground_step + 1, y = (j - border_px) / ground_step + 1;
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        const double fx = x - column, fy = y - row;
        const double above = ground_point(column, row) * (1 - fx) + ground_point(column + 1, row) * fx;
        const double below =
            ground_point(column, row + 1) * (1 - fx) + ground_point(column + 1, row + 1) * fx;
        return above * (1 - fy) + below * fy;
    }

    double ground_point(int column, int row) {
        float& light = ground_[static_cast<std::size_t>(std::ptrdiff_t{row} * ground_points + column)];
        if (light < 0) {
            const dvec2 p =
                place((column - 1) * ground_step + border_px, (row - 1) * ground_step + border_px);
            light = static_cast<float>(view_.ground_light(view_.ray(p.x, p.y)));
        }
        return double{light};
    }

    bool on_edge(int i, int j) const {
        const glm::vec3 code = pixels_[at(i, j)].code;
        const auto differs = [&](int x, int y) {
            const glm::vec3 d = glm::abs(pixels_[at(x, y)].code - code);
            return std::max({d.x, d.y, d.z}) > contrast_of_edges;
        };
        return differs(i - 1, j) || differs(i + 1, j) || differs(i, j - 1) || differs(i, j + 1);
    }

    /// Returns the mean of a rotated 2 x 2 grid of samples.
    glm::vec3 smoothed(int i, int j) {
        double nearest = infinity;
        for (int y = j - 1; y <= j + 1; ++y) {
            for (int x = i - 1; x <= i + 1; ++x) nearest = std::min(nearest, pixels_[at(x, y)].hit.depth);
        }
        constexpr std::array<dvec2, 4> places{
            {{0.375, 0.125}, {0.875, 0.375}, {0.625, 0.875}, {0.125, 0.625}}};
        glm::vec3 sum(0);
        for (const dvec2 offset : places) sum += sample(i, j, offset, std::max(nearest - nearer, 0.0));
        return encoded(sum * (1.0F / static_cast<float>(places.size())));
    }

    glm::vec3 sample(int i, int j, dvec2 offset, double from) {
        const dvec2 p = place(i + offset.x, j + offset.y);
        const dvec3 direction = view_.ray(p.x, p.y);
        const PreviewHit hit = view_.trace(direction, from);
        if (hit.seen != Seen::ground) {
            if (const Pixel* const same = neighbour_with(hit, i, j)) return same->light;
        }
        return light_of(hit, direction, i + offset.x, j + offset.y);
    }

    /// Returns the pixel next to (i, j) whose surface continues to the hit; null when there is none.
    const Pixel* neighbour_with(const PreviewHit& hit, int i, int j) const {
        const Pixel* best = nullptr;
        double least = same_surface;
        for (int y = j - 1; y <= j + 1; ++y) {
            for (int x = i - 1; x <= i + 1; ++x) {
                const Pixel& pixel = pixels_[at(x, y)];
                if (pixel.hit.seen != hit.seen) continue;
                const dvec3 apart = hit.point - pixel.hit.point;
                // Off the neighbour's plane, and turned against it.
                const double off = std::abs(dot(apart, pixel.hit.normal)) + 0.02 * length(apart) +
                                   (1 - dot(hit.normal, pixel.hit.normal));
                if (off < least) {
                    least = off;
                    best = &pixel;
                }
            }
        }
        return best;
    }

    void store(int x, int y, glm::vec3 code) {
        std::uint8_t* const out =
            &picture_.rgb[(static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                           static_cast<std::size_t>(x)) *
                          3];
        for (int k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(std::lround(code[k] * 255));
    }

    const PreviewView& view_;
    int left_, top_;
    Picture& picture_;
    std::vector<Pixel> pixels_ = std::vector<Pixel>(static_cast<std::size_t>(tile_edge) * tile_edge);
    std::array<float, static_cast<std::size_t>(ground_points) * ground_points> ground_{};  ///< < 0: unknown
};

}  // namespace

void draw_tile(const PreviewView& view, int x, int y, Picture& picture) {
    TilePainter(view, x, y, picture).draw();
}

}  // namespace lamella
