// Reading back what resin printers take: archives, files and folders of layer masks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lamella {

/// What a job's file says of itself; what it does not say is empty.
struct JobFacts {
    std::string format;   ///< "SL1 archive"
    std::string name;     ///< of the job
    std::string machine;  ///< that it is for
    std::string material;
    std::string program;                   ///< that made it
    int layers = 0;                        ///< masks
    int width = 0;                         ///< of a mask, px
    int height = 0;                        ///< px
    std::optional<double> pixel_x;         ///< pitch of a mask's columns, mm
    std::optional<double> pixel_y;         ///< of its rows, mm
    std::optional<double> layer_height;    ///< mm
    std::optional<double> exposure;        ///< of a layer, s
    std::optional<double> first_exposure;  ///< of the first layers, s
    std::optional<int> first_layers;       ///< how many those are
    std::optional<int> fade_layers;        ///< over which the one becomes the other
    std::optional<double> print_time;      ///< s
    std::optional<double> volume;          ///< mm^3
    std::vector<std::string> notes;        ///< what is odd, a sentence each
};

/// A layer's mask: greys, 255 = cured, row by row from the top.
struct MaskImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels;
};

/// The largest mask that is read, px: more than twice the largest display.
inline constexpr std::int64_t max_mask_pixels = std::int64_t{1} << 28;

/// An open job. Masks are decoded one at a time, when they are asked for.
class JobFile {
  public:
    virtual ~JobFile() = default;
    const JobFacts& facts() const { return facts_; }
    int layers() const { return facts_.layers; }
    /// The mask of a layer, 0 <= index < layers(), of the size that facts() tells. Thread-safe. Throws
    /// InputError, naming file and layer, when it is missing, damaged or of another size.
    virtual MaskImage layer(int index) const = 0;

  protected:
    JobFacts facts_;
};

/// Opens what lies at `path` when its content is a job: an SL1 archive, a GOO file, a NanoDLP archive, an
/// Ember archive, or a folder of masks with a job.json. Null for what may be something else, such as a model
/// or a recipe. Throws InputError, naming the file and what is wrong, for a job that is damaged and for what
/// is named like one but is none.
std::unique_ptr<JobFile> open_if_job(const std::string& path);

/// The same, but what is no job is an InputError.
std::unique_ptr<JobFile> open_job(const std::string& path);

}  // namespace lamella
