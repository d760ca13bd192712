// Building the grid from slices, walking rays through it, and cone tracing (Crassin et al. 2011) for soft
// light.
#include "recipe/voxel_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/slice_context.h"

namespace lamella {

namespace {

constexpr int skip_level = 2;  // empty blocks of 8 cells are crossed in one step

/// Where the ray leaves the block of this edge that holds p.
double leaving(dvec3 p, dvec3 start, dvec3 direction, double edge) {
    double exit = infinity;
    for (int k = 0; k < 3; ++k) {
        if (direction[k] == 0) continue;
        const double low = std::floor(p[k] / edge) * edge;
        const double wall = direction[k] > 0 ? low + edge : low;
        exit = std::min(exit, (wall - start[k]) / direction[k]);
    }
    return exit;
}

}  // namespace

VoxelGrid::VoxelGrid(const Field& part, const Box& bounds, int cells, Mark mark) {
    const dvec3 size = bounds.size();
    // One empty cell stands round the part, so that a surface on the bounds is entered from outside.
    pitch_ = std::max({size.x, size.y, size.z}) / std::max(cells - 2, 1);
    origin_ = bounds.lo - pitch_;
    const auto count = [&](double length) { return static_cast<int>(std::ceil(length / pitch_ - 1e-9)) + 2; };
    nx_ = count(size.x);
    ny_ = count(size.y);
    nz_ = count(size.z);
    words_ = static_cast<std::size_t>(nx_ + 63) / 64;
    bits_.assign(words_ * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(nz_), 0);
    tbb::parallel_for(0, nz_, [&](int z) { mark_plane(part, bounds, z, mark); });
    build_pyramid();
}

void VoxelGrid::mark_plane(const Field& part, const Box& bounds, int z, Mark mark) {
    RowBand band;
    band.along_origin = origin_.x;
    band.along_pitch = pitch_;
    band.across_origin = origin_.y;
    band.across_pitch = pitch_;
    band.count = ny_;
    const int samples = mark == Mark::touched ? 2 : 1;  // planes of a cell, and lines of a plane in it
    band.sub = samples;
    band.hi = nx_;
    // Beyond the bounds nothing is marked, even if the part goes on there: that is how it is cut away.
    const std::int32_t low = round_run(band.coordinate(bounds.lo.x));
    const std::int32_t high = round_run(band.coordinate(bounds.hi.x));
    const std::int32_t begin_shift = mark == Mark::touched ? 0 : run_unit / 2;
    const std::int32_t end_shift = mark == Mark::touched ? run_unit - 1 : run_unit / 2;
    Scratch scratch;
    SpanRows rows;
    for (int k = 0; k < samples; ++k) {
        const double height = origin_.z + (z + (k + 0.5) / samples) * pitch_;
        if (height < bounds.lo.z || height > bounds.hi.z) continue;
        SliceContext context;
        rows.clear();
        context.slice(part, height).spans(band, scratch, rows);
        for (std::size_t line = 0; line < rows.lines(); ++line) {
            const double y = band.line(static_cast<int>(line));
            if (y < bounds.lo.y || y > bounds.hi.y) continue;
            const std::size_t row = static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) +
                                    line / static_cast<std::size_t>(samples);
            for (const Run& run : rows.line(line)) {
                const std::int32_t begin = std::max(run.begin, low), end = std::min(run.end, high);
                const int last = (end + end_shift) / run_unit;
                for (int x = (begin + begin_shift) / run_unit; x < last; ++x) {
                    bits_[row * words_ + static_cast<std::size_t>(x >> 6)] |= std::uint64_t{1} << (x & 63);
                }
            }
        }
    }
}

void VoxelGrid::build_pyramid() {
    int nx = nx_, ny = ny_, nz = nz_;
    while (levels_.empty() || std::max({nx, ny, nz}) > 2) {
        Level level{(nx + 1) / 2, (ny + 1) / 2, (nz + 1) / 2, {}};
        level.density.resize(static_cast<std::size_t>(level.nx) * static_cast<std::size_t>(level.ny) *
                             static_cast<std::size_t>(level.nz));
        const Level* below = levels_.empty() ? nullptr : &levels_.back();
        const auto child = [&](int x, int y, int z) -> unsigned {
            if (x >= nx || y >= ny || z >= nz) return 0;
            if (!below) return solid(x, y, z) ? 255 : 0;
            return below->density[(static_cast<std::size_t>(z) * static_cast<std::size_t>(ny) +
                                   static_cast<std::size_t>(y)) *
                                      static_cast<std::size_t>(nx) +
                                  static_cast<std::size_t>(x)];
        };
        tbb::parallel_for(0, level.nz, [&](int z) {
            std::size_t at = static_cast<std::size_t>(z) * static_cast<std::size_t>(level.ny) *
                             static_cast<std::size_t>(level.nx);
            for (int y = 0; y < level.ny; ++y) {
                for (int x = 0; x < level.nx; ++x) {
                    unsigned sum = 7;  // rounds up: only truly empty blocks are 0
                    for (int c = 0; c < 8; ++c)
                        sum += child(2 * x + (c & 1), 2 * y + (c >> 1 & 1), 2 * z + (c >> 2));
                    level.density[at++] = static_cast<std::uint8_t>(sum / 8);
                }
            }
        });
        nx = level.nx;
        ny = level.ny;
        nz = level.nz;
        levels_.push_back(std::move(level));
    }
}

std::vector<dvec3> VoxelGrid::solid_places() const {
    const std::size_t depth = std::min<std::size_t>(2, levels_.size() - 1);
    const Level& level = levels_[depth];
    const double edge = static_cast<double>(std::size_t{2} << depth);
    std::vector<dvec3> places;
    std::size_t cell = 0;
    for (int z = 0; z < level.nz; ++z) {
        for (int y = 0; y < level.ny; ++y) {
            for (int x = 0; x < level.nx; ++x, ++cell) {
                if (level.density[cell] > 0) places.push_back(to_part((dvec3(x, y, z) + 0.5) * edge));
            }
        }
    }
    return places;
}

std::optional<Interval> VoxelGrid::next_solid(dvec3 start, dvec3 direction, double from, double to) const {
    constexpr double nudge = 1e-4;  // cells; carries the walk over a wall in spite of rounding
    const std::size_t skip = std::min<std::size_t>(skip_level, levels_.size() - 1);
    const Level& blocks = levels_[skip];
    const double edge = static_cast<double>(2 << skip);
    for (double t = from; t < to;) {
        const dvec3 p = start + direction * (t + nudge);
        const int x = static_cast<int>(std::floor(p.x));
        const int y = static_cast<int>(std::floor(p.y));
        const int z = static_cast<int>(std::floor(p.z));
        if (x < 0 || y < 0 || z < 0 || x >= nx_ || y >= ny_ || z >= nz_) {
            t = std::max(t + nudge, leaving(p, start, direction, 1));
            continue;
        }
        const std::size_t block =
            (static_cast<std::size_t>(z >> (skip + 1)) * static_cast<std::size_t>(blocks.ny) +
             static_cast<std::size_t>(y >> (skip + 1))) *
                static_cast<std::size_t>(blocks.nx) +
            static_cast<std::size_t>(x >> (skip + 1));
        const bool block_empty = blocks.density[block] == 0;
        const double exit = std::max(t + nudge, leaving(p, start, direction, block_empty ? edge : 1));
        if (!block_empty && solid(x, y, z)) return Interval{t, std::min(exit, to)};
        t = exit;
    }
    return std::nullopt;
}

bool VoxelGrid::solid_at(dvec3 p) const {
    const dvec3 cell = glm::floor(p);
    if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= nx_ || cell.y >= ny_ || cell.z >= nz_)
        return false;
    return solid(static_cast<int>(cell.x), static_cast<int>(cell.y), static_cast<int>(cell.z));
}

dvec3 VoxelGrid::slope(dvec3 p) const {
    constexpr double step = 2;  // cells, as wide as the finest densities: nearer, steps of the grid show
    dvec3 slope(0);
    for (int k = 0; k < 3; ++k) {
        dvec3 aside(0);
        aside[k] = step;
        slope[k] =
            (density(levels_.front(), 2, p + aside) - density(levels_.front(), 2, p - aside)) / (2 * step);
    }
    return slope;
}

double VoxelGrid::density(const Level& level, double scale, dvec3 p) const {
    const dvec3 q = p / scale - 0.5;
    const dvec3 base = glm::floor(q);
    const dvec3 f = q - base;
    const int x0 = static_cast<int>(base.x), y0 = static_cast<int>(base.y), z0 = static_cast<int>(base.z);
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
        const int dx = c & 1, dy = c >> 1 & 1, dz = c >> 2;
        const int x = x0 + dx, y = y0 + dy, z = z0 + dz;
        if (x < 0 || y < 0 || z < 0 || x >= level.nx || y >= level.ny || z >= level.nz) continue;
        const std::size_t at =
            (static_cast<std::size_t>(z) * static_cast<std::size_t>(level.ny) + static_cast<std::size_t>(y)) *
                static_cast<std::size_t>(level.nx) +
            static_cast<std::size_t>(x);
        sum += (dx ? f.x : 1 - f.x) * (dy ? f.y : 1 - f.y) * (dz ? f.z : 1 - f.z) * level.density[at];
    }
    return sum / 255;
}

double VoxelGrid::cone(dvec3 start, dvec3 direction, double spread, double reach) const {
    constexpr double enough = 0.02;
    double light = 1;
    const dvec3 far = size() + 1.0;
    for (double t = 1.5; t < reach && light > enough;) {
        const double width = std::max(2.0, spread * t);
        const dvec3 p = start + direction * t;
        if ((p.z > far.z && direction.z >= 0) || (p.x > far.x && direction.x >= 0) ||
            (p.y > far.y && direction.y >= 0) || (p.x < -1 && direction.x <= 0) ||
            (p.y < -1 && direction.y <= 0) || (p.z < -1 && direction.z <= 0)) {
            break;
        }
        std::size_t k = 0;
        double scale = 2;
        while (scale * 1.5 < width && k + 1 < levels_.size()) {
            scale *= 2;
            ++k;
        }
        const double step = 0.5 * width;
        // A stretch of density d per cell's width dims the light by (1 - d) to the number of widths crossed.
        light *= std::max(0.0, 1 - density(levels_[k], scale, p) * std::min(1.0, step / scale * 1.2));
        t += step;
    }
    return light;
}

}  // namespace lamella
