// Fuzz target: any bytes, read as a finished job, end in masks of the size that the job states or in an
// InputError. The first byte says how the rest is packed: as it is, or as the content of an SL1 or a NanoDLP
// archive, of a GOO file or of an Ember archive, since mutations rarely get past checksums and large headers.
#include <zip.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "engine/base/error.h"
#include "printers/readers/read_job.h"
#include "tests/fuzz/png_checksums.h"
#include "tests/fuzz/scratch_file.h"

using namespace lamella;

namespace {

/// The text before the first zero byte, and the rest as an image.
struct TextAndImage {
    explicit TextAndImage(const std::string& bytes)
        : text(bytes.substr(0, bytes.find('\0'))),
          image(bytes.substr(std::min(text.size() + 1, bytes.size()))) {
        mend_png_checksums(image);
    }
    std::string text, image;
};

std::string zip_of(const TextAndImage& parts, const char* text_entry, const char* image_entry) {
    const std::string path = (scratch_folder() / "packed.zip").string();
    zip_t* zip = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    if (zip == nullptr) std::abort();
    const auto add = [&](const char* name, const std::string& content) {
        const zip_int64_t index =
            zip_file_add(zip, name, zip_source_buffer(zip, content.data(), content.size(), 0), 0);
        zip_set_file_compression(zip, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
    };
    add(text_entry, parts.text);
    add(image_entry, parts.image);
    if (zip_close(zip) != 0) std::abort();
    return path;
}

/// Adds the two pictures, which nothing reads, to a GOO file without them.
std::string goo_of(std::string bytes) {
    constexpr std::size_t small = std::size_t{116} * 116 * 2, large = std::size_t{290} * 290 * 2;
    constexpr std::size_t before = 194;
    const std::size_t at = std::min(before, bytes.size());
    bytes.insert(at, small + 2 + large + 2, '\0');
    return scratch_file("job.goo", bytes);
}

/// Appends a file to a tape archive.
void add_to_tar(std::string& tar, const std::string& name, const std::string& content) {
    constexpr std::size_t block = 512;
    std::string head(block, '\0');
    head.replace(0, name.size(), name);
    char number[13];
    std::snprintf(number, sizeof number, "%011zo ", content.size());
    head.replace(124, 12, number, 12);
    head[156] = '0';
    head.replace(148, 8, 8, ' ');
    unsigned sum = 0;
    for (const char c : head) sum += static_cast<unsigned char>(c);
    std::snprintf(number, sizeof number, "%06o", sum);
    head.replace(148, 7, number, 7);
    tar += head + content + std::string((block - content.size() % block) % block, '\0');
}

std::string ember_of(const TextAndImage& parts) {
    std::string tar;
    add_to_tar(tar, "printsettings", parts.text);
    add_to_tar(tar, "slice_1.png", parts.image);
    tar.append(1024, '\0');
    const std::string path = (scratch_folder() / "job.tar.gz").string();
    const gzFile file = gzopen(path.c_str(), "wb1");
    gzwrite(file, tar.data(), static_cast<unsigned>(tar.size()));
    if (gzclose(file) != Z_OK) std::abort();
    return path;
}

std::string packed(int way, const std::string& bytes) {
    if (way == 1) return zip_of(TextAndImage(bytes), "config.ini", "part00000.png");
    if (way == 2) return zip_of(TextAndImage(bytes), "plate.json", "1.png");
    if (way == 3) return goo_of(bytes);
    if (way == 4) return ember_of(TextAndImage(bytes));
    return scratch_file("job.bin", bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        const auto job = open_if_job(packed(data[0] % 5, bytes));
        if (!job) return 0;
        const JobFacts& facts = job->facts();
        constexpr std::int64_t bearable = 1 << 20;  // px
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
