// The back-end for folders of images.
#include "printers/masks/png_stack.h"

#include <optional>

#include "printers/archive/unfinished_folder.h"
#include "printers/masks/image_encoder.h"
#include "printers/masks/png_mask.h"
#include "printers/masks/resin.h"

namespace lamella {
namespace {

class PngStack : public Backend {
  public:
    PngStack(const PrinterProfile& profile, const std::string& path, bool force)
        : profile_(profile), output_(path, extension(profile.image.format), force) {}

    int open(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        layout_.emplace(profile_.image, job.bounds);
        description_ = describe_job(job, range, extension(profile_.image.format));
        description_["printer"] = profile_.name;
        description_["width"] = layout_->width();
        description_["height"] = layout_->height();
        description_.update(describe_mask(profile_.image));
        description_["placement"] = placement();
        if (job.supports) description_["support_grey"] = profile_.support.grey;
        description_.update(exposures(job.layers));
        const std::string settings =
            extension(profile_.image.format) +
            (" " + mask_settings(profile_, job, profile_.image.format == ImageFormat::png) + " " +
             exposures(job.layers).dump());
        return output_.begin({job.identity, settings, range}, resume);
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        if (profile_.image.format == ImageFormat::png) return render_png_mask(layer, *layout_, profile_);
        auto product = std::make_unique<MaskFile>();
        render_pixels(layer, *product);
        return product;
    }

    std::unique_ptr<LayerProduct> empty_product() const override { return std::make_unique<MaskFile>(); }

    void write(const Layer& layer, LayerProduct& product) override {
        output_.write(layer.index(), dynamic_cast<MaskFile&>(product).file, product);
    }

    void finish() override { output_.end(description_); }

  private:
    /// Renders the layer into a full page of pixels, for formats that are not encoded from runs.
    void render_pixels(const Layer& layer, MaskFile& product) const {
        std::vector<std::uint8_t> pixels;
        pixels.reserve(static_cast<std::size_t>(layout_->width()) *
                       static_cast<std::size_t>(layout_->height()));
        const MaskArea area =
            mask_layer(layer, *layout_, profile_.image, profile_.support.grey,
                       [&](std::span<const GreyRun> runs, int /*rows*/) {
                           for (const GreyRun& run : runs)
                               pixels.insert(pixels.end(), run.length, static_cast<std::uint8_t>(run.value));
                       });
        product.area = area.part;
        product.support_area = area.supports;
        product.file = encode_image(profile_.image.format, layout_->width(), layout_->height(), pixels);
        if (profile_.image.format == ImageFormat::bmp)
            set_bmp_pixel_size(product.file, layout_->column_pitch(), layout_->row_pitch());
    }

    /// Returns the part coordinates (mm) of the corner of pixel (0, 0) and the steps to the next column and
    /// row.
    nlohmann::ordered_json placement() const {
        const RowBand band = layout_->rows(0, 1, 1);
        const bool x = band.axis == Axis::x;
        return {{"columns_along", x ? "x" : "y"},
                {"column_0_edge", band.along_origin},
                {"column_step", band.along_pitch},
                {"row_0_edge", band.across_origin},
                {"row_step", band.across_pitch}};
    }

    /// Returns the exposures, s: the first layers, a linear ramp, then all others. Where they differ, they
    /// are lists of [count, exposure], like the heights.
    nlohmann::ordered_json exposures(const LayerPlan& layers) const {
        const ResinProfile& resin = profile_.resin;
        const auto by_height = [&](double ResinProfile::*exposure) -> nlohmann::ordered_json {
            if (layers.equal() || resin.penetration == 0)
                return resin_for_height(resin, layers.least_height()).*exposure;
            auto runs = nlohmann::ordered_json::array();
            for (const EqualLayers& run : layers.runs())
                runs.push_back({run.count, resin_for_height(resin, run.height).*exposure});
            return runs;
        };
        return {{"first_layers", resin.first_layers},
                {"first_exposure", by_height(&ResinProfile::first_exposure)},
                {"fade_layers", resin.fade_layers},
                {"exposure", by_height(&ResinProfile::exposure)}};
    }

    PrinterProfile profile_;
    UnfinishedFolder output_;
    std::optional<MaskLayout> layout_;
    nlohmann::ordered_json description_;
};

}  // namespace

std::unique_ptr<Backend> make_png_stack(const PrinterProfile& profile, const std::string& path, bool force) {
    return std::make_unique<PngStack>(profile, path, force);
}

}  // namespace lamella
