// The PNG stack.
#include "printers/png_stack.h"

#include <fmt/format.h>

#include <optional>

#include "engine/error.h"
#include "printers/image_encoder.h"
#include "printers/mask.h"
#include "printers/png_writer.h"
#include "printers/unfinished_folder.h"

namespace lamella {
namespace {

struct PngProduct : LayerProduct {
    std::vector<std::byte> file;
};

const char* antialiasing_name(Antialiasing antialiasing) {
    switch (antialiasing) {
        case Antialiasing::off:
            return "off";
        case Antialiasing::rows:
            return "rows";
        case Antialiasing::exact:
            return "exact";
    }
    throw InputError("antialiasing is neither off, rows nor exact");
}

nlohmann::ordered_json describe(const ImageProfile& image) {
    nlohmann::ordered_json json = {
        {"display_width", image.width}, {"display_height", image.height},
        {"pixel_x", image.pixel_x},     {"pixel_y", image.pixel_y},
        {"portrait", image.portrait},   {"mirror_x", image.mirror_x},
        {"mirror_y", image.mirror_y},   {"antialiasing", antialiasing_name(image.antialiasing)}};
    if (image.antialiasing == Antialiasing::rows) json["sub_rows"] = image.sub_rows;
    return json;
}

class PngStack : public Backend {
  public:
    PngStack(const PrinterProfile& profile, const std::string& path, bool force)
        : profile_(profile), output_(path, extension(profile.image.format), force) {}

    int begin(const Job& job, LayerRange range, bool resume) override {
        check_range(job, range);
        layout_.emplace(profile_.image, job.bounds);
        description_ = describe_job(job, range, extension(profile_.image.format));
        description_["printer"] = profile_.name;
        description_["width"] = layout_->width();
        description_["height"] = layout_->height();
        description_.update(describe(profile_.image));
        description_["placement"] = placement();
        std::string settings = extension(profile_.image.format) + (" " + describe(profile_.image).dump());
        if (job.supports) {
            const double grey = profile_.support.grey;
            if (!(grey >= 0 && grey <= 1)) {
                throw InputError(fmt::format("grey of supports = {}: must be 0 to 1", grey));
            }
            description_["support_grey"] = grey;
            settings += fmt::format(" supports {}", grey);
        }
        return output_.begin({job.identity, settings, range}, resume);
    }

    std::unique_ptr<LayerProduct> render(const Layer& layer) const override {
        auto product = std::make_unique<PngProduct>();
        if (profile_.image.format != ImageFormat::png) {
            render_pixels(layer, *product);
            return product;
        }
        PngWriter writer({layout_->width(), layout_->height(), layout_->column_pitch(), layout_->row_pitch()},
                         product->file);
        draw(layer, *product, [&](std::span<const GreyRun> runs, int rows) { writer.add_rows(runs, rows); });
        writer.finish();
        return product;
    }

    void write(const Layer& layer, LayerProduct& product) override {
        output_.write(layer.index(), dynamic_cast<PngProduct&>(product).file);
    }

    void end() override { output_.end(description_); }

  private:
    void draw(const Layer& layer, PngProduct& product, const BandSink& sink) const {
        const MaskArea area = mask_layer(layer, *layout_, profile_.image, profile_.support.grey, sink);
        product.area = area.part;
        product.support_area = area.supports;
    }

    /// The layer through a whole page of pixels, for formats that are not written from runs.
    void render_pixels(const Layer& layer, PngProduct& product) const {
        std::vector<std::uint8_t> pixels;
        pixels.reserve(static_cast<std::size_t>(layout_->width()) *
                       static_cast<std::size_t>(layout_->height()));
        draw(layer, product, [&](std::span<const GreyRun> runs, int /*rows*/) {
            for (const GreyRun& run : runs) pixels.insert(pixels.end(), run.length, run.value);
        });
        product.file = encode_image(profile_.image.format, layout_->width(), layout_->height(), pixels);
    }

    /// Part coordinates, mm, of the corner of pixel (0, 0) and the way to the next column and row.
    nlohmann::ordered_json placement() const {
        const RowBand band = layout_->rows(0, 1, 1);
        const bool x = band.axis == Axis::x;
        return {{"columns_along", x ? "x" : "y"},
                {"column_0_edge", band.along_origin},
                {"column_step", band.along_pitch},
                {"row_0_edge", band.across_origin},
                {"row_step", band.across_pitch}};
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
