// Folders of masks with a job.json that describes them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "printers/readers/job_number.h"
#include "printers/readers/job_readers.h"
#include "printers/readers/mask_decoder.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::uintmax_t max_description_bytes = std::uintmax_t{1} << 26U,
                         max_mask_bytes = std::uintmax_t{1} << 30U;  // bytes

/// Returns the plan of layers that differ, as [count, height] for each run of equal ones; no layers for
/// others.
LayerPlan heights_of(const Json& job) {
    if (!job.contains("layer_height") || !job["layer_height"].is_array()) return {};
    constexpr double highest = 1000, most_layers = 10'000'000;
    std::vector<EqualLayers> runs;
    double layers = 0;
    for (const Json& run : job["layer_height"]) {
        if (!run.is_array() || run.size() != 2 || !run[0].is_number_unsigned() || !run[1].is_number())
            return {};
        const double count = run[0].get<double>(), height = run[1].get<double>();
        layers += count;
        if (!(height > 0 && height < highest) || layers > most_layers) return {};
        runs.push_back({static_cast<int>(count), height});
    }
    return LayerPlan(runs);
}

std::string read_bounded(const fs::path& path, std::uintmax_t most, const std::string& where) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) throw InputError(where + ": cannot be read (" + error.message() + ")");
    if (size > most)
        throw InputError(fmt::format("{}: {} bytes are more than any such file has", where, size));
    std::string bytes(static_cast<std::size_t>(size), '\0');
    std::ifstream in(path, std::ios::binary);
    if (!in.read(bytes.data(), static_cast<std::streamsize>(size)))
        throw InputError(where + ": cannot be read");
    return bytes;
}

class PngStackFile : public JobFile {
  public:
    explicit PngStackFile(const std::string& path) : path_(path) {
        const fs::path description = path_ / "job.json";
        std::error_code error;
        if (!fs::exists(description, error)) {
            throw InputError(path +
                             ": this folder holds no job.json, which a folder of masks has once it is "
                             "complete");
        }
        const std::string text = read_bounded(description, max_description_bytes, description.string());
        const Json job = Json::parse(shallow_json(text), nullptr, false);
        if (text_of(job, "format") != "lamella-layers")
            throw InputError(description.string() + ": this is no description of layers by lamella");
        read_facts(job);
        read_range(job);
    }

    MaskImage layer(int index) const override {
        const std::string name = fmt::format("{:05}{}", index + first_, ending_);
        const std::string where = (path_ / name).string();
        return decode_mask(name, read_bounded(path_ / name, max_mask_bytes, where),
                           {facts_.width, facts_.height}, MaskPacking::plain, where);
    }

  private:
    [[noreturn]] void reject(const std::string& why) const {
        throw InputError((path_ / "job.json").string() + ": " + why);
    }

    void read_facts(const Json& job) {
        const std::string pattern = text_of(job, "files");
        constexpr std::array known{".png", ".tif", ".bmp", ".pgm"};
        for (const char* ending : known) {
            if (pattern == std::string("%05d") + ending) ending_ = ending;
        }
        if (ending_.empty()) reject("its files \"" + pattern.substr(0, 64) + "\" are no masks");
        facts_.format = "folder of masks (" + ending_.substr(1) + ")";
        facts_.name = text_of(job, "name");
        facts_.machine = text_of(job, "printer");
        facts_.material = text_of(job, "material");
        facts_.program = text_of(job, "program");
        facts_.width = count_or_none(number_of(job, "width")).value_or(0);
        facts_.height = count_or_none(number_of(job, "height")).value_or(0);
        if (facts_.width < 1 || facts_.height < 1) reject("width and height of the masks are missing");
        facts_.layer_height = positive_or_none(number_of(job, "layer_height"));
        facts_.pixel_x = positive_or_none(number_of(job, "pixel_x"));
        facts_.pixel_y = positive_or_none(number_of(job, "pixel_y"));
        if (job.contains("portrait") && job["portrait"] == true) std::swap(facts_.pixel_x, facts_.pixel_y);
        facts_.exposure = positive_or_none(number_of(job, "exposure"));
        facts_.first_exposure = positive_or_none(number_of(job, "first_exposure"));
        facts_.first_layers = count_or_none(number_of(job, "first_layers"));
        facts_.fade_layers = count_or_none(number_of(job, "fade_layers"));
        facts_.print_time = positive_or_none(number_of(job, "print_time"));
        facts_.volume = positive_or_none(number_of(job, "volume"));
    }

    void read_range(const Json& job) {
        const auto first = count_or_none(number_of(job, "first_layer")),
                   last = count_or_none(number_of(job, "last_layer"));
        if (!first || !last || *first >= *last) reject("first_layer and last_layer are missing or no range");
        first_ = *first;
        facts_.layers = *last - *first;
        const LayerPlan all = heights_of(job);
        std::vector<EqualLayers> these;
        for (int k = *first; k < std::min(*last, all.count()); ++k) these.push_back({1, all.height(k)});
        if (*last <= all.count()) facts_.heights = LayerPlan(these);
        std::error_code error;
        for (int k = *first; k < *last; ++k) {
            const std::string name = fmt::format("{:05}{}", k, ending_);
            if (!fs::exists(path_ / name, error))
                throw InputError(fmt::format("{}: layer {} ({}) is missing", path_.string(), k, name));
        }
    }

    fs::path path_;
    std::string ending_;
    int first_ = 0;
};

}  // namespace

std::unique_ptr<JobFile> read_png_stack(const std::string& path) {
    return std::make_unique<PngStackFile>(path);
}

}  // namespace lamella
