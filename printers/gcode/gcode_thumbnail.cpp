// Encodes PNG pictures in base64 comments.
#include "printers/gcode/gcode_thumbnail.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "printers/common/thumbnail.h"

namespace lamella {
namespace {

constexpr int large = 300, small = 32;  // px
constexpr std::size_t longest = 78;     // base64 characters per line

std::string block(const Picture& picture) {
    const std::string text = base64(png_file(picture));
    std::string out = fmt::format("; thumbnail begin {}x{} {}\n", picture.width, picture.height, text.size());
    for (std::size_t at = 0; at < text.size(); at += longest) out += "; " + text.substr(at, longest) + "\n";
    return out + "; thumbnail end\n";
}

}  // namespace

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::string_view three = bytes.substr(at, 3);
        std::array<std::uint32_t, 3> b{};
        for (std::size_t i = 0; i < three.size(); ++i) b[i] = static_cast<unsigned char>(three[i]);
        const std::uint32_t bits = b[0] << 16U | b[1] << 8U | b[2];
        for (std::size_t i = 0; i < 4; ++i)
            out += i <= three.size() ? digits[bits >> (18 - 6 * i) & 63U] : '=';
    }
    return out;
}

std::string gcode_thumbnails(const std::function<Picture(int size)>& picture) {
    if (!picture) return "";
    const Picture drawn = picture(large);
    if (drawn.width <= 0) return "";
    return block(drawn) + block(shrunk(drawn, small));
}

}  // namespace lamella
