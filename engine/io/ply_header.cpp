// Parses the lines of a PLY header.
#include "engine/io/ply_header.h"

namespace lamella::ply {
namespace {

std::optional<Scalar> scalar_named(std::string_view text) {
    using Kind = Scalar::Kind;
    const std::string name = lower_case(text);
    if (name == "char" || name == "int8") return Scalar{1, Kind::signed_integer};
    if (name == "uchar" || name == "uint8") return Scalar{1, Kind::unsigned_integer};
    if (name == "short" || name == "int16") return Scalar{2, Kind::signed_integer};
    if (name == "ushort" || name == "uint16") return Scalar{2, Kind::unsigned_integer};
    if (name == "int" || name == "int32") return Scalar{4, Kind::signed_integer};
    if (name == "uint" || name == "uint32") return Scalar{4, Kind::unsigned_integer};
    if (name == "float" || name == "float32") return Scalar{4, Kind::real};
    if (name == "double" || name == "float64") return Scalar{8, Kind::real};
    return std::nullopt;
}

class HeaderReader {
  public:
    explicit HeaderReader(const MeshSource& source)
        : source_(source),
          text_(source.bytes, source.bytes.size() - without_byte_order_mark(source.bytes).size()) {}

    Header read() {
        text_.skip_line();  // "ply"
        bool has_format = false;
        for (;; text_.skip_line()) {
            if (text_.at_end())
                reject(source_, "the header has no \"end_header\" line; the file is cut off or damaged");
            const std::string_view word = text_.token_on_line();
            const std::string keyword = lower_case(word);
            if (keyword == "end_header") break;
            if (keyword == "format") {
                has_format = take_format();
            } else if (keyword == "element") {
                take_element();
            } else if (keyword == "property") {
                take_property();
            } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
                skip_unknown(word);
            }
        }
        if (!has_format) fail("the header has no \"format\" line");
        header_.data_at = behind_end_header();
        return std::move(header_);
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        reject(source_, "line " + std::to_string(text_.line()) + ": " + what);
    }

    /// Second lines of comments, and what single programs add, hold nothing that is needed.
    void skip_unknown(std::string_view word) {
        constexpr std::size_t most = 1000;
        if (header_.notes.size() == most) fail("more than 1,000 lines that are no PLY header");
        header_.notes.push_back("line " + std::to_string(text_.line()) + " of the header begins with " +
                                excerpt(word) +
                                " and was skipped; known are format, element, property, comment, obj_info "
                                "and end_header");
    }

    bool take_format() {
        const std::string name = lower_case(text_.token_on_line());
        if (name == "ascii") {
            header_.encoding = Encoding::text;
        } else if (name == "binary_little_endian") {
            header_.encoding = Encoding::little_endian;
        } else if (name == "binary_big_endian") {
            header_.encoding = Encoding::big_endian;
        } else {
            fail("unknown format " + excerpt(name) +
                 "; known are ascii, binary_little_endian and binary_big_endian");
        }
        return true;
    }

    void take_element() {
        constexpr std::size_t max_elements = 100;
        Element element;
        element.name = lower_case(text_.token_on_line());
        const std::string_view word = text_.token_on_line();
        const auto count = parse_integer(word);
        if (!count || *count < 0) fail(excerpt(word) + " is no number of elements");
        if (header_.elements.size() == max_elements) fail("more than 100 kinds of element");
        element.count = static_cast<std::size_t>(*count);
        header_.elements.push_back(std::move(element));
    }

    void take_property() {
        constexpr std::size_t max_properties = 1000;
        if (header_.elements.empty()) fail("a property before any element");
        Property property;
        std::string_view type = text_.token_on_line();
        if (same_word(type, "list")) {
            property.count = take_scalar(text_.token_on_line());
            if (property.count->kind == Scalar::Kind::real)
                fail("the length of a list must be of an integer type");
            type = text_.token_on_line();
        }
        property.value = take_scalar(type);
        property.name = std::string(text_.token_on_line());
        auto& properties = header_.elements.back().properties;
        if (properties.size() == max_properties) fail("more than 1,000 properties in one element");
        properties.push_back(std::move(property));
    }

    Scalar take_scalar(std::string_view type) const {
        const auto scalar = scalar_named(type);
        if (!scalar)
            fail(excerpt(type) + " is no PLY type (char, uchar, short, ushort, int, uint, float, double)");
        return *scalar;
    }

    /// Binary data begins right behind the line end. Its form is that of the first line: behind a lone
    /// carriage return, a byte 10 is data already.
    std::size_t behind_end_header() const {
        const std::string_view bytes = source_.bytes;
        std::size_t at = text_.offset();
        while (at < bytes.size() && bytes[at] != '\n' && bytes[at] != '\r') ++at;
        const std::size_t first = bytes.find_first_of("\r\n");
        const bool lone_return = bytes[first] == '\r' && bytes.substr(first + 1, 1) != "\n";
        if (at + 1 < bytes.size() && bytes[at] == '\r' && bytes[at + 1] == '\n' && !lone_return) ++at;
        return std::min(at + 1, bytes.size());
    }

    const MeshSource& source_;
    TextCursor text_;
    Header header_;
};

}  // namespace

Header read_header(const MeshSource& source) { return HeaderReader(source).read(); }

}  // namespace lamella::ply
