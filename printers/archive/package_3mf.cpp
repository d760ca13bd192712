// The parts before the model, box meshes and XML escaping.
#include "printers/archive/package_3mf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "engine/base/number_format.h"

namespace lamella {
namespace {

/// Returns the length of the valid UTF-8 character at the start of the text, bytes; 0 if there is none that
/// XML permits.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
    std::uint32_t code = first & (0xffU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0U) != 0x80) return 0;
        code = code << 6U | (byte(i) & 0x3fU);
    }
    const bool overlong = code < (length == 2 ? 0x80U : length == 3 ? 0x800U : 0x10000U);
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    return overlong || surrogate || code > 0x10ffff || code == 0xfffe || code == 0xffff ? 0 : length;
}

}  // namespace

void begin_model(ZipWriter& zip) {
    zip.begin_entry("[Content_Types].xml");
    zip.write(package_content_types);
    zip.begin_entry("_rels/.rels");
    zip.write(package_relationships);
    zip.begin_entry("3D/3dmodel.model");
}

std::string box_mesh(const Box& box, int plane_decimals, int height_decimals) {
    std::string text = "<mesh>\n<vertices>\n";
    for (unsigned corner = 0; corner < 8; ++corner) {
        text += fmt::format("<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n",
                            format_number(corner & 1U ? box.hi.x : box.lo.x, plane_decimals),
                            format_number(corner & 2U ? box.hi.y : box.lo.y, plane_decimals),
                            format_number(corner & 4U ? box.hi.z : box.lo.z, height_decimals));
    }
    text += "</vertices>\n<triangles>\n";
    // Bits of a corner's number: 1 for the far side in x, 2 in y, 4 in z.
    for (const char* triangle :
         {"023", "031", "457", "476", "015", "054", "267", "273", "046", "062", "137", "175"}) {
        text +=
            fmt::format("<triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n", triangle[0], triangle[1], triangle[2]);
    }
    return text + "</triangles>\n</mesh>\n";
}

std::string xml_attribute(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 1 && text[0] == '&') {
            out += "&amp;";
        } else if (length == 1 && text[0] == '<') {
            out += "&lt;";
        } else if (length == 1 && text[0] == '"') {
            out += "&quot;";
        } else {
            out += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return out;
}

}  // namespace lamella
