// Builds the grid from slices, traverses it by rays, and traces cones (Crassin et al. 2011) for ambient
// light.
#include "recipe/output/voxel_grid.h"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"

namespace lamella {

namespace {

/// Returns the largest integer not above v. Positions in the grid are small; std::floor is a function call on
/// old processors.
int whole_below(double v) {
    const int towards_zero = static_cast<int>(v);
    return towards_zero - (v < towards_zero ? 1 : 0);
}

/// Rounded up: only truly empty blocks are 0.
std::uint8_t mean_of_eight(unsigned sum) { return static_cast<std::uint8_t>((sum + 7) / 8); }

/// Returns where the ray leaves the block around a cell; blocks are 2^`doublings` cells wide.
double leaving(glm::ivec3 cell, int doublings, dvec3 start, dvec3 direction) {
    double exit = infinity;
    for (int k = 0; k < 3; ++k) {
        if (direction[k] == 0) continue;
        const int low = cell[k] >> doublings << doublings;
        const int wall = direction[k] > 0 ? low + (1 << doublings) : low;
        exit = std::min(exit, (wall - start[k]) / direction[k]);
    }
    return exit;
}

}  // namespace

VoxelGrid::VoxelGrid(const Field& part, const Box& bounds, int cells, Mark mark) {
    const dvec3 size = bounds.size();
    // The part is surrounded by one empty cell, so that a surface on the bounds is entered from outside.
    pitch_ = std::max({size.x, size.y, size.z}) / std::max(cells - 2, 1);
    origin_ = bounds.lo - pitch_;
    const auto count = [&](double length) { return static_cast<int>(std::ceil(length / pitch_ - 1e-9)) + 2; };
    nx_ = count(size.x);
    ny_ = count(size.y);
    nz_ = count(size.z);
    words_ = static_cast<std::size_t>(nx_ + 63) / 64;
    bits_.assign(words_ * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(nz_), 0);
    parallel_for(nz_, [&](int z) { mark_plane(part, bounds, z, mark); });
    build_pyramid();
}

void VoxelGrid::mark_plane(const Field& part, const Box& bounds, int z, Mark mark) {
    RowBand band;
    band.along_origin = origin_.x;
    band.along_pitch = pitch_;
    band.across_origin = origin_.y;
    band.across_pitch = pitch_;
    band.count = ny_;
    const int samples = mark == Mark::touched ? 2 : 1;  // planes per cell, and lines per plane of a cell
    band.sub = samples;
    band.hi = nx_;
    // Nothing is marked outside the bounds, even if the part continues there: this is how it is cut away.
    const std::int32_t low = round_run(band.coordinate(bounds.lo.x));
    const std::int32_t high = round_run(band.coordinate(bounds.hi.x));
    const std::int32_t begin_shift = mark == Mark::touched ? 0 : run_unit / 2;
    const std::int32_t end_shift = mark == Mark::touched ? run_unit - 1 : run_unit / 2;
    Scratch scratch;
    RunRows rows;
    for (int k = 0; k < samples; ++k) {
        const double height = origin_.z + (z + (k + 0.5) / samples) * pitch_;
        if (height < bounds.lo.z || height > bounds.hi.z) continue;
        SliceContext context;
        rows.clear();
        context.slice(part, height).runs(band, scratch, rows);
        for (std::size_t line = 0; line < rows.lines(); ++line) {
            const double y = band.line(static_cast<int>(line));
            if (y < bounds.lo.y || y > bounds.hi.y) continue;
            std::uint64_t* const cells = &bits_[row(static_cast<int>(line) / samples, z)];
            for (const Run& run : rows.line(line)) {
                const std::int32_t begin = std::max(run.begin, low), end = std::min(run.end, high);
                const int last = (end + end_shift) / run_unit;
                for (int x = (begin + begin_shift) / run_unit; x < last; ++x) {
                    cells[x >> 6] |= std::uint64_t{1} << (x & 63);
                }
            }
        }
    }
}

void VoxelGrid::build_pyramid() {
    levels_.push_back(first_level());
    while (std::max({levels_.back().nx, levels_.back().ny, levels_.back().nz}) > 2)
        levels_.push_back(level_above(levels_.back()));
}

VoxelGrid::Level VoxelGrid::first_level() const {
    Level level((nx_ + 1) / 2, (ny_ + 1) / 2, (nz_ + 1) / 2, 0.5);
    const std::vector<std::uint64_t> beyond(words_, 0);
    const auto words = [&](int y, int z) { return y < ny_ && z < nz_ ? &bits_[row(y, z)] : beyond.data(); };
    parallel_for(level.nz, [&](int z) {
        for (int y = 0; y < level.ny; ++y) {
            const std::uint64_t* const rows[4] = {words(2 * y, 2 * z), words(2 * y + 1, 2 * z),
                                                  words(2 * y, 2 * z + 1), words(2 * y + 1, 2 * z + 1)};
            std::uint8_t* const out = &level.density[level.at(0, y, z)];
            for (std::size_t w = 0; w < words_; ++w) {
                if ((rows[0][w] | rows[1][w] | rows[2][w] | rows[3][w]) == 0) continue;
                for (std::size_t x = 32 * w; x < std::min(32 * (w + 1), static_cast<std::size_t>(level.nx));
                     ++x) {
                    unsigned full = 0;
                    for (const std::uint64_t* bits : rows) {
                        const std::uint64_t pair = bits[w] >> (2 * x & 63);
                        full += static_cast<unsigned>((pair & 1) + (pair >> 1 & 1));
                    }
                    out[x] = mean_of_eight(255 * full);
                }
            }
        }
    });
    return level;
}

VoxelGrid::Level VoxelGrid::level_above(const Level& below) {
    Level level((below.nx + 1) / 2, (below.ny + 1) / 2, (below.nz + 1) / 2, below.per_cell / 2);
    parallel_for(level.nz, [&](int z) {
        for (int y = 0; y < level.ny; ++y) {
            for (int x = 0; x < level.nx; ++x) {
                unsigned sum = 0;
                for (int c = 0; c < 8; ++c)
                    sum += below.density[below.at(2 * x + (c & 1), 2 * y + (c >> 1 & 1), 2 * z + (c >> 2))];
                level.density[level.at(x, y, z)] = mean_of_eight(sum);
            }
        }
    });
    return level;
}

std::vector<dvec3> VoxelGrid::solid_places() const {
    const std::size_t depth = std::min<std::size_t>(2, levels_.size() - 1);
    const Level& level = levels_[depth];
    const double edge = static_cast<double>(std::size_t{2} << depth);
    std::vector<dvec3> places;
    for (int z = 0; z < level.nz; ++z) {
        for (int y = 0; y < level.ny; ++y) {
            for (int x = 0; x < level.nx; ++x) {
                if (level.density[level.at(x, y, z)] > 0)
                    places.push_back(to_part((dvec3(x, y, z) + 0.5) * edge));
            }
        }
    }
    return places;
}

std::optional<Interval> VoxelGrid::next_solid(dvec3 start, dvec3 direction, double from, double to) const {
    constexpr double nudge = 1e-4;  // cells; carries the ray past a cell wall despite rounding
    for (double t = from; t < to;) {
        const dvec3 p = start + direction * (t + nudge);
        const glm::ivec3 cell(whole_below(p.x), whole_below(p.y), whole_below(p.z));
        if (!holds(cell)) {
            t = std::max(t + nudge, leaving(cell, 0, start, direction));
            continue;
        }
        const int empty = empty_doublings(cell);
        const double exit = std::max(t + nudge, leaving(cell, empty, start, direction));
        if (empty == 0 && solid(cell.x, cell.y, cell.z)) return Interval{t, std::min(exit, to)};
        t = exit;
    }
    return std::nullopt;
}

/// The doublings of the largest empty block around a cell, which is crossed in one step; see `leaving`.
int VoxelGrid::empty_doublings(glm::ivec3 cell) const {
    for (const int doublings : {5, 3}) {
        const auto k = static_cast<std::size_t>(doublings - 1);
        if (k >= levels_.size()) continue;
        const Level& blocks = levels_[k];
        if (blocks.density[blocks.at(cell.x >> doublings, cell.y >> doublings, cell.z >> doublings)] == 0)
            return doublings;
    }
    return 0;
}

bool VoxelGrid::solid_at(dvec3 p) const {
    const glm::ivec3 cell(whole_below(p.x), whole_below(p.y), whole_below(p.z));
    return holds(cell) && solid(cell.x, cell.y, cell.z);
}

dvec3 VoxelGrid::slope(dvec3 p) const {
    constexpr double step = 2;  // cells, the width of the finest densities; closer, the grid's steps would
                                // show
    dvec3 slope(0);
    for (int k = 0; k < 3; ++k) {
        dvec3 aside(0);
        aside[k] = step;
        slope[k] = (density(0, p + aside) - density(0, p - aside)) / (2 * step);
    }
    return slope;
}

double VoxelGrid::density(std::size_t k, dvec3 p) const {
    const Level& level = levels_[k];
    const dvec3 q = p * level.per_cell - 0.5;
    const int x = whole_below(q.x), y = whole_below(q.y), z = whole_below(q.z);
    const auto far = [](int at, int count) { return at < -1 || at >= count; };
    if (far(x, level.nx) || far(y, level.ny) || far(z, level.nz)) return 0;
    const std::uint8_t* const near = &level.density[level.at(x, y, z)];
    const std::size_t row = level.row(), plane = level.plane();
    // Most queried positions are void.
    unsigned any = 0;
    for (const std::size_t pair : {std::size_t{0}, row, plane, plane + row})
        any |= near[pair] | near[pair + 1U];
    if (any == 0) return 0;
    const dvec3 f = q - dvec3(x, y, z);
    const double along[2] = {1 - f.x, f.x}, across[2] = {1 - f.y, f.y}, up[2] = {1 - f.z, f.z};
    double sum = 0;
    for (std::size_t z_side = 0; z_side < 2; ++z_side) {
        for (std::size_t y_side = 0; y_side < 2; ++y_side) {
            const std::uint8_t* const pair = near + z_side * plane + y_side * row;
            for (std::size_t x_side = 0; x_side < 2; ++x_side)
                sum += along[x_side] * across[y_side] * up[z_side] * pair[x_side];
        }
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
        // A density d dims the light by (1 - d) to the power of the cell widths crossed.
        light *= std::max(0.0, 1 - density(k, p) * std::min(1.0, step / scale * 1.2));
        t += step;
    }
    return light;
}

}  // namespace lamella
