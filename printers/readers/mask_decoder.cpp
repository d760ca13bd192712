// Checks the claims of an image before it is unpacked.
#include "printers/readers/mask_decoder.h"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <span>

#include "engine/base/error.h"
#include "engine/io/image_file.h"

namespace lamella {
namespace {

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char c : bytes.substr(0, 4)) value = value << 8U | static_cast<unsigned char>(c);
    return value;
}

/// Throws InputError unless a PNG file consists of complete chunks with correct checksums, from its beginning
/// to its end (ISO/IEC 15948, section 5). The image library reports such damage as well, but also prints it.
void check_png(std::string_view bytes, const std::string& where) {
    constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
    const auto reject = [&](const char* why) {
        throw InputError(where + ": the image cannot be read (" + why + ")");
    };
    if (!bytes.starts_with(signature)) reject("it is no PNG file");
    constexpr std::size_t frame = 12;  // bytes of a chunk besides its data: length, name and checksum
    std::string_view name;
    for (std::size_t at = signature.size(); name != "IEND";) {
        const std::string_view left = bytes.substr(at);
        if (left.size() < frame || big_endian(left) > left.size() - frame) reject("it is cut off");
        const std::size_t length = big_endian(left);
        if (name.empty() && (left.substr(4, 4) != "IHDR" || length != 13)) reject("it has no header");
        name = left.substr(4, 4);
        if (libdeflate_crc32(0, left.data() + 4, length + 4) != big_endian(left.substr(length + 8)))
            reject("a checksum is wrong");
        at += length + frame;
    }
}

/// An image file in memory whose claims have been checked.
class OpenImage {
  public:
    OpenImage(const std::string& name, std::string_view bytes, const std::string& where) : where_(where) {
        if (name.ends_with(".png")) check_png(bytes, where);
        std::string why;
        reader_ = open_images(name, bytes, why);
        const auto page = reader_ ? reader_->next_page() : std::nullopt;
        if (!page) reject(why);
        page_ = *page;
        if (page_.width < 1 || page_.height < 1 || page_.width > 65535 || page_.height > 65535 ||
            std::int64_t{page_.width} * page_.height > max_mask_pixels || page_.channels < 1 ||
            page_.channels > 4 || page_.depth > 1 || page_.deep) {
            reject(fmt::format("it is said to be of {} x {} px with {} channels, which no mask is",
                               page_.width, page_.height, page_.channels));
        }
    }

    const ImagePage& page() const { return page_; }

    /// Returns all samples, with the channels of a pixel next to each other.
    std::vector<std::uint8_t> read() {
        std::vector<std::uint8_t> samples(static_cast<std::size_t>(page_.width) *
                                          static_cast<std::size_t>(page_.height) *
                                          static_cast<std::size_t>(page_.channels));
        const std::string why = reader_->read_bytes(samples.data());
        if (!why.empty()) reject(why);
        return samples;
    }

    [[noreturn]] void reject(std::string why) const {
        while (!why.empty() && (why.back() == '\n' || why.back() == '.')) why.pop_back();
        throw InputError(where_ + ": the image cannot be read" + (why.empty() ? "" : " (" + why + ")"));
    }

  private:
    const std::string& where_;
    std::unique_ptr<ImageReader> reader_;
    ImagePage page_;
};

/// Returns the brightest colour of each pixel; alpha does not count.
std::vector<std::uint8_t> brightest(std::span<const std::uint8_t> samples, int channels) {
    const auto step = static_cast<std::size_t>(channels);
    const std::size_t colors = channels >= 3 ? 3 : 1;
    std::vector<std::uint8_t> greys;
    greys.reserve(samples.size() / step);
    for (std::size_t i = 0; i < samples.size(); i += step)
        greys.push_back(*std::ranges::max_element(samples.subspan(i, colors)));
    return greys;
}

}  // namespace

MaskSize image_size(const std::string& name, std::string_view bytes, const std::string& where) {
    const OpenImage image(name, bytes, where);
    return {image.page().width, image.page().height};
}

MaskImage decode_mask(const std::string& name, std::string_view bytes, MaskSize expected, MaskPacking packing,
                      const std::string& where) {
    OpenImage image(name, bytes, where);
    const bool packed = packing == MaskPacking::in_colors;
    const int channels = image.page().channels;
    if (packed && channels != 3) image.reject("it has no three colours, as the others");
    MaskImage mask{packed ? 3 * image.page().width : image.page().width, image.page().height, {}};
    if (mask.width != expected.width || mask.height != expected.height) {
        throw InputError(fmt::format("{}: the image is of {} x {} px where {} x {} px are expected", where,
                                     mask.width, mask.height, expected.width, expected.height));
    }
    mask.pixels = image.read();
    if (!packed && channels > 1) mask.pixels = brightest(mask.pixels, channels);
    return mask;
}

}  // namespace lamella
