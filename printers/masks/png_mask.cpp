// Encodes a layer's runs as the bytes of a PNG file.
#include "printers/masks/png_mask.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "printers/masks/png_writer.h"

namespace lamella {
namespace {

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

}  // namespace

std::unique_ptr<MaskFile> render_png_mask(const Layer& layer, const MaskLayout& layout,
                                          const PrinterProfile& profile) {
    auto mask = std::make_unique<MaskFile>();
    PngWriter writer({layout.width(), layout.height(), layout.column_pitch(), layout.row_pitch(),
                      PngColors::grey, profile.image.bits},
                     mask->file);
    const MaskArea area =
        mask_layer(layer, layout, profile.image, profile.support.grey,
                   [&](std::span<const GreyRun> runs, int rows) { writer.add_rows(runs, rows); });
    writer.finish();
    mask->area = area.part;
    mask->support_area = area.supports;
    return mask;
}

nlohmann::ordered_json describe_mask(const ImageProfile& image) {
    nlohmann::ordered_json json = {
        {"display_width", image.width}, {"display_height", image.height},
        {"pixel_x", image.pixel_x},     {"pixel_y", image.pixel_y},
        {"portrait", image.portrait},   {"mirror_x", image.mirror_x},
        {"mirror_y", image.mirror_y},   {"antialiasing", antialiasing_name(image.antialiasing)}};
    if (image.antialiasing == Antialiasing::rows) json["sub_rows"] = image.sub_rows;
    const ImageProfile plain;
    if (image.bits != plain.bits) json["bits"] = image.bits;
    if (image.sub_layers != plain.sub_layers) json["sub_layers"] = image.sub_layers;
    if (image.gamma != plain.gamma) json["gamma"] = image.gamma;
    if (image.min_grey != plain.min_grey) json["least_grey"] = image.min_grey;
    if (image.full_grey != plain.full_grey) json["full_grey"] = image.full_grey;
    return json;
}

std::string mask_settings(const PrinterProfile& profile, const Job& job, bool takes_other_bits) {
    if (profile.image.bits != 8 && !takes_other_bits) {
        throw InputError(
            fmt::format("bits = {}: what is written here has masks of 8 bits; accepted: bits = 8, or a "
                        "stack of PNG files",
                        profile.image.bits));
    }
    std::string settings = describe_mask(profile.image).dump();
    if (!job.supports) return settings;
    const double grey = profile.support.grey;
    if (!(grey >= 0 && grey <= 1)) {
        throw InputError(fmt::format("grey of supports = {}: must be 0 to 1", grey));
    }
    return settings + fmt::format(" supports {}", grey);
}

}  // namespace lamella
