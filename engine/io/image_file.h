// Reading and writing images of many formats. The library that does it is large and few runs need it, so it
// is loaded when first asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lamella {

/// How the samples of a page are handed out: 8 and 16 bits as the file has them, other integers scaled to
/// 0..1.
enum class SampleType : unsigned char { u8, u16, f32 };

/// One image of a file.
struct ImagePage {
    int width = 0;   ///< px
    int height = 0;  ///< px
    int depth = 1;   ///< layers of a page that has them
    int channels = 0;
    bool deep = false;  ///< several samples a pixel
    SampleType samples = SampleType::u8;
    std::string stored_as;  ///< the sample's type in the file, for messages
};

/// The pages of a file, front to back.
class ImageReader {
  public:
    virtual ~ImageReader() = default;
    /// Goes to the next page; nothing when there is none, or the file is damaged there.
    virtual std::optional<ImagePage> next_page() = 0;
    /// Reads a channel of the page: width * height samples of its type, the highest row first. Returns what
    /// went wrong, or an empty text.
    virtual std::string read_channel(int channel, void* samples) = 0;
    /// Reads all channels of the page side by side, whatever their type as 8 bits: width * height * channels
    /// samples, the highest row first. Returns what went wrong, or an empty text.
    virtual std::string read_bytes(std::uint8_t* samples) = 0;
};

/// An image to write, 8 bits a channel.
struct ImageData {
    int width = 0;                         ///< px
    int height = 0;                        ///< px
    int channels = 1;                      ///< 1 grey, 3 red green blue, 4 with alpha
    std::span<const std::uint8_t> pixels;  ///< row by row from the top
    double pixel_x = 0, pixel_y = 0;       ///< mm; 0 where the file need not say
    bool linear = false;                   ///< values are amounts, not light: the file says so
    std::string compression{};             ///< in the library's words; empty for the format's own
};

/// The images of a file; null when it is none that can be read.
std::unique_ptr<ImageReader> open_images(const std::string& path);

/// The images of a file in memory, which must outlive the reader. It is read as what the ending of `name`
/// says and as nothing else. Null when it cannot be; `why` then says what is wrong.
std::unique_ptr<ImageReader> open_images(const std::string& name, std::string_view bytes, std::string& why);

/// The bytes of a file of that name, whose ending tells the format. Throws FaultError when that cannot be
/// made.
std::vector<std::byte> encode_image(const std::string& name, const ImageData& image);

/// Whether a file's ending names a format that can be written.
bool is_image_name(const std::string& path);

/// Writes the file. Throws FaultError.
void write_image(const std::string& path, const ImageData& image);

/// What the loaded library provides. Errors are texts: exceptions stay on their side.
class ImageLibrary {
  public:
    virtual ~ImageLibrary() = default;
    virtual std::unique_ptr<ImageReader> open(const std::string& path) const = 0;
    virtual std::unique_ptr<ImageReader> open_bytes(const std::string& name, std::string_view bytes,
                                                    std::string& why) const = 0;
    virtual std::string encode(const std::string& name, const ImageData& image,
                               std::vector<std::byte>& file) const = 0;
    virtual bool knows(const std::string& path) const = 0;
    virtual std::string write(const std::string& path, const ImageData& image) const = 0;
};

/// The module's only symbol.
inline constexpr const char* image_library_symbol = "lamella_image_library";
using ImageLibraryFunction = const ImageLibrary* (*)();

}  // namespace lamella
