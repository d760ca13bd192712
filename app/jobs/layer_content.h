// What a server sends of a job's layers: pictures, runs, contours, volumes.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "app/jobs/served_job.h"
#include "app/jobs/voxel_grid.h"

namespace lamella {

/// A window of a layer's plane in square pixels.
struct LayerWindow {
    Rect rect;        ///< mm
    int width = 800;  ///< px along x
};

/// Returns a PNG of the window, first row at the largest y: white by coverage, supports in the machine's
/// grey; or, in colours, the part light and supports blue on a dark ground. Throws HttpError 400 for a window
/// of more than 2^26 pixels.
std::string layer_picture(const ServedJob& job, int layer, const LayerWindow& window, bool in_colours);

/// Returns a JSON head, its length in 4 bytes before it, and the numbers of the runs: the first run of each
/// line and one more (uint32), then begin and end of each (int32, 1/256 of a pixel); all little-endian.
std::string layer_runs(const ServedJob& job, int layer, const RowBand& band, bool of_supports);

/// Returns {"contours": [{"parent", "points": [x, y, ...]}], "area"}, mm, within `tolerance` of the surface.
nlohmann::ordered_json layer_contours(const ServedJob& job, int layer, double tolerance, bool of_supports);

/// Returns the rows of square pixels that cover a rectangle, the first at its largest y, each of `sub` lines.
RowBand page_of(const Rect& rect, double pixel, int sub);

/// Returns the rows of a plane of voxels, upward along y.
RowBand voxel_page(const VoxelGrid& grid);

/// Returns a JSON head, its length in 4 bytes before it, and the coverage of part and supports, two bytes a
/// voxel, x fastest, then y, then z. The longest side of the job's bounds has `longest` voxels.
/// Throws Interrupted when cancelled.
std::string coverage_volume(const ServedJob& job, int longest, const PassControl& control);

}  // namespace lamella
