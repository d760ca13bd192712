// GOO files (vendor's specification V1.2, 2023): a header of fixed size, run-length coded layers, a footer.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "engine/base/error.h"
#include "printers/readers/job_number.h"
#include "printers/readers/job_readers.h"

namespace lamella {
namespace {

constexpr std::string_view goo_file_magic("\x07\x00\x00\x00\x44\x4c\x50\x00", 8);
constexpr std::size_t small_preview_bytes = std::size_t{116} * 116 * 2,
                      large_preview_bytes = std::size_t{290} * 290 * 2;
constexpr std::size_t header_bytes = 195477;
constexpr std::size_t layer_header_bytes = 70;  // including the size of the code
constexpr std::size_t end_bytes = 3 + 8;

/// Reads big-endian numbers. The caller ensures that there are enough bytes.
class BigEndianReader {
  public:
    explicit BigEndianReader(std::string_view bytes) : left_(bytes) {}
    std::uint32_t number(int bytes) {
        std::uint32_t value = 0;
        for (const char c : take(static_cast<std::size_t>(bytes)))
            value = value << 8U | static_cast<unsigned char>(c);
        return value;
    }
    double real() { return std::bit_cast<float>(number(4)); }
    void skip(std::size_t bytes) { take(bytes); }
    std::string_view take(std::size_t bytes) {
        const std::string_view taken = left_.substr(0, bytes);
        left_.remove_prefix(bytes);
        return taken;
    }
    /// Returns the text up to the first zero byte, without characters that cannot be displayed.
    std::string text(std::size_t bytes) {
        std::string text;
        for (const char c : take(bytes)) {
            if (c == '\0') break;
            if (c >= ' ' && c <= '~') text += c;
        }
        return text;
    }

  private:
    std::string_view left_;
};

/// Decodes a layer's code into a mask. Its errors do not name the file.
class GooDecoder {
  public:
    GooDecoder(std::string_view code, std::size_t pixels) : code_(code), pixels_(pixels) {}

    std::vector<std::uint8_t> decode() {
        // Layout: a start byte, chunks, and the inverted sum of the chunks' bytes.
        if (code_.size() < 2 || code_[0] != '\x55') throw InputError("its code does not begin with 55");
        unsigned sum = 0;
        for (const char c : code_.substr(1, code_.size() - 2)) sum += static_cast<unsigned char>(c);
        if ((~sum & 0xffU) != static_cast<unsigned char>(code_.back()))
            throw InputError("the checksum of its code is wrong");
        code_ = code_.substr(1, code_.size() - 2);
        std::vector<std::uint8_t> out;
        out.reserve(pixels_);
        while (at_ < code_.size()) chunk(out);
        if (out.size() != pixels_) {
            throw InputError(fmt::format("its code makes {} pixels, the image has {}", out.size(), pixels_));
        }
        return out;
    }

  private:
    unsigned byte() {
        if (at_ >= code_.size()) throw InputError("its code ends within a run");
        return static_cast<unsigned char>(code_[at_++]);
    }

    void chunk(std::vector<std::uint8_t>& out) {
        enum Kind : unsigned { black, grey, difference, white };
        const unsigned head = byte();
        std::uint64_t length = 1;
        if (head >> 6U == difference) {
            const unsigned step = head & 0xfU;
            value_ = ((head & 0x20U) != 0 ? value_ - step : value_ + step) & 0xffU;
            if ((head & 0x10U) != 0) length = byte();
        } else {
            if (head >> 6U == black) value_ = 0;
            if (head >> 6U == white) value_ = 255;
            if (head >> 6U == grey) value_ = byte();
            // The lowest 4 bits are in the first byte, the others follow, the highest first.
            std::uint64_t high = 0;
            for (unsigned more = head >> 4U & 3U; more > 0; --more) high = high << 8U | byte();
            length = high << 4U | (head & 0xfU);
        }
        if (length > pixels_ - out.size()) throw InputError("a run of its code goes beyond the image");
        out.insert(out.end(), static_cast<std::size_t>(length), static_cast<std::uint8_t>(value_));
    }

    std::string_view code_;
    std::size_t pixels_;
    std::size_t at_ = 0;
    unsigned value_ = 0;
};

class GooFile : public JobFile {
  public:
    explicit GooFile(const std::string& path) : path_(path), in_(path, std::ios::binary) {
        std::error_code error;
        size_ = std::filesystem::file_size(path, error);
        if (!in_ || error) throw InputError(path + ": cannot be opened");
        read_header();
        find_layers();
        in_.close();
    }

    MaskImage layer(int index) const override {
        const Place& place = places_.at(static_cast<std::size_t>(index));
        std::ifstream in(path_, std::ios::binary);
        const std::string code = read(in, place.at, place.size, index);
        MaskImage mask{facts_.width, facts_.height, {}};
        try {
            mask.pixels =
                GooDecoder(code, static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height))
                    .decode();
        } catch (const InputError& wrong) {
            reject(index, wrong.what());
        }
        if (sixteen_greys_) {
            for (std::uint8_t& grey : mask.pixels) {
                if (grey > 15) reject(index, "it has greys beyond the 16 that the header allows");
                grey = static_cast<std::uint8_t>(grey * 17);
            }
        }
        return mask;
    }

  private:
    struct Place {
        std::uint64_t at;
        std::uint32_t size;
    };

    [[noreturn]] void reject(const std::string& why) const { throw InputError(path_ + ": " + why); }
    [[noreturn]] void reject(int layer, const std::string& why) const {
        reject(fmt::format("layer {}: {}", layer, why));
    }

    std::string read(std::ifstream& in, std::uint64_t at, std::size_t count, int layer) const {
        if (at > size_ || count > size_ - at)
            reject(layer, "it goes beyond the end of the file, which is cut off");
        std::string bytes(count, '\0');
        in.seekg(static_cast<std::streamoff>(at));
        if (!in.read(bytes.data(), static_cast<std::streamsize>(count))) reject(layer, "it cannot be read");
        return bytes;
    }

    void read_header() {
        if (size_ < header_bytes) {
            reject(fmt::format("a GOO file has a header of {} bytes, and this one ends after {}",
                               header_bytes, size_));
        }
        std::string bytes(header_bytes, '\0');
        if (!in_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) reject("cannot be read");
        BigEndianReader in(bytes);
        facts_.format = "GOO file " + in.text(4);
        in.skip(goo_file_magic.size());
        facts_.program = in.text(32);
        const std::string version = in.text(24);
        if (!version.empty()) facts_.program += " " + version;
        in.skip(24);  // time
        facts_.machine = in.text(32);
        in.skip(32);  // machine type
        facts_.material = in.text(32);
        in.skip(6 + small_preview_bytes + 2 + large_preview_bytes + 2);
        facts_.layers = checked_layers(in.number(4));
        facts_.width = static_cast<int>(in.number(2));
        facts_.height = static_cast<int>(in.number(2));
        if (facts_.width < 1 || facts_.height < 1 ||
            std::int64_t{facts_.width} * facts_.height > max_mask_pixels) {
            reject(fmt::format("its masks are said to be of {} x {} px, which no display is", facts_.width,
                               facts_.height));
        }
        in.skip(2);  // mirrored or not
        if (const auto x = fact(in)) facts_.pixel_x = *x / facts_.width;
        if (const auto y = fact(in)) facts_.pixel_y = *y / facts_.height;
        in.skip(4);  // height of the machine
        facts_.layer_height = fact(in);
        facts_.exposure = fact(in);
        in.skip(1 + std::size_t{7} * 4);  // waits
        facts_.first_exposure = fact(in);
        facts_.first_layers = count_or_none(in.number(4));
        in.skip(std::size_t{16} * 4 + 2 + 2 + 1);  // moves, power
        facts_.print_time = positive_or_none(in.number(4));
        facts_.volume = fact(in);
        in.skip(4 + 4 + 8);  // weight, price, its unit
        content_ = in.number(4);
        if (content_ < header_bytes || content_ > size_)
            reject(fmt::format("its layers are said to begin at byte {}, which they cannot", content_));
        sixteen_greys_ = in.number(1) == 0;
        facts_.fade_layers = count_or_none(in.number(2));
    }

    /// Numbers have single precision. Rounding to seven digits gives 0.05 instead of 0.05000000074505806.
    static std::optional<double> fact(BigEndianReader& in) {
        const double value = in.real();
        return positive_or_none(parse_number(fmt::format("{:.7g}", value)));
    }

    int checked_layers(std::uint32_t count) const {
        const std::uint64_t most = (size_ - header_bytes) / (layer_header_bytes + 2 + 2);
        if (count == 0) reject("it has no layers");
        if (count > most || count > 1'000'000) {
            reject(fmt::format("it is said to have {} layers, for which its {} bytes are too few", count,
                               size_));
        }
        return static_cast<int>(count);
    }

    /// Locates the layers, which follow each other, each with the size of its code.
    void find_layers() {
        places_.reserve(static_cast<std::size_t>(facts_.layers));
        std::vector<EqualLayers> heights;
        double below = 0;
        std::uint64_t at = content_;
        for (int k = 0; k < facts_.layers; ++k) {
            const std::string bytes = read(in_, at, layer_header_bytes, k);
            if (std::string_view(bytes).substr(layer_header_bytes - 6, 2) != "\r\n")
                reject(k, "its description does not end where it should");
            const double top = BigEndianReader(std::string_view(bytes).substr(6)).real();
            constexpr double grains = 1e4;  // in a mm; positions have single precision
            heights.push_back({1, std::round((top - below) * grains) / grains});
            below = top;
            const std::uint32_t size = BigEndianReader(std::string_view(bytes).substr(66)).number(4);
            at += layer_header_bytes;
            if (size > size_ - at) reject(k, "it goes beyond the end of the file, which is cut off");
            places_.push_back({at, size});
            at += size;
            if (read(in_, at, 2, k) != "\r\n") reject(k, "its code does not end where it should");
            at += 2;
        }
        const auto is_height = [](const EqualLayers& layer) {
            return layer.height > 0 && layer.height < 100;
        };
        if (std::ranges::all_of(heights, is_height)) {
            const LayerPlan plan(heights);
            if (!plan.equal()) facts_.heights = plan;
        }
        if (facts_.heights.count() > 0) facts_.layer_height.reset();
        const bool whole = size_ - at >= end_bytes &&
                           read(in_, at + 3, goo_file_magic.size(), facts_.layers) == goo_file_magic;
        if (!whole) reject("its end is missing; the file is cut off");
    }

    std::string path_;
    std::ifstream in_;
    std::uint64_t size_ = 0;
    std::uint64_t content_ = 0;
    bool sixteen_greys_ = false;
    std::vector<Place> places_;
};

}  // namespace

bool begins_as_goo(std::string_view bytes) {
    return bytes.size() >= 12 && bytes.substr(4, 8) == goo_file_magic;
}

std::unique_ptr<JobFile> read_goo(const std::string& path) { return std::make_unique<GooFile>(path); }

}  // namespace lamella
