// Estimates memory from foam statistics, plate area and look-ahead.
#include "app/reports/memory_bound.h"

#include <algorithm>
#include <cmath>

#include "app/reports/foam_statistics.h"
#include "engine/base/parallel.h"
#include "printers/registry.h"

namespace lamella {

namespace {

constexpr double beams_per_seed =
    13.54;  // edges per cell of a Poisson-Voronoi foam, each shared by three cells
constexpr double beam_length_per_cell =
    0.54;  // mean edge length over the mean cell diameter, Poisson-Voronoi
constexpr double bytes_per_beam = 2 * sizeof(Beam);  // the beam and its entry in the index of bands
// Each beam is stored in several units of the cell cache, plus seeds and blocks: measured on foams of 0.5 to
// 3 mm.
constexpr double bytes_per_seed = 4.5 * (32 + 1.5 * beams_per_seed * sizeof(Beam));
constexpr double reach_in_cells = 4;  // a unit of the cell cache and its neighbours, below and above
constexpr std::int64_t bytes_per_triangle = 12 + 8 + 72;  // corners, index, corners again by height
// Measured: more memory is held while a mesh is read and repaired, most by the reader of 3MF packages.
constexpr double held_while_read = 2.5, held_while_read_3mf = 6;
constexpr std::int64_t band_rows = 64;
constexpr std::int64_t program_bytes = 13 << 20;  // measured: the resident size of slicing a plain box
constexpr double picture_cells = 290;  // along the longest side of what is drawn for a picture of 480 px
constexpr double bytes_per_picture_cell = 1.5;  // depths, the pyramid of densities, and bits

/// Returns the memory for drawing a file's picture.
std::int64_t picture_bytes(const Recipe& recipe, dvec3 size) {
    const auto embeds_picture = find_backend(recipe.printer.backend).embeds_picture;
    if (embeds_picture == nullptr || !embeds_picture(recipe.printer)) return 0;
    const dvec3 cells = size * (picture_cells / std::max({size.x, size.y, size.z}));
    return static_cast<std::int64_t>(cells.x * cells.y * cells.z * bytes_per_picture_cell);
}

}  // namespace

MemoryBound memory_bound(const Recipe& recipe, const BuiltJob& built, int threads) {
    const int workers = thread_count(threads);
    const dvec3 size = built.job.bounds.size();
    MemoryBound bound;
    bound.layers_in_flight = std::min(2 * workers, built.job.layers.count());
    bound.base_bytes = program_bytes;
    bound.picture_bytes = picture_bytes(recipe, size);
    if (built.mesh) {
        const double kept = static_cast<double>(built.mesh->triangles * bytes_per_triangle) +
                            static_cast<double>(built.mesh->vertices * sizeof(dvec3));
        const bool is_3mf = recipe.part.mesh.ends_with(".3mf");
        bound.mesh_bytes = static_cast<std::int64_t>(kept * (is_3mf ? held_while_read_3mf : held_while_read));
    }
    if (built.foam && built.foam->beams_touching) {
        const FoamStatistics foam = foam_statistics(*built.foam, built.designed.bounds);
        const double seeds_per_mm = size.x * size.y * foam.densest_plane;  // per mm of height
        const double met = beam_length_per_cell / std::cbrt(foam.densest_plane) / 2 + 2 * foam.mean_member;
        bound.beams_per_layer = seeds_per_mm * beams_per_seed / 2 * met;
        const double reach = bound.layers_in_flight * built.designed.layers.greatest_height() +
                             reach_in_cells * foam.greatest_cell;
        bound.cell_bytes = static_cast<std::int64_t>(
            seeds_per_mm * std::min(reach, size.z + 2 * foam.greatest_cell) * bytes_per_seed);
    }
    const ImageProfile& image = recipe.printer.image;
    // A page takes one byte per sixteen pixels, as deflate achieves for dense foam; rows hold a run of 8
    // bytes for every beam met and sub-row.
    const double across = std::min<double>(image.width, size.x / image.pixel_x),
                 down = std::min<double>(image.height, size.y / image.pixel_y);
    const auto page = static_cast<std::int64_t>(across * down / 16);
    const auto rows =
        static_cast<std::int64_t>(static_cast<double>(band_rows * image.sub_rows) * across / 8 * sizeof(Run));
    bound.layer_bytes = page + rows + static_cast<std::int64_t>(bound.beams_per_layer * bytes_per_beam);
    return bound;
}

}  // namespace lamella
