// Fuzz target: any bytes, read as a TIFF, end in a number of pages that the file has room for or in an
// InputError.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "engine/base/error.h"
#include "procedural/volume/tiff_pages.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
    try {
        const auto pages = count_tiff_pages(in, "fuzz.tif");
        // A directory takes at least its number of entries and the next one's place.
        if (pages && *pages * 6 > size) std::abort();
    } catch (const InputError&) {
    }
    return 0;
}
