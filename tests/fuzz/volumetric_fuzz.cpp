// Fuzz target: any bytes, read as the model part of a 3MF package with volumes and functions, end in solids
// and numbers or an InputError.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/formula/formula_grading.h"
#include "engine/io/image_file.h"
#include "procedural/volume/volumetric_model.h"
#include "tests/fuzz/check_grading.h"
#include "tests/fuzz/packed_model.h"

namespace {

/// Ranges enclose numbers, whatever the formula.
void ask(const lamella::Grading& grading) {
    lamella::check_grading(grading, {lamella::dvec3(-1), lamella::dvec3(2)});
}

/// A sheet of an image stack of 4 x 3 pixels.
const std::string& sheet() {
    static const std::string bytes = [] {
        lamella::ImageData image;
        image.width = 4;
        image.height = 3;
        const std::vector<std::uint8_t> pixels{0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 255};
        image.pixels = pixels;
        const std::vector<std::byte> file = lamella::encode_image("a.png", image);
        return std::string(reinterpret_cast<const char*>(file.data()), file.size());
    }();
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        lamella::VolumetricModel model("fuzz.3mf", lamella::packed_model(data, size, sheet()));
        for (const char* function : {"1", "2", "3.red", "4", "5", "5.shape.x", "f"}) {
            try {
                lamella::PlacedFormula placed = model.function(function);
                ask(*lamella::make_formula_grading(std::move(placed.formula), std::move(placed.others)));
            } catch (const lamella::InputError&) {
            }
        }
        try {
            ask(*model.property("p", ""));
        } catch (const lamella::InputError&) {
        }
        model.built()->value({0.5, 0.5, 0.5});
    } catch (const lamella::InputError&) {
    }
    return 0;
}
