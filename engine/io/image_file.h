// Reads and writes images of many formats. The library behind all but reading PNG is large and few runs need
// it, so it is loaded on first use.
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

/// Type of the samples that a reader returns: 8 and 16 bits as in the file, other integers scaled to 0..1.
enum class SampleType : unsigned char { u8, u16, f32 };

/// One image of a file.
struct ImagePage {
    int width = 0;   ///< px
    int height = 0;  ///< px
    int depth = 1;   ///< layers of a volumetric page
    int channels = 0;
    bool deep = false;  ///< several samples a pixel
    SampleType samples = SampleType::u8;
    std::string stored_as;  ///< sample type in the file, for messages
    int alpha = -1;         ///< channel that says how opaque a pixel is; negative if there is none
};

/// Iterates over the pages of a file, from first to last.
class ImageReader {
  public:
    virtual ~ImageReader() = default;
    /// Moves to the next page; returns nothing when there is none, or the file is damaged there.
    virtual std::optional<ImagePage> next_page() = 0;
    /// Reads a channel of the page: width * height samples of its type, the highest row first. Returns an
    /// error message, empty on success.
    virtual std::string read_channel(int channel, void* samples) = 0;
    /// Reads all channels of the page, interleaved, converted to 8 bits: width * height * channels samples,
    /// the highest row first. Returns an error message, empty on success.
    virtual std::string read_bytes(std::uint8_t* samples) = 0;
};

/// An image to write, 8 bits a channel.
struct ImageData {
    int width = 0;                         ///< px
    int height = 0;                        ///< px
    int channels = 1;                      ///< 1 grey, 3 red green blue, 4 with alpha
    std::span<const std::uint8_t> pixels;  ///< row by row from the top
    double pixel_x = 0, pixel_y = 0;       ///< mm; 0 if the file need not say
    bool linear = false;        ///< values are linear amounts, not display values: the file says so
    std::string compression{};  ///< name of the method in the library; empty for the format's default
};

/// Opens the images of a file; returns null when it cannot be read.
std::unique_ptr<ImageReader> open_images(const std::string& path);

/// Opens the images of a file in memory, which must outlive the reader. The ending of `name` alone decides
/// the format. Returns null when the file cannot be read; `why` then says what is wrong.
std::unique_ptr<ImageReader> open_images(const std::string& name, std::string_view bytes, std::string& why);

/// Returns the bytes of a file of that name, whose ending decides the format. Throws FaultError when encoding
/// fails.
std::vector<std::byte> encode_image(const std::string& name, const ImageData& image);

/// Returns true if a file's ending names a format that can be written.
bool is_image_name(const std::string& path);

/// Writes the file. Throws FaultError when this fails.
void write_image(const std::string& path, const ImageData& image);

/// Interface of the loaded library. Errors are strings, because exceptions must not leave the module.
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

/// The only symbol that the module exports.
inline constexpr const char* image_library_symbol = "lamella_image_library";
using ImageLibraryFunction = const ImageLibrary* (*)();

}  // namespace lamella
