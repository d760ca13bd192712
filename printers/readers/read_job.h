// JobFile: reads back finished jobs of resin printers: archives, files and folders of layer masks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/layers/layer_plan.h"

namespace lamella {

/// Metadata stated by a job's file; a value that is not stated is empty.
struct JobFacts {
    std::string format;   ///< such as "SL1 archive"
    std::string name;     ///< name of the job
    std::string machine;  ///< model that the job is made for
    std::string material;
    std::string program;                   ///< program that made the job
    int layers = 0;                        ///< number of masks
    int width = 0;                         ///< width of a mask, px
    int height = 0;                        ///< height of a mask, px
    std::optional<double> pixel_x;         ///< distance between columns of a mask, mm
    std::optional<double> pixel_y;         ///< distance between rows of a mask, mm
    std::optional<double> layer_height;    ///< mm
    LayerPlan heights;                     ///< of layers that differ, instead of layer_height; else no layers
    std::optional<double> exposure;        ///< exposure of a layer, s
    std::optional<double> first_exposure;  ///< exposure of the first layers, s
    std::optional<int> first_layers;       ///< number of first layers
    std::optional<int> fade_layers;        ///< number of layers over which the exposure then falls
    std::optional<double> print_time;      ///< s
    std::optional<double> volume;          ///< mm^3
    std::vector<std::string> notes;        ///< peculiarities, one sentence each
};

/// Mask of a layer: grey values, 255 = cured, row by row from the top.
struct MaskImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// Largest mask that is read, px: more than twice the largest display.
inline constexpr std::int64_t max_mask_pixels = std::int64_t{1} << 28;

/// An open job. Masks are decoded one at a time, on request.
class JobFile {
  public:
    virtual ~JobFile() = default;
    const JobFacts& facts() const { return facts_; }
    int layers() const { return facts_.layers; }
    /// Returns the mask of a layer, 0 <= index < layers(), of the size in facts(). Thread-safe. Throws
    /// InputError with file and layer if the mask is missing, damaged or of another size.
    virtual MaskImage layer(int index) const = 0;

  protected:
    JobFacts facts_;
};

/// Returns the endings of file names that promise a job, with their dots.
std::vector<std::string> job_endings();

/// Opens `path` if its content is a job: an SL1 archive, a GOO file, a NanoDLP archive, an Ember archive, or
/// a folder of masks with a job.json. Returns null for anything that may be something else, such as a model
/// or a recipe. Throws InputError with the file and the fault for a damaged job, and for a file that is named
/// like a job but is not one.
std::unique_ptr<JobFile> open_if_job(const std::string& path);

/// Opens a job like open_if_job, but throws InputError instead of returning null.
std::unique_ptr<JobFile> open_job(const std::string& path);

}  // namespace lamella
