// One solid, written in every dialect of the mesh formats, for the corpus of tests/engine/io/.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <string>
#include <vector>

#include "tests/engine/io/package_samples.h"
#include "tests/engine/mesh/mesh_samples.h"

namespace lamella::samples {

/// How the text of a file is laid out.
struct TextStyle {
    std::string end = "\n";   ///< of lines
    std::string blank = " ";  ///< between words
    bool capitals = false;
    std::string before = "";  ///< in front of everything
};

/// Returns the text in a style: written with line feeds and single blanks.
inline std::string styled(const std::string& text, const TextStyle& style) {
    std::string out = style.before;
    for (const char c : text) {
        if (c == '\n') {
            out += style.end;
        } else if (c == ' ') {
            out += style.blank;
        } else {
            out += style.capitals ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        }
    }
    return out;
}

struct NamedStyle {
    const char* name;
    TextStyle style;
};

inline std::vector<NamedStyle> text_styles() {
    return {{"line feeds", {}},
            {"carriage returns and line feeds", {"\r\n"}},
            {"carriage returns", {"\r"}},
            {"tabs", {"\n", "\t"}},
            {"several blanks, also at the ends of lines", {" \t \n", "  \t "}},
            {"blank lines", {"\n\n \n"}},
            {"capitals", {"\n", " ", true}},
            {"a byte order mark", {"\n", " ", false, "\xef\xbb\xbf"}},
            {"a byte order mark, capitals and carriage returns", {"\r", " ", true, "\xef\xbb\xbf"}}};
}

/// Number types of PLY, with how they are written.
class PlyBody {
  public:
    enum class Form { ascii, little, big };
    explicit PlyBody(Form form) : form_(form) {}

    template <typename T>
    PlyBody& put(T value) {
        if (form_ == Form::ascii) {
            if (!row_.empty()) row_ += " ";
            row_ += number(static_cast<double>(value));
            return *this;
        }
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);  // little-endian machines only, as all that this runs on
        if (form_ == Form::big) std::reverse(raw, raw + sizeof value);
        bytes_.append(raw, sizeof value);
        return *this;
    }
    void end_row() {
        if (form_ == Form::ascii) bytes_ += row_ + "\n";
        row_.clear();
    }
    const std::string& bytes() const { return bytes_; }
    static const char* name(Form form) {
        const char* const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
        return names[static_cast<int>(form)];
    }

  private:
    Form form_;
    std::string bytes_, row_;
};

/// An entry of a ZIP archive, written by hand: what archivers do beside the plain form.
struct ZipVariant {
    bool deflated = true;
    bool descriptor = false;           ///< sizes and checksum follow the data (bit 3)
    bool descriptor_signature = true;  ///< with its optional signature
    std::string extra_field = "";      ///< of the local header
    std::string comment = "";          ///< at the end of the archive
    std::string leading = "";          ///< bytes in front of the archive
};

inline std::string zip_by_hand(const std::vector<std::pair<std::string, std::string>>& parts,
                               const ZipVariant& variant) {
    std::string out = variant.leading, directory;
    const auto put = [](std::string& to, std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i) to += static_cast<char>(value >> (8 * i) & 0xffU);
    };
    for (const auto& [name, content] : parts) {
        std::string packed = content;
        if (variant.deflated) {
            z_stream stream{};
            REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) == Z_OK);
            packed.assign(deflateBound(&stream, content.size()), '\0');
            std::string copy = content;
            stream.next_in = reinterpret_cast<Bytef*>(copy.data());
            stream.avail_in = static_cast<uInt>(copy.size());
            stream.next_out = reinterpret_cast<Bytef*>(packed.data());
            stream.avail_out = static_cast<uInt>(packed.size());
            REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
            packed.resize(stream.total_out);
            deflateEnd(&stream);
        }
        const auto checksum = static_cast<std::uint32_t>(
            crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
        const auto sizes = [&](std::string& to, bool known) {
            put(to, known ? checksum : 0, 4);
            put(to, known ? static_cast<std::uint32_t>(packed.size()) : 0, 4);
            put(to, known ? static_cast<std::uint32_t>(content.size()) : 0, 4);
        };
        const auto head = [&](std::string& to, bool known) {
            put(to, variant.descriptor ? 8 : 0, 2);
            put(to, variant.deflated ? 8 : 0, 2);
            put(to, 0x5a210000U, 4);  // time and date
            sizes(to, known);
            put(to, static_cast<std::uint32_t>(name.size()), 2);
        };
        const auto offset = static_cast<std::uint32_t>(out.size() - variant.leading.size());
        put(out, 0x04034b50U, 4);
        put(out, 20, 2);
        head(out, !variant.descriptor);
        put(out, static_cast<std::uint32_t>(variant.extra_field.size()), 2);
        out += name + variant.extra_field + packed;
        if (variant.descriptor) {
            if (variant.descriptor_signature) put(out, 0x08074b50U, 4);
            sizes(out, true);
        }
        put(directory, 0x02014b50U, 4);
        put(directory, 20, 2);
        put(directory, 20, 2);
        head(directory, true);
        put(directory, 0, 2 + 2);  // extra field, comment
        put(directory, 0, 2);
        put(directory, 0, 2);  // disk
        put(directory, 0, 4);
        put(directory, offset, 4);
        directory += name;
    }
    const auto begin = static_cast<std::uint32_t>(out.size() - variant.leading.size());
    out += directory;
    put(out, 0x06054b50U, 4);
    put(out, 0, 4);
    put(out, static_cast<std::uint32_t>(parts.size()), 2);
    put(out, static_cast<std::uint32_t>(parts.size()), 2);
    put(out, static_cast<std::uint32_t>(directory.size()), 4);
    put(out, begin, 4);
    put(out, static_cast<std::uint32_t>(variant.comment.size()), 2);
    return out + variant.comment;
}

}  // namespace lamella::samples
