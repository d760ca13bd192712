// Entries of the archive, and its two descriptions.
#include "printers/masks/sl1.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/json_number.h"
#include "printers/archive/stored_zip.h"
#include "printers/archive/unfinished_file.h"
#include "printers/common/layer_heights.h"
#include "printers/common/thumbnail.h"
#include "printers/masks/png_mask.h"
#include "printers/masks/resin.h"

namespace lamella {
namespace {

constexpr int first_layers = 3;           // layers that the machine exposes like the first
constexpr int small_preview_width = 400;  // px
constexpr int max_sl1_layers = 99'999;    // names have five digits

/// Lines of `key = value`, sorted by key.
using Sl1Description = std::map<std::string, std::string>;

std::string to_text(const Sl1Description& description) {
    std::string text;
    for (const auto& [key, value] : description) text += fmt::format("{} = {}\n", key, value);
    return text;
}

/// Returns the prefix of all layer names. Machines take every image with this prefix for a layer, so the
/// folder of the previews must not have it.
std::string job_folder(const std::string& name) {
    constexpr std::size_t longest = 64;
    std::string clean;
    for (const char c : name.substr(0, longest)) {
        const bool plain = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') ||
                           c == '-' || c == '_';
        clean += plain ? c : '_';
    }
    return std::string_view("thumbnail").starts_with(clean) ? "job-" + clean : clean;
}

/// Returns the text reduced to one line of a description.
std::string one_line(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return text;
}

class Sl1 : public Backend {
  public:
    Sl1(const PrinterProfile& profile, const std::string& path, bool force)
        : profile_(profile), path_(path), output_(path, force) {
        profile_.resin.first_layers = first_layers;
    }

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        layout_.emplace(profile_.image, job.bounds);
        check_resin_profile(profile_.resin, job.layers.greatest_height());
        if (range.count() > max_sl1_layers) {
            throw InputError(fmt::format("{} layers are too many for an SL1 archive; accepted: {} or fewer",
                                         range.count(), max_sl1_layers));
        }
        folder_ = job_folder(job.name);
        check_layer_heights(LayerHeights::first, job.layers, range, "an SL1 archive");
        layers_ = job.layers;
        first_height_ = job.layers.height(range.first);
        layer_height_ = job.layers.height(range.last - 1);
        range_ = range;
        if (profile_.resin.preview) picture_ = job.picture;
        for (const std::string& note : job.notes) notes_ += (notes_.empty() ? "" : "; ") + one_line(note);
        height_ = job.layers.total();
        const std::string settings = "sl1 " + mask_settings(profile_, job) + " " + profile_.name + " " +
                                     describe_resin(profile_.resin);
        const int next = output_.begin({job.identity, settings, range}, resume);
        if (output_.resumed()) {
            output_.restore([&](const auto& state) {
                volume_ = state.at(0).template get<double>();
                zip_.take_up(path_ + ".partial", whole_number<std::uint64_t>(state.at(1)));
            });
        }
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        return render_png_mask(layer, *layout_, profile_);
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<MaskFile>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        const auto& file = dynamic_cast<MaskFile&>(product).file;
        volume_ += (product.area + product.support_area) * layer.thickness();
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text for the archive
        const std::string_view bytes(reinterpret_cast<const char*>(file.data()), file.size());
        const std::string name = fmt::format("{}{:05}.png", folder_, layer.index() - range_.first);
        const std::string entry = zip_.entry(name, bytes);
        output_.commit(entry, layer.index() + 1, {volume_, zip_.size()});
    }

    void finish() override {
        std::string text = zip_.entry("config.ini", to_text(for_machine()));
        text += zip_.entry("prusaslicer.ini", to_text(for_programs()));
        if (picture_) {
            const Picture square = picture_(small_preview_width);
            text += zip_.entry("thumbnail/thumbnail400x400.png", png_file(square));
            text += zip_.entry("thumbnail/thumbnail800x480.png", png_file(centred(square, 800, 480)));
        }
        output_.end(text + zip_.directory());
    }

  private:
    Sl1Description for_machine() const {
        const ResinProfile& r = profile_.resin;
        const double exposure = resin_for_height(r, layer_height_).exposure;
        const double first_exposure = resin_for_height(r, first_height_).first_exposure;
        constexpr double ml = 1000;  // mm^3
        return {{"action", "print"},
                {"expTime", format_number(exposure, 4)},
                {"expTimeFirst", format_number(first_exposure, 4)},
                {"expUserProfile", "0"},
                {"fileCreationTimestamp", "1980-01-01 at 00:00:00 UTC"},
                {"hollow", "0"},
                {"jobDir", folder_},
                {"layerHeight", format_number(layer_height_, 6)},
                {"layerHeightFirst", format_number(first_height_, 6)},
                {"materialName", one_line(r.material)},
                {"numFade", std::to_string(r.fade_layers)},
                {"numFast", std::to_string(range_.count())},
                {"numSlow", "0"},
                {"printProfile", format_number(layer_height_, 6) + " Lamella"},
                {"printTime", format_number(resin_print_time(r, layers_, range_), 3)},
                {"printerModel", one_line(machine_name(profile_))},
                {"printerProfile", one_line(profile_.name)},
                {"printerVariant", "default"},
                {"prusaSlicerVersion", "Lamella " LAMELLA_VERSION},
                {"usedMaterial", format_number(volume_ / ml, 6)}};
    }

    /// Describes the display in the terms of a slicer. A display in portrait swaps the axes, which mirrors by
    /// itself: for it `display_mirror_x` means that the image is not mirrored any further.
    Sl1Description for_programs() const {
        const ImageProfile& image = profile_.image;
        const ResinProfile& r = profile_.resin;
        const auto flag = [](bool value) { return std::string(value ? "1" : "0"); };
        const bool mirror_x = image.portrait != image.mirror_x;
        const std::string layer = format_number(layer_height_, 6);
        return {
            {"display_height", format_number(image.height * image.pixel_y, 6)},
            {"display_mirror_x", flag(mirror_x)},
            {"display_mirror_y", flag(image.mirror_y)},
            {"display_orientation", image.portrait ? "portrait" : "landscape"},
            {"display_pixels_x", std::to_string(image.width)},
            {"display_pixels_y", std::to_string(image.height)},
            {"display_width", format_number(image.width * image.pixel_x, 6)},
            {"exposure_time", format_number(resin_for_height(r, layer_height_).exposure, 4)},
            {"faded_layers", std::to_string(r.fade_layers)},
            {"gamma_correction",
             image.antialiasing == Antialiasing::off ? "0" : format_number(image.gamma, 4)},
            {"initial_exposure_time", format_number(resin_for_height(r, first_height_).first_exposure, 4)},
            {"initial_layer_height", format_number(first_height_, 6)},
            {"layer_height", layer},
            {"material_notes", notes_},
            {"max_print_height", format_number(height_, 6)},
            {"printer_model", one_line(machine_name(profile_))},
            {"printer_notes", one_line(r.notes)},
            {"printer_settings_id", one_line(profile_.name)},
            {"printer_technology", "SLA"}};
    }

    PrinterProfile profile_;
    std::string path_;
    UnfinishedFile output_;
    StoredZip zip_;
    std::optional<MaskLayout> layout_;
    std::function<Picture(int)> picture_;
    std::string folder_, notes_;
    LayerPlan layers_;
    double first_height_ = 0, layer_height_ = 0, height_ = 0;  ///< mm
    LayerRange range_;
    double volume_ = 0;  ///< mm^3
};

}  // namespace

std::unique_ptr<Backend> make_sl1(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<Sl1>(profile, path, force);
}

}  // namespace lamella
