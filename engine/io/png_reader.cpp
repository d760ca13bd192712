// libspng behind lamella's own interface. A context decodes once, so each decoding has its own.
#include "engine/io/png_reader.h"

#include <spng.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace lamella {

namespace {

constexpr std::size_t most_chunk_bytes = std::size_t{1} << 26;

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

/// Sets up the decoding of a file. Returns an error message, empty on success.
std::string begin(const Context& context, std::string_view bytes) {
    if (context == nullptr) return "no memory";
    int error = spng_set_chunk_limits(context.get(), most_chunk_bytes, most_chunk_bytes);
    if (error == 0) error = spng_set_png_buffer(context.get(), bytes.data(), bytes.size());
    return error == 0 ? "" : spng_strerror(error);
}

/// How a file's pixels are asked for.
struct Layout {
    int channels = 1;
    int format = SPNG_FMT_PNG;  ///< of libspng
    int flags = 0;              ///< of libspng
};

Layout layout_of(const spng_ihdr& header, bool has_transparent) {
    const int trns = has_transparent ? SPNG_DECODE_TRNS : 0;
    const bool wide = header.bit_depth > 8;
    switch (header.color_type) {
        case SPNG_COLOR_TYPE_GRAYSCALE:
            if (has_transparent) return {2, wide ? SPNG_FMT_GA16 : SPNG_FMT_GA8, trns};
            return {1, wide ? SPNG_FMT_PNG : SPNG_FMT_G8, 0};
        case SPNG_COLOR_TYPE_TRUECOLOR:
            if (has_transparent) return {4, wide ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8, trns};
            return {3, SPNG_FMT_PNG, 0};
        case SPNG_COLOR_TYPE_INDEXED:
            if (has_transparent) return {4, SPNG_FMT_RGBA8, trns};
            return {3, SPNG_FMT_RGB8, 0};
        case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA:
            return {2, SPNG_FMT_PNG, 0};
        default:
            return {4, SPNG_FMT_PNG, 0};
    }
}

class PngReader : public ImageReader {
  public:
    PngReader(std::string_view bytes, const spng_ihdr& header, bool has_transparent)
        : bytes_(bytes),
          layout_(layout_of(header, has_transparent)),
          sample_bytes_(header.bit_depth > 8 ? 2 : 1) {
        page_.width = static_cast<int>(header.width);
        page_.height = static_cast<int>(header.height);
        page_.channels = layout_.channels;
        page_.samples = sample_bytes_ == 2 ? SampleType::u16 : SampleType::u8;
        page_.stored_as = sample_bytes_ == 2 ? "uint16" : "uint8";
        page_.alpha = layout_.channels % 2 == 0 ? layout_.channels - 1 : -1;
    }

    std::optional<ImagePage> next_page() override {
        if (std::exchange(is_past_, true)) return {};
        return page_;
    }

    std::string read_channel(int channel, void* samples) override {
        if (layout_.channels == 1) return decode(samples);
        if (std::string why = keep_pixels(); !why.empty()) return why;
        const std::size_t step = sample_bytes_ * static_cast<std::size_t>(layout_.channels);
        const std::uint8_t* from = pixels_.data() + sample_bytes_ * static_cast<std::size_t>(channel);
        auto* to = static_cast<std::uint8_t*>(samples);
        for (std::size_t i = 0; i < pixels_.size() / step; ++i)
            std::memcpy(to + i * sample_bytes_, from + i * step, sample_bytes_);
        return "";
    }

    std::string read_bytes(std::uint8_t* samples) override {
        if (sample_bytes_ == 1) return decode(samples);
        if (std::string why = keep_pixels(); !why.empty()) return why;
        constexpr std::uint32_t most = 65535, most_byte = 255;
        for (std::size_t i = 0; i < pixels_.size() / 2; ++i) {
            std::uint16_t sample = 0;
            std::memcpy(&sample, pixels_.data() + 2 * i, 2);
            samples[i] = static_cast<std::uint8_t>((sample * most_byte + most / 2) / most);
        }
        return "";
    }

  private:
    std::size_t size() const {
        return static_cast<std::size_t>(page_.width) * static_cast<std::size_t>(page_.height) *
               static_cast<std::size_t>(layout_.channels) * sample_bytes_;
    }

    /// Decodes all samples. Returns an error message, empty on success.
    std::string decode(void* samples) const {
        const Context context(spng_ctx_new(0), &spng_ctx_free);
        if (std::string why = begin(context, bytes_); !why.empty()) return why;
        int error = spng_decode_image(context.get(), samples, size(), layout_.format, layout_.flags);
        if (error == 0) error = spng_decode_chunks(context.get());  // what follows the pixels is whole, too
        return error == 0 ? "" : spng_strerror(error);
    }

    /// Decodes all samples, unless this has been done.
    std::string keep_pixels() {
        if (!pixels_.empty()) return "";
        std::vector<std::uint8_t> pixels(size());
        std::string why = decode(pixels.data());
        if (why.empty()) pixels_ = std::move(pixels);
        return why;
    }

    std::string_view bytes_;
    Layout layout_;
    std::size_t sample_bytes_;
    ImagePage page_;
    bool is_past_ = false;
    std::vector<std::uint8_t> pixels_;  // of all channels, interleaved
};

struct KeptBytes {
    std::string kept;
};

/// A reader with the bytes that it reads.
class KeptPngReader : private KeptBytes, public PngReader {
  public:
    KeptPngReader(std::string bytes, const spng_ihdr& header, bool has_transparent)
        : KeptBytes{std::move(bytes)}, PngReader(kept, header, has_transparent) {}
};

/// Reads the header of a file. Returns an error message, empty on success.
std::string read_header(std::string_view bytes, spng_ihdr& header, bool& has_transparent) {
    const Context context(spng_ctx_new(0), &spng_ctx_free);
    if (std::string why = begin(context, bytes); !why.empty()) return why;
    if (const int error = spng_get_ihdr(context.get(), &header); error != 0) return spng_strerror(error);
    spng_trns transparent{};
    const int error = spng_get_trns(context.get(), &transparent);
    has_transparent = error == 0;
    return has_transparent || error == SPNG_ECHUNKAVAIL ? "" : spng_strerror(error);
}

}  // namespace

std::unique_ptr<ImageReader> open_png(std::string_view bytes, std::string& why) {
    spng_ihdr header{};
    bool has_transparent = false;
    why = read_header(bytes, header, has_transparent);
    if (!why.empty()) return nullptr;
    return std::make_unique<PngReader>(bytes, header, has_transparent);
}

std::unique_ptr<ImageReader> open_kept_png(std::string bytes, std::string& why) {
    spng_ihdr header{};
    bool has_transparent = false;
    why = read_header(bytes, header, has_transparent);
    if (!why.empty()) return nullptr;
    return std::make_unique<KeptPngReader>(std::move(bytes), header, has_transparent);
}

}  // namespace lamella
