// MaskFile: a layer's mask as a PNG file, shared by all back-ends that store such files.
#pragma once

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/layers/backend.h"
#include "printers/masks/mask.h"

namespace lamella {

struct MaskFile : LayerProduct {
    void serialize(Archive& parcel) override { parcel(file); }

    std::vector<std::byte> file;
};

/// Renders the mask of part and supports directly from runs, 8-bit grey.
std::unique_ptr<MaskFile> render_png_mask(const Layer& layer, const MaskLayout& layout,
                                          const PrinterProfile& profile);

/// Returns the settings that decide a mask's pixels besides the layer: display and antialiasing.
nlohmann::ordered_json describe_mask(const ImageProfile& image);

/// Returns the same settings and the grey of supports as one line, for a job's stamp. Throws InputError for a
/// grey outside 0 to 1, and for other bits per pixel than 8 unless the back-end takes them.
std::string mask_settings(const PrinterProfile& profile, const Job& job, bool takes_other_bits = false);

}  // namespace lamella
