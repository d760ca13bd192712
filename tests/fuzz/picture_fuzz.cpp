// Fuzz target: any bytes, read as a picture of a skin, end in as many samples as it has pixels or in an
// InputError.
#include "engine/base/error.h"
#include "procedural/volume/volume.h"
#include "tests/fuzz/png_checksums.h"
#include "tests/fuzz/scratch_file.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t header = 33;  // of a PNG: signature, sizes and their checksum
    if (size > header) {
        // Sizes beyond these only take time.
        for (const std::size_t i : {16U, 17U, 18U, 20U, 21U, 22U}) {
            if (data[i] != 0) return 0;
        }
    }
    std::string bytes(reinterpret_cast<const char*>(data), size);
    mend_png_checksums(bytes);
    try {
        const Volume volume = read_picture(scratch_file("picture.png", bytes));
        std::visit(
            [&](const auto& samples) {
                if (samples.size() != volume.size[0] * volume.size[1] * volume.size[2]) std::abort();
            },
            volume.samples);
    } catch (const InputError&) {
    }
    return 0;
}
