// Means of eight, interpolation, and cones (Crassin et al. 2011) for ambient light.
#include "recipe/output/density_pyramid.h"

#include <array>

#include "engine/base/parallel.h"
#include "recipe/output/plane_depths.h"
#include "recipe/output/whole_below.h"

namespace lamella {
namespace {

/// Rounded up: only truly empty blocks are 0.
std::uint8_t mean_of_eight(unsigned sum) { return static_cast<std::uint8_t>((sum + 7) / 8); }

glm::ivec3 half_of(const DensityPyramid::Level& below) {
    return {(below.nx + 1) / 2, (below.ny + 1) / 2, (below.nz + 1) / 2};
}

/// The share of a cell that lies inside, by the depth of its centre.
struct ShareOfDepth {
    std::array<std::uint8_t, 256> shares{};

    ShareOfDepth() {
        for (int i = 0; i < 256; ++i) {
            const int share = 128 + (i - 128) * 255 / depth_unit;
            shares[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::clamp(share, 0, 255));
        }
    }
    unsigned operator()(std::uint8_t depth) const { return shares[depth]; }
};

struct ShareItself {
    unsigned operator()(std::uint8_t share) const { return share; }
};

template <typename Share>
DensityPyramid::Level level_above(const DensityPyramid::Level& below, const Share& of) {
    DensityPyramid::Level level(half_of(below), below.per_cell / 2);
    parallel_for(level.nz, [&](int z) {
        for (int y = 0; y < level.ny; ++y) {
            // A block beyond the last cell takes its upper half from the border.
            const std::uint8_t* const a = &below.density[below.at(0, 2 * y, 2 * z)];
            const std::uint8_t* const b = a + below.row();
            const std::uint8_t* const c = a + below.plane();
            const std::uint8_t* const d = c + below.row();
            std::uint8_t* const out = &level.density[level.at(0, y, z)];
            for (std::size_t x = 0; x < static_cast<std::size_t>(level.nx); ++x) {
                const std::size_t i = 2 * x, j = i + 1;
                out[x] = mean_of_eight(of(a[i]) + of(a[j]) + of(b[i]) + of(b[j]) + of(c[i]) + of(c[j]) +
                                       of(d[i]) + of(d[j]));
            }
        }
    });
    return level;
}

/// Weights of four neighbours in a uniform cubic B-spline, and their derivatives; f from 0 to 1.
struct Spline {
    std::array<float, 4> weight, slope;

    explicit Spline(float f) {
        const float g = 1 - f;
        weight = {g * g * g / 6, (4 - 6 * f * f + 3 * f * f * f) / 6, (4 - 6 * g * g + 3 * g * g * g) / 6,
                  f * f * f / 6};
        slope = {-g * g / 2, (-4 * f + 3 * f * f) / 2, (4 * g - 3 * g * g) / 2, f * f / 2};
    }
};

}  // namespace

DensityPyramid::Level::Level(glm::ivec3 size, float cells)
    : nx(size.x), ny(size.y), nz(size.z), per_cell(cells) {
    density.assign(plane() * (static_cast<std::size_t>(nz) + std::size_t{2} * border), 0);
}

DensityPyramid::DensityPyramid(glm::ivec3 cells) { levels_.emplace_back(cells, 1.0F); }

void DensityPyramid::finish() {
    levels_.push_back(level_above(cells(), ShareOfDepth()));
    while (std::max({levels_.back().nx, levels_.back().ny, levels_.back().nz}) > 2)
        levels_.push_back(level_above(levels_.back(), ShareItself()));
}

dvec3 DensityPyramid::slope(dvec3 p) const {
    const Level& level = cells();
    const glm::vec3 q = glm::vec3(p) - 0.5F;
    const int x = std::clamp(whole_below(q.x), -1, level.nx - 1);
    const int y = std::clamp(whole_below(q.y), -1, level.ny - 1);
    const int z = std::clamp(whole_below(q.z), -1, level.nz - 1);
    const Spline along(q.x - static_cast<float>(x)), across(q.y - static_cast<float>(y)),
        up(q.z - static_cast<float>(z));
    const std::uint8_t* near = &level.density[level.at(x - 1, y - 1, z - 1)];
    glm::vec3 sum(0);
    for (std::size_t k = 0; k < 4; ++k, near += level.plane()) {
        const std::uint8_t* row = near;
        for (std::size_t j = 0; j < 4; ++j, row += level.row()) {
            float value = 0, change = 0;
            for (std::size_t i = 0; i < 4; ++i) {
                value += along.weight[i] * static_cast<float>(row[i]);
                change += along.slope[i] * static_cast<float>(row[i]);
            }
            sum.x += change * across.weight[j] * up.weight[k];
            sum.y += value * across.slope[j] * up.weight[k];
            sum.z += value * across.weight[j] * up.slope[k];
        }
    }
    return dvec3(sum) / 255.0;
}

float DensityPyramid::density(const Level& level, glm::vec3 p) const {
    const glm::vec3 q = p * level.per_cell - 0.5F;
    const int x = whole_below(q.x), y = whole_below(q.y), z = whole_below(q.z);
    const auto far = [](int at, int count) { return at < -1 || at >= count; };
    if (far(x, level.nx) || far(y, level.ny) || far(z, level.nz)) return 0;
    const std::uint8_t* const near = &level.density[level.at(x, y, z)];
    const std::size_t row = level.row(), plane = level.plane();
    // Most queried positions are void.
    unsigned any = 0;
    for (const std::size_t pair : {std::size_t{0}, row, plane, plane + row})
        any |= unsigned{near[pair]} | near[pair + 1];
    if (any == 0) return 0;
    const float fx = q.x - static_cast<float>(x), fy = q.y - static_cast<float>(y),
                fz = q.z - static_cast<float>(z);
    const auto along = [&](std::size_t at) {
        const auto a = static_cast<float>(near[at]), b = static_cast<float>(near[at + 1]);
        return a + (b - a) * fx;
    };
    const float low = along(0) + (along(row) - along(0)) * fy;
    const float high = along(plane) + (along(plane + row) - along(plane)) * fy;
    return (low + (high - low) * fz) / 255;
}

float DensityPyramid::cone(dvec3 start, dvec3 direction, double spread, double reach,
                           const PreviewCut& cut) const {
    constexpr float enough = 0.02F;
    float light = 1;
    const dvec3 far = size() + 1.0;
    const auto outside = [&](dvec3 p) {
        for (int k = 0; k < 3; ++k) {
            if (direction[k] >= 0 ? p[k] > far[k] : p[k] < -1) return true;
        }
        return false;
    };
    std::size_t k = 1;
    double scale = 2;  // cells, edge of a block at this level
    for (double t = 1.5; t < reach && light > enough;) {
        const double width = std::max(2.0, spread * t);
        const dvec3 p = start + direction * t;
        if (outside(p) || cut.removes(p)) break;
        while (scale * 1.5 < width && k + 1 < levels_.size()) {
            scale *= 2;
            ++k;
        }
        const double step = 0.7 * width;
        // A density d dims the light by (1 - d) to the power of the cell widths crossed.
        const auto crossed = static_cast<float>(std::min(1.0, step / scale * 1.2));
        light *= std::max(0.0F, 1 - density(level(k), glm::vec3(p)) * crossed);
        t += step;
    }
    return light;
}

}  // namespace lamella
