// A layer's mask as a PNG file, for every back-end that keeps such files.
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

/// The mask of part and supports, 8-bit grey, written straight from runs.
std::unique_ptr<MaskFile> render_png_mask(const Layer& layer, const MaskLayout& layout,
                                          const PrinterProfile& profile);

/// What decides a mask's pixels besides the layer: display and antialiasing.
nlohmann::ordered_json describe_mask(const ImageProfile& image);

/// Returns the description as one line for a job's stamp, with the grey of its supports. Throws InputError
/// for a grey that is none, and for other bits per pixel than 8 unless the back-end takes them.
std::string mask_settings(const PrinterProfile& profile, const Job& job, bool takes_other_bits = false);

}  // namespace lamella
