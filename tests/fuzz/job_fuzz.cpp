// Fuzz target: any bytes, read as a finished job, end in masks of the size that the job states or in an
// InputError. The first byte says how the rest is packed: as it is (GOO, Ember, ZIP), or as entries of an SL1
// or a NanoDLP archive, since mutations of an archive itself rarely get past its checksums.
#include <zip.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "engine/base/error.h"
#include "printers/readers/read_job.h"
#include "tests/fuzz/scratch_file.h"

using namespace lamella;

namespace {

/// Packs the text before the first zero byte as one entry and the rest as another.
std::string packed(const std::uint8_t* data, std::size_t size, const char* text_entry,
                   const char* mask_entry) {
    const std::string path = (scratch_folder() / "packed.zip").string();
    const std::size_t split = static_cast<std::size_t>(std::find(data, data + size, 0) - data);
    const std::size_t rest = std::min(split + 1, size);
    zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    if (zip == nullptr) std::abort();
    zip_file_add(zip, text_entry, zip_source_buffer(zip, data, split, 0), 0);
    zip_file_add(zip, mask_entry, zip_source_buffer(zip, data + rest, size - rest, 0), 0);
    if (zip_close(zip) != 0) std::abort();
    return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const int way = data[0] % 3;
    ++data, --size;
    const std::string path = way == 0   ? scratch_file("job.bin", data, size)
                             : way == 1 ? packed(data, size, "config.ini", "part00000.png")
                                        : packed(data, size, "plate.json", "1.png");
    try {
        const auto job = open_if_job(path);
        if (!job) return 0;
        const JobFacts& facts = job->facts();
        constexpr std::int64_t bearable = 1 << 22;  // px
        if (std::int64_t{facts.width} * facts.height > bearable) return 0;
        for (int layer = 0; layer < std::min(job->layers(), 3); ++layer) {
            const MaskImage mask = job->layer(layer);
            if (mask.width != facts.width || mask.height != facts.height) std::abort();
            if (mask.pixels.size() != std::size_t(mask.width) * std::size_t(mask.height)) std::abort();
        }
    } catch (const InputError&) {
    }
    return 0;
}
