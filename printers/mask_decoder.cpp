// OpenImageIO behind two functions, band by band.
#include "printers/mask_decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <span>

#include "engine/error.h"

namespace lamella {
namespace {

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char c : bytes.substr(0, 4)) value = value << 8U | static_cast<unsigned char>(c);
    return value;
}

/// Throws InputError unless a PNG file consists of whole chunks with right checksums, from its beginning to its
/// end (ISO/IEC 15948, section 5). The library below reports such damage, but prints it as well.
void check_png(std::string_view bytes, const std::string& where) {
    constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
    const auto reject = [&](const char* why) {
        throw InputError(where + ": the image cannot be read (" + why + ")");
    };
    if (!bytes.starts_with(signature)) reject("it is no PNG file");
    constexpr std::size_t frame = 12;  // of a chunk: its length, name and checksum
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

/// OpenImageIO's name for the format that a file's ending tells.
const char* reader_of(const std::string& name) {
    const std::string ending = name.substr(std::min(name.rfind('.'), name.size()));
    if (ending == ".tif") return "tiff";
    if (ending == ".bmp") return "bmp";
    return ending == ".pgm" ? "pnm" : "png";
}

/// An image file in memory, open for reading by the reader that its name asks for and by no other.
class OpenImage {
  public:
    OpenImage(const std::string& name, std::string_view bytes, const std::string& where)
        : where_(where),
          // The reader wants a pointer to what it may change, and changes nothing.
          memory_(const_cast<char*>(bytes.data()), bytes.size()) {
        const char* const reader = reader_of(name);
        if (std::string_view(reader) == "png") check_png(bytes, where);
        input_ = OIIO::ImageInput::create(reader);
        if (!input_) reject(OIIO::geterror());
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        if (!input_->set_ioproxy(&memory_)) reject("its format is not read from memory");
        if (!input_->open(name, spec_, config)) reject(input_->geterror());
        if (spec_.width < 1 || spec_.height < 1 || spec_.width > 65535 || spec_.height > 65535 ||
            std::int64_t{spec_.width} * spec_.height > most_mask_pixels || spec_.nchannels < 1 ||
            spec_.nchannels > 4 || spec_.depth > 1 || spec_.tile_width != 0) {
            reject(fmt::format("it is said to be of {} x {} px with {} channels, which no mask is",
                               spec_.width, spec_.height, spec_.nchannels));
        }
    }

    const OIIO::ImageSpec& spec() const { return spec_; }

    /// Rows [first, last), the channels of a pixel side by side.
    void read_rows(int first, int last, std::vector<std::uint8_t>& samples) {
        samples.resize(static_cast<std::size_t>(last - first) * static_cast<std::size_t>(spec_.width) *
                       static_cast<std::size_t>(spec_.nchannels));
        if (!input_->read_scanlines(0, 0, spec_.y + first, spec_.y + last, 0, 0, spec_.nchannels,
                                    OIIO::TypeDesc::UINT8, samples.data())) {
            reject(input_->geterror());
        }
    }

    [[noreturn]] void reject(std::string why) const {
        while (!why.empty() && (why.back() == '\n' || why.back() == '.')) why.pop_back();
        throw InputError(where_ + ": the image cannot be read" + (why.empty() ? "" : " (" + why + ")"));
    }

  private:
    const std::string& where_;
    OIIO::Filesystem::IOMemReader memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
};

/// The greys of a row of pixels with several channels: alpha does not count.
void append_brightest(std::span<const std::uint8_t> samples, int channels, std::vector<std::uint8_t>& out) {
    const auto step = static_cast<std::size_t>(channels);
    const std::size_t colors = channels >= 3 ? 3 : 1;
    for (std::size_t i = 0; i < samples.size(); i += step)
        out.push_back(*std::ranges::max_element(samples.subspan(i, colors)));
}

}  // namespace

MaskSize image_size(const std::string& name, std::string_view bytes, const std::string& where) {
    const OpenImage image(name, bytes, where);
    return {image.spec().width, image.spec().height};
}

MaskImage decode_mask(const std::string& name, std::string_view bytes, MaskSize expected, MaskPacking packing,
                      const std::string& where) {
    OpenImage image(name, bytes, where);
    const bool packed = packing == MaskPacking::in_colors;
    const int channels = image.spec().nchannels;
    if (packed && channels != 3) image.reject("it has no three colours, as the others");
    MaskImage mask{packed ? 3 * image.spec().width : image.spec().width, image.spec().height, {}};
    if (mask.width != expected.width || mask.height != expected.height) {
        throw InputError(fmt::format("{}: the image is of {} x {} px where {} x {} px are expected", where,
                                     mask.width, mask.height, expected.width, expected.height));
    }
    mask.pixels.reserve(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height));
    constexpr int band = 64;  // rows read at once
    std::vector<std::uint8_t> samples;
    for (int row = 0; row < mask.height; row += band) {
        image.read_rows(row, std::min(row + band, mask.height), samples);
        if (packed || channels == 1) {
            mask.pixels.insert(mask.pixels.end(), samples.begin(), samples.end());
        } else {
            append_brightest(samples, channels, mask.pixels);
        }
    }
    return mask;
}

}  // namespace lamella
