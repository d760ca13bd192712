// Ember archives: settings first, then the slices.
#include "printers/masks/ember.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/tar_gzip.h"
#include "printers/archive/unfinished_file.h"
#include "printers/common/layer_heights.h"
#include "printers/masks/png_mask.h"
#include "printers/masks/resin.h"

namespace lamella {
namespace {

constexpr int display_width = 1280, display_height = 800;  // px

/// Returns the layer height in whole micrometres, the unit of the machine. Throws InputError for any other
/// height, because the rounding error would add up over the layers.
int micrometres(double layer_height) {
    const double exact = layer_height * 1000;
    const double whole = std::round(exact);
    if (!(whole >= 1 && whole <= 1000 && std::abs(exact - whole) < 1e-6)) {
        throw InputError(fmt::format("layer_height = {} mm: an Ember takes whole micrometres, 0.001 to 1 mm",
                                     layer_height));
    }
    return static_cast<int>(whole);
}

class Ember : public Backend {
  public:
    Ember(const PrinterProfile& profile, const std::string& path, bool force)
        : profile_(profile), output_(path, force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        check_resin_profile(profile_.resin, job.layers.greatest_height());
        if (profile_.image.width != display_width || profile_.image.height != display_height) {
            throw InputError(
                fmt::format("{} x {} px: an Ember's display has {} x {} px; choose the printer "
                            "profile ember",
                            profile_.image.width, profile_.image.height, display_width, display_height));
        }
        layout_.emplace(profile_.image, job.bounds);
        range_ = range;
        const std::string start = gzip_member(settings(job));
        const std::string stamp = "ember " + mask_settings(profile_, job) + " " + profile_.name + " " +
                                  describe_resin(profile_.resin);
        const int next = output_.begin({job.identity, stamp, range}, resume);
        if (!output_.resumed()) output_.commit(start, next);
        return next;
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto mask = render_png_mask(layer, *layout_, profile_);
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text for the archive
        const std::string_view png(reinterpret_cast<const char*>(mask->file.data()), mask->file.size());
        const std::string piece =
            gzip_member(tar_member(fmt::format("slice_{}.png", layer.index() - range_.first + 1), png));
        const auto bytes = std::as_bytes(std::span(piece));
        mask->file.assign(bytes.begin(), bytes.end());
        return mask;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<MaskFile>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        const auto& piece = dynamic_cast<MaskFile&>(product).file;
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text for the archive
        output_.commit({reinterpret_cast<const char*>(piece.data()), piece.size()}, layer.index() + 1);
    }

    void finish() override { output_.end(gzip_member(tar_end())); }

  private:
    /// Returns the files before the slices.
    std::string settings(const Job& job) const {
        const double height = equal_layer_height(job.layers, range_, "an Ember archive");
        const ResinProfile resin = resin_for_height(profile_.resin, height);
        // The first layer has its own exposure; "burn-in" layers are those after it.
        const nlohmann::ordered_json settings = {{"JobName", job.name},
                                                 {"LayerThicknessMicrons", micrometres(height)},
                                                 {"BurnInLayers", std::max(resin.first_layers - 1, 0)},
                                                 {"FirstExposureSec", resin.first_exposure},
                                                 {"BurnInExposureSec", resin.first_exposure},
                                                 {"ModelExposureSec", resin.exposure}};
        const nlohmann::ordered_json file = {{"Settings", settings}};
        std::string text =
            tar_member("printsettings",
                       file.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
        const int first = resin.first_layers, last = std::min(first + resin.fade_layers, range_.count());
        if (first >= last) return text;
        std::string rows = "Layer,ModelExposureSec\r\n";
        for (int layer = first; layer < last; ++layer)
            rows += fmt::format("{},{}\r\n", layer + 1,
                                format_number(resin_exposure(profile_.resin, layer, height), 4));
        return text + tar_member("layersettings.csv", rows);
    }

    PrinterProfile profile_;
    UnfinishedFile output_;
    std::optional<MaskLayout> layout_;
    LayerRange range_;
};

}  // namespace

std::unique_ptr<Backend> make_ember(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<Ember>(profile, path, force);
}

}  // namespace lamella
