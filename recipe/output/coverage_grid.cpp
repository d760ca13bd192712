// Every cell is cut by several planes, in which runs have exact ends.
#include "recipe/output/coverage_grid.h"

#include <array>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/field/slice_context.h"
#include "recipe/output/plane_depths.h"
#include "recipe/output/plane_runs.h"

namespace lamella {
namespace {

constexpr int planes_per_cell = 2;

bool has_bit(const std::uint8_t* bits, std::size_t i) { return (bits[i >> 3U] >> (i & 7U) & 1U) != 0; }
void set_bit(std::uint8_t* bits, std::size_t i) {
    bits[i >> 3U] = static_cast<std::uint8_t>(bits[i >> 3U] | 1U << (i & 7U));
}

/// The lines through the centres of all cells, in rows or in columns.
RowBand lines_of(const DensityPyramid::Level& level, dvec3 origin, double pitch, Axis axis) {
    RowBand band;
    band.axis = axis;
    band.along_origin = axis == Axis::x ? origin.x : origin.y;
    band.across_origin = axis == Axis::x ? origin.y : origin.x;
    band.along_pitch = band.across_pitch = pitch;
    band.count = axis == Axis::x ? level.ny : level.nx;
    band.hi = axis == Axis::x ? level.nx : level.ny;
    return band;
}

/// The eight cells around a cell of the dual grid, whose corners are their centres.
class DualCell {
  public:
    DualCell(const DensityPyramid::Level& level, glm::ivec3 cell) : corner_(cell) {
        const std::uint8_t* const near = &level.density[level.at(cell.x, cell.y, cell.z)];
        for (std::size_t c = 0; c < 8; ++c) {
            const std::size_t at = (c & 1U) + (c >> 1U & 1U) * level.row() + (c >> 2U) * level.plane();
            shares_[c] = near[at];
        }
    }
    /// Returns the interpolated share less the half that makes the surface: positive inside.
    double above_half(dvec3 p) const {
        const dvec3 f = p - dvec3(corner_);
        const auto along = [&](std::size_t c) { return shares_[c] + (shares_[c + 1] - shares_[c]) * f.x; };
        const double low = along(0) + (along(2) - along(0)) * f.y;
        const double high = along(4) + (along(6) - along(4)) * f.y;
        return low + (high - low) * f.z - surface_depth;
    }

  private:
    glm::ivec3 corner_;
    std::array<double, 8> shares_{};
};

/// Returns where the share rises above one half between a point outside and one inside.
double crossing(const DualCell& cell, const BrickMap::Ray& ray, double outside, double v_outside,
                double inside, double v_inside) {
    for (int i = 0; i < 2; ++i) {
        const double t =
            outside + (inside - outside) * std::clamp(v_outside / (v_outside - v_inside), 0.1, 0.9);
        const double v = cell.above_half(ray.at(t));
        (v > 0 ? inside : outside) = t;
        (v > 0 ? v_inside : v_outside) = v;
    }
    return outside + (inside - outside) * std::clamp(v_outside / (v_outside - v_inside), 0.0, 1.0);
}

std::optional<double> entry(const DualCell& cell, const BrickMap::Ray& ray, const Interval& inside) {
    double before = inside.lo, v_before = cell.above_half(ray.at(before));
    if (v_before > 0) return before;
    for (const double t : {(inside.lo + inside.hi) / 2, inside.hi}) {
        const double v = cell.above_half(ray.at(t));
        if (v > 0) return crossing(cell, ray, before, v_before, t, v);
        before = t;
        v_before = v;
    }
    return std::nullopt;
}

}  // namespace

/// Buffers of a thread, and the sums over the planes of a layer of cells.
struct CoverageGrid::LayerWork {
    PlaneDepths depths;
    PlaneRuns in_rows, in_columns;
    std::vector<std::uint16_t> sums;
    std::vector<std::uint8_t> deepest;

    explicit LayerWork(const DensityPyramid::Level& level)
        : depths(level.nx, level.ny),
          sums(static_cast<std::size_t>(level.nx) * static_cast<std::size_t>(level.ny)),
          deepest(sums.size()) {}
    void begin() {
        std::fill(sums.begin(), sums.end(), std::uint16_t{0});
        std::fill(deepest.begin(), deepest.end(), std::uint8_t{0});
    }
    void add_plane() {
        const std::vector<std::uint8_t>& plane = depths.depths();
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] = static_cast<std::uint16_t>(sums[i] + plane[i]);
            deepest[i] = std::max(deepest[i], plane[i]);
        }
    }
};

glm::ivec3 CoverageGrid::cells_within(const Box& bounds, int cells, double most) {
    const dvec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    const double volume = std::max(size.x * size.y * size.z / (longest * longest * longest), 1e-6);
    const int fitting = static_cast<int>(std::cbrt(most / volume));
    // The part is surrounded by one empty cell, so that a surface on the bounds is entered from outside.
    pitch_ = longest / std::max(std::min(cells, fitting) - 2, 1);
    origin_ = bounds.lo - pitch_;
    const auto count = [&](double length) { return static_cast<int>(std::ceil(length / pitch_ - 1e-9)) + 2; };
    return {count(size.x), count(size.y), count(size.z)};
}

CoverageGrid::CoverageGrid(const TwoSolids& solids, const Box& bounds, int cells, double most,
                           const CancelToken* cancel)
    : densities_(cells_within(bounds, cells, most)),
      near_({densities_.cells().nx, densities_.cells().ny, densities_.cells().nz}) {
    const DensityPyramid::Level& level = densities_.cells();
    if (solids.second) part_.assign(row_of_bits(0, level.nz), 0);
    thin_.assign(row_of_bits(0, level.nz), 0);
    const int slabs = (level.nz + BrickMap::slab - 1) / BrickMap::slab;
    parallel_for(slabs, [&](int slab) {
        LayerWork work(level);
        const int first = slab * BrickMap::slab;
        for (int z = first; z < std::min(first + BrickMap::slab, level.nz); ++z)
            fill_layer(solids, bounds, z, work, cancel);
    });
    parallel_for(level.nz, [&](int z) { restore_thin(z); });
    thin_ = {};
    stop_if_cancelled(cancel);
    densities_.finish();
    mark_surface();
}

void CoverageGrid::fill_layer(const TwoSolids& solids, const Box& bounds, int z, LayerWork& work,
                              const CancelToken* cancel) {
    const DensityPyramid::Level& level = densities_.cells();
    const auto lines_through = [&](Axis axis) { return lines_of(level, origin_, pitch_, axis); };
    const RowBand rows = lines_through(Axis::x);
    const RowBand columns = lines_through(Axis::y);
    work.begin();
    for (int k = 0; k < planes_per_cell; ++k) {
        stop_if_cancelled(cancel);
        const double height = origin_.z + (z + (k + 0.5) / planes_per_cell) * pitch_;
        if (height < bounds.lo.z || height > bounds.hi.z) continue;
        SliceContext context;
        work.in_rows.cut(solids, context, height, rows, bounds.rect());
        work.in_columns.cut(solids, context, height, columns, bounds.rect());
        work.depths.set(work.in_rows.all(), work.in_columns.all());
        work.add_plane();
        if (solids.second) mark_part(work.in_rows.part(), z);
    }
    store_layer(work, z);
}

void CoverageGrid::store_layer(const LayerWork& work, int z) {
    DensityPyramid::Level& level = densities_.cells();
    const auto nx = static_cast<std::size_t>(level.nx);
    for (int y = 0; y < level.ny; ++y) {
        const std::size_t from = static_cast<std::size_t>(y) * nx;
        std::uint8_t* const out = &level.density[level.at(0, y, z)];
        for (std::size_t x = 0; x < nx; ++x)
            out[x] = static_cast<std::uint8_t>(work.sums[from + x] / planes_per_cell);
        std::uint8_t* const bits = &thin_[row_of_bits(y, z)];
        for (std::size_t x = 0; x < nx; ++x) {
            if (out[x] <= surface_depth && work.deepest[from + x] > surface_depth) set_bit(bits, x);
        }
    }
}

/// What only a plane of a cell meets is lost in the mean; where the cells above and below are void as well,
/// it is thin, and shown.
void CoverageGrid::restore_thin(int z) {
    constexpr std::uint8_t shown = surface_depth + depth_unit / 2;
    DensityPyramid::Level& level = densities_.cells();
    const auto is_void = [&](std::size_t x, int y, int layer) {
        if (layer < 0 || layer >= level.nz) return true;
        // Another thread may be restoring that cell: its bit tells.
        if (has_bit(&thin_[row_of_bits(y, layer)], x)) return true;
        return level.density[level.at(static_cast<int>(x), y, layer)] <= surface_depth;
    };
    for (int y = 0; y < level.ny; ++y) {
        const std::uint8_t* const bits = &thin_[row_of_bits(y, z)];
        for (std::size_t byte = 0; byte < bytes_of_row(); ++byte) {
            if (bits[byte] == 0) continue;
            for (std::size_t x = 8 * byte; x < 8 * byte + 8; ++x) {
                if (has_bit(bits, x) && is_void(x, y, z - 1) && is_void(x, y, z + 1))
                    level.density[level.at(static_cast<int>(x), y, z)] = shown;
            }
        }
    }
}

/// Marks the cells whose centre, or nearest line, the part covers.
void CoverageGrid::mark_part(const RunRows& rows, int z) {
    const DensityPyramid::Level& level = densities_.cells();
    for (int y = 0; y < level.ny; ++y) {
        std::uint8_t* const bits = &part_[row_of_bits(y, z)];
        for (const Run& run : rows.line(static_cast<std::size_t>(y))) {
            for (int x = run.begin / run_unit; x < (run.end + run_unit - 1) / run_unit; ++x)
                set_bit(bits, static_cast<std::size_t>(x));
        }
    }
}

/// Marks the cells of the dual grid with a corner inside the solid: no others can hold the surface.
void CoverageGrid::mark_surface() {
    const DensityPyramid::Level& level = densities_.cells();
    const int slabs = (level.nz + BrickMap::slab - 1) / BrickMap::slab;
    parallel_for(slabs, [&](int slab) {
        std::vector<std::uint8_t> greatest(static_cast<std::size_t>(level.nx) + 1);
        for (int z = slab * BrickMap::slab; z < std::min((slab + 1) * BrickMap::slab, level.nz); ++z) {
            for (int y = 0; y < level.ny; ++y) {
                const std::uint8_t* const near = &level.density[level.at(0, y, z)];
                const std::size_t row = level.row(), plane = level.plane();
                for (std::size_t x = 0; x < greatest.size(); ++x) {
                    greatest[x] = std::max(std::max(near[x], near[x + row]),
                                           std::max(near[x + plane], near[x + plane + row]));
                }
                for (int x = 0; x < level.nx; ++x) {
                    const auto i = static_cast<std::size_t>(x);
                    if (std::max(greatest[i], greatest[i + 1]) >= surface_depth) near_.insert(x, y, z);
                }
            }
        }
    });
    near_.finish();
}

std::vector<dvec3> CoverageGrid::solid_places() const {
    const DensityPyramid::Level& blocks = densities_.level(3);
    const double edge = 1 / static_cast<double>(blocks.per_cell);
    std::vector<dvec3> places;
    for (int z = 0; z < blocks.nz; ++z) {
        for (int y = 0; y < blocks.ny; ++y) {
            for (int x = 0; x < blocks.nx; ++x) {
                if (blocks.density[blocks.at(x, y, z)] > 0)
                    places.push_back(to_part((dvec3(x, y, z) + 0.5) * edge));
            }
        }
    }
    return places;
}

std::optional<double> CoverageGrid::surface(const BrickMap::Ray& ray, double from, double to) const {
    BrickMap::Ray dual = ray;  // corners of the dual grid are centres of cells
    dual.start -= 0.5;
    while (const auto found = near_.next(dual, from, to)) {
        if (const auto t = entry(DualCell(densities_.cells(), found->cell), dual, found->inside)) return t;
        from = found->inside.hi;
    }
    return std::nullopt;
}

std::size_t CoverageGrid::row_of_bits(int y, int z) const {
    const DensityPyramid::Level& level = densities_.cells();
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(level.ny) + static_cast<std::size_t>(y)) *
           bytes_of_row();
}

bool CoverageGrid::of_second(dvec3 p) const {
    if (part_.empty()) return false;
    const DensityPyramid::Level& level = densities_.cells();
    const dvec3 q = p - 0.5;
    const glm::ivec3 low(glm::floor(q));
    double balance = 0;
    for (int c = 0; c < 8; ++c) {
        const glm::ivec3 cell = low + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
        if (cell.x < 0 || cell.y < 0 || cell.z < 0 || cell.x >= level.nx || cell.y >= level.ny ||
            cell.z >= level.nz)
            continue;
        if (level.density[level.at(cell.x, cell.y, cell.z)] <= surface_depth) continue;
        const dvec3 near = 1.0 - glm::abs(q - dvec3(cell));
        const bool of_part = has_bit(&part_[row_of_bits(cell.y, cell.z)], static_cast<std::size_t>(cell.x));
        const double weight = near.x * near.y * near.z;
        balance += of_part ? -weight : weight;
    }
    return balance > 0;
}

}  // namespace lamella
