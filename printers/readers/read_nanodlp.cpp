// NanoDLP archives: numbered images and JSON descriptions; all but the images are optional.
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "printers/readers/job_number.h"
#include "printers/readers/job_readers.h"
#include "printers/readers/mask_decoder.h"

namespace lamella {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_json_bytes = std::size_t{1} << 26U, max_png_bytes = std::size_t{1} << 28U;  // bytes
constexpr double cm3 = 1000;                                                                          // mm^3

class NanoDlpFile : public JobFile {
  public:
    explicit NanoDlpFile(JobArchive archive) : archive_(std::move(archive)) {
        const Json meta = description("meta.json"), plate = description("plate.json"),
                   profile = description("profile.json");
        const Json display = description(archive_.has("options.json") ? "options.json" : "slicer.json");
        facts_.format = "NanoDLP archive";
        facts_.name = text_of(plate, "Path");
        facts_.machine = text_of(profile, "Title");
        facts_.material = text_of(profile, "Desc");
        facts_.program = text_of(meta, "Program");
        if (const std::string version = text_of(meta, "Version"); !version.empty())
            facts_.program += " " + version;
        auto depth = positive_or_none(number_of(display, "Thickness"));
        if (!depth) depth = positive_or_none(number_of(profile, "Depth"));
        if (depth) facts_.layer_height = *depth * micrometre;
        facts_.exposure = positive_or_none(number_of(profile, "CureTime"));
        facts_.first_exposure = positive_or_none(number_of(profile, "SupportCureTime"));
        facts_.first_layers = count_or_none(number_of(profile, "SupportLayerNumber"));
        facts_.fade_layers = count_or_none(number_of(profile, "TransitionalLayer"));
        facts_.print_time = positive_or_none(number_of(plate, "PrintTime"));
        if (const auto volume = positive_or_none(number_of(plate, "TotalSolidArea")))
            facts_.volume = *volume * cm3;
        count_layers(plate);
        read_size(display);
    }

    MaskImage layer(int index) const override {
        if (index < 0 || index >= layers()) throw InputError(where(index) + ": there is no such layer");
        return decode_mask("layer.png", archive_.read(image(index), max_png_bytes),
                           {facts_.width, facts_.height}, packing_, where(index));
    }

  private:
    std::string image(int index) const { return fmt::format("{}.png", index + base_); }
    std::string where(int index) const {
        return fmt::format("{}: layer {} ({})", archive_.path(), index, image(index));
    }

    /// Returns the JSON object of an entry; an empty one if there is no such entry.
    Json description(const std::string& name) const {
        if (!archive_.has(name)) return Json::object();
        const std::string text = archive_.read(name, max_json_bytes);
        Json json = Json::parse(shallow_json(text), nullptr, false);
        if (!json.is_object()) throw InputError(archive_.path() + ": '" + name + "' is no JSON object");
        return json;
    }

    void count_layers(const Json& plate) {
        // The vendor's page numbers images from 0, its program from 1.
        base_ = archive_.has("0.png") ? 0 : 1;
        int found = 0;
        while (archive_.has(image(found))) ++found;
        const int stated = count_or_none(number_of(plate, "LayersCount")).value_or(0);
        if (found < stated || found == 0) {
            throw InputError(fmt::format("{}: layer {} ({}) is missing: plate.json tells of {} layers",
                                         archive_.path(), found, image(found), stated));
        }
        if (stated != 0 && stated < found)
            facts_.notes.push_back(fmt::format("plate.json tells of {} layers, {} are there", stated, found));
        facts_.layers = found;
    }

    void read_size(const Json& display) {
        const MaskSize size = image_size("layer.png", archive_.read(image(0), max_png_bytes), where(0));
        facts_.width = size.width;
        facts_.height = size.height;
        if (number_of(display, "PWidth") == 3.0 * size.width) {
            packing_ = MaskPacking::in_colors;
            facts_.width *= 3;
        }
        facts_.pixel_x = positive_or_none(number_of(display, "XPixelSize"));
        facts_.pixel_y = positive_or_none(number_of(display, "YPixelSize"));
    }

    JobArchive archive_;
    int base_ = 1;
    MaskPacking packing_ = MaskPacking::plain;
};

}  // namespace

std::unique_ptr<JobFile> read_nanodlp(JobArchive archive) {
    return std::make_unique<NanoDlpFile>(std::move(archive));
}

}  // namespace lamella
