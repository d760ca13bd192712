// SL1 archives: descriptions of `key = value` lines, and layers sorted by name.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "printers/readers/job_number.h"
#include "printers/readers/job_readers.h"
#include "printers/readers/mask_decoder.h"

namespace lamella {
namespace {

constexpr std::size_t max_config_bytes = std::size_t{1} << 20U,
                      max_image_bytes = std::size_t{1} << 28U;  // bytes
constexpr double mm3_per_ml = 1000;

using Description = std::map<std::string, std::string, std::less<>>;

Description parse(std::string_view text) {
    Description values;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t equals = line.find('=');
        if (equals == std::string_view::npos) continue;
        values.insert_or_assign(std::string(trimmed(line.substr(0, equals))),
                                std::string(trimmed(line.substr(equals + 1))));
    }
    return values;
}

std::string text_of(const Description& from, std::string_view key) {
    const auto found = from.find(key);
    return found == from.end() ? "" : found->second;
}

class Sl1File : public JobFile {
  public:
    explicit Sl1File(JobArchive archive) : archive_(std::move(archive)) {
        facts_.format = "SL1 archive";
        const Description machine = parse(archive_.read("config.ini", max_config_bytes));
        list_layers(machine);
        facts_.name = text_of(machine, "jobDir");
        facts_.machine = text_of(machine, "printerModel");
        facts_.material = text_of(machine, "materialName");
        facts_.program = text_of(machine, "prusaSlicerVersion");
        facts_.layer_height = positive(machine, "layerHeight");
        const auto first = positive(machine, "layerHeightFirst");
        if (first && facts_.layer_height && *first != *facts_.layer_height && facts_.layers > 1) {
            facts_.heights = LayerPlan({{1, *first}, {facts_.layers - 1, *facts_.layer_height}});
            facts_.layer_height.reset();
        }
        facts_.exposure = positive(machine, "expTime");
        facts_.first_exposure = positive(machine, "expTimeFirst");
        facts_.fade_layers = count(machine, "numFade");
        facts_.print_time = positive(machine, "printTime");
        if (const auto ml = positive(machine, "usedMaterial")) facts_.volume = *ml * mm3_per_ml;
        constexpr int first_layers = 3;  // layers that the machine exposes like the first
        facts_.first_layers = first_layers;
        if (archive_.has("prusaslicer.ini"))
            read_display(parse(archive_.read("prusaslicer.ini", max_config_bytes)));
        if (facts_.width == 0) {
            const MaskSize size = image_size(names_[0], archive_.read(names_[0], max_image_bytes), where(0));
            facts_.width = size.width;
            facts_.height = size.height;
        }
    }

    MaskImage layer(int index) const override {
        const std::string& name = names_.at(static_cast<std::size_t>(index));
        return decode_mask(name, archive_.read(name, max_image_bytes), {facts_.width, facts_.height},
                           MaskPacking::plain, where(index));
    }

  private:
    std::string where(int index) const {
        return fmt::format("{}: layer {} ({})", archive_.path(), index,
                           names_[static_cast<std::size_t>(index)]);
    }

    /// Returns the number of a key; empty if the key is absent. Throws InputError if the value is not a
    /// number.
    std::optional<double> number(const Description& from, std::string_view key) const {
        const std::string text = text_of(from, key);
        if (text.empty()) return std::nullopt;
        const auto value = parse_number(text);
        if (!value) {
            throw InputError(
                fmt::format("{}: {} = {}: this is no number", archive_.path(), key, text.substr(0, 64)));
        }
        return value;
    }
    std::optional<double> positive(const Description& from, std::string_view key) const {
        return positive_or_none(number(from, key));
    }
    std::optional<int> count(const Description& from, std::string_view key) const {
        return count_or_none(number(from, key));
    }

    /// Layers are the images whose names begin with jobDir, sorted as text, as the machine does.
    void list_layers(const Description& machine) {
        const std::string prefix = text_of(machine, "jobDir");
        if (prefix.empty())
            throw InputError(archive_.path() + ": config.ini has no jobDir, which names the layers");
        for (const std::string& name : archive_.names()) {
            if (name.starts_with(prefix) && (name.ends_with(".png") || name.ends_with(".PNG")))
                names_.push_back(name);
        }
        std::ranges::sort(names_);
        const auto fast = count(machine, "numFast"), slow = count(machine, "numSlow");
        const std::size_t stated =
            static_cast<std::size_t>(fast.value_or(0)) + static_cast<std::size_t>(slow.value_or(0));
        for (std::size_t i = 0; i < std::min(stated, names_.size() + 1); ++i) {
            const std::string name = fmt::format("{}{:05}.png", prefix, i);
            if (i >= names_.size() || (names_.size() < stated && names_[i] != name)) {
                throw InputError(
                    fmt::format("{}: layer {} ({}) is missing: config.ini tells of {} layers and {} "
                                "are there",
                                archive_.path(), i, name, stated, names_.size()));
            }
        }
        if (names_.empty()) throw InputError(archive_.path() + ": there are no layers in the archive");
        if (stated != 0 && stated < names_.size()) {
            facts_.notes.push_back(
                fmt::format("config.ini tells of {} layers, {} are there", stated, names_.size()));
        }
        facts_.layers = static_cast<int>(names_.size());
    }

    /// Reads the display. In portrait the axes are swapped in the images.
    void read_display(const Description& programs) {
        const auto x = count(programs, "display_pixels_x"), y = count(programs, "display_pixels_y");
        if (!x || !y || *x < 1 || *y < 1) return;
        facts_.width = *x;
        facts_.height = *y;
        if (const auto size = positive(programs, "display_width")) facts_.pixel_x = *size / *x;
        if (const auto size = positive(programs, "display_height")) facts_.pixel_y = *size / *y;
        if (text_of(programs, "display_orientation") != "portrait") return;
        std::swap(facts_.width, facts_.height);
        std::swap(facts_.pixel_x, facts_.pixel_y);
    }

    JobArchive archive_;
    std::vector<std::string> names_;
};

}  // namespace

std::unique_ptr<JobFile> read_sl1(JobArchive archive) {
    return std::make_unique<Sl1File>(std::move(archive));
}

}  // namespace lamella
