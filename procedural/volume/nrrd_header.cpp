// Parses lines of "field: value" into a checked header.
#include "procedural/volume/nrrd_header.h"

#include <algorithm>
#include <istream>
#include <map>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/io/mesh_source.h"
#include "procedural/volume/volume.h"

namespace lamella {
namespace {

/// A field's value and its line number.
struct HeaderField {
    std::string value;
    std::size_t line = 0;
};

std::string_view trim_blanks(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == text.npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

std::vector<std::string_view> words(std::string_view text) {
    std::vector<std::string_view> out;
    TextCursor cursor(text);
    for (std::string_view word = cursor.token(); !word.empty(); word = cursor.token()) out.push_back(word);
    return out;
}

/// All fields of the format, spelt without spaces. Those that do not affect the samples or their positions
/// are ignored.
constexpr std::string_view fields[] = {
    "dimension",       "type",       "blocksize",   "encoding",       "endian",
    "content",         "min",        "max",         "oldmin",         "oldmax",
    "datafile",        "lineskip",   "byteskip",    "number",         "sampleunits",
    "sizes",           "spacings",   "thicknesses", "axismins",       "axismaxs",
    "centers",         "centerings", "labels",      "units",          "kinds",
    "space",           "spaceunits", "spaceorigin", "spacedimension", "spacedirections",
    "measurementframe"};

NrrdType type_named(const std::string& name, bool& known) {
    static const std::map<std::string, NrrdType> types = {
        {"signed char", NrrdType::int8},
        {"int8", NrrdType::int8},
        {"int8_t", NrrdType::int8},
        {"uchar", NrrdType::uint8},
        {"unsigned char", NrrdType::uint8},
        {"uint8", NrrdType::uint8},
        {"uint8_t", NrrdType::uint8},
        {"short", NrrdType::int16},
        {"short int", NrrdType::int16},
        {"signed short", NrrdType::int16},
        {"signed short int", NrrdType::int16},
        {"int16", NrrdType::int16},
        {"int16_t", NrrdType::int16},
        {"ushort", NrrdType::uint16},
        {"unsigned short", NrrdType::uint16},
        {"unsigned short int", NrrdType::uint16},
        {"uint16", NrrdType::uint16},
        {"uint16_t", NrrdType::uint16},
        {"int", NrrdType::int32},
        {"signed int", NrrdType::int32},
        {"int32", NrrdType::int32},
        {"int32_t", NrrdType::int32},
        {"uint", NrrdType::uint32},
        {"unsigned int", NrrdType::uint32},
        {"uint32", NrrdType::uint32},
        {"uint32_t", NrrdType::uint32},
        {"longlong", NrrdType::int64},
        {"long long", NrrdType::int64},
        {"long long int", NrrdType::int64},
        {"signed long long", NrrdType::int64},
        {"signed long long int", NrrdType::int64},
        {"int64", NrrdType::int64},
        {"int64_t", NrrdType::int64},
        {"ulonglong", NrrdType::uint64},
        {"unsigned long long", NrrdType::uint64},
        {"unsigned long long int", NrrdType::uint64},
        {"uint64", NrrdType::uint64},
        {"uint64_t", NrrdType::uint64},
        {"float", NrrdType::real32},
        {"double", NrrdType::real64},
    };
    const auto found = types.find(name);
    known = found != types.end();
    return known ? found->second : NrrdType::uint8;
}

class HeaderReader {
  public:
    HeaderReader(std::istream& in, const std::string& name) : in_(in), name_(name) {}

    NrrdHeader read() {
        take_magic();
        while (take_line()) {
        }
        interpret();
        return std::move(header_);
    }

  private:
    [[noreturn]] void fail(std::size_t line, const std::string& what) const {
        throw InputError(name_ + ":" + std::to_string(line) + ": " + what);
    }

    const HeaderField* find(const std::string& field) const {
        const auto found = fields_.find(field);
        return found == fields_.end() ? nullptr : &found->second;
    }

    const HeaderField& demand(const std::string& field) const {
        const HeaderField* found = find(field);
        if (!found) throw InputError(name_ + ": the NRRD header lacks the field \"" + field + "\"");
        return *found;
    }

    /// Reads the next line without its end; returns false at the end of the file.
    bool next_line(std::string& text) {
        constexpr std::size_t largest_header = std::size_t{1} << 20U;
        text.clear();
        ++line_;
        const auto end = std::istream::traits_type::eof();
        for (int c = in_.get(); c != '\n'; c = in_.get()) {
            if (c == end) return !text.empty();
            text.push_back(static_cast<char>(c));
            if (++length_ > largest_header) fail(line_, "the NRRD header is longer than 1 MiB");
        }
        if (!text.empty() && text.back() == '\r') text.pop_back();
        return true;
    }

    void take_magic() {
        std::string text;
        next_line(text);
        const bool numbered =
            text.size() == 8 && text.starts_with("NRRD000") && text[7] >= '1' && text[7] <= '6';
        if (numbered || text == "NRRD00.01") return;
        fail(1, excerpt(text) + " is no NRRD magic (NRRD0001 to NRRD0006)");
    }

    bool take_line() {
        std::string text;
        if (!next_line(text) || text.empty()) return false;
        if (text.front() == '#') return true;
        const std::size_t colon = text.find(':');
        if (colon == text.npos)
            fail(line_, excerpt(text) + " is neither a field (name: value) nor a comment (#)");
        if (text.substr(colon, 2) == ":=") return true;  // a user-defined key
        std::string field = lower_case(trim_blanks(std::string_view(text).substr(0, colon)));
        field.erase(std::remove(field.begin(), field.end(), ' '), field.end());
        if (std::find(std::begin(fields), std::end(fields), field) == std::end(fields)) {
            fail(line_, excerpt(text.substr(0, colon)) + " is no field of the NRRD format");
        }
        const std::string value(trim_blanks(std::string_view(text).substr(colon + 1)));
        if (!fields_.insert({field, {value, line_}}).second) {
            fail(line_, "the field " + excerpt(text.substr(0, colon)) + " stands in the header twice");
        }
        return !(field == "datafile" && value.starts_with("LIST"));  // LIST ends the header
    }

    void interpret() {
        take_type();
        take_encoding();
        take_sizes();
        take_data_file();
        if (sample_bytes(header_.type) > 1 && header_.encoding != NrrdEncoding::text) take_endian();
        header_.line_skip = whole_number("lineskip", 0);
        header_.byte_skip = whole_number("byteskip", -1);
        if (header_.byte_skip < 0 && header_.encoding != NrrdEncoding::raw) {
            fail(find("byteskip")->line, "byte skip can be -1 for the encoding raw only");
        }
        take_box();
    }

    void take_type() {
        const HeaderField& field = demand("type");
        bool known = false;
        header_.type = type_named(lower_case(field.value), known);
        if (known) return;
        fail(field.line, excerpt(field.value) +
                             " is no type that is read (int8, uint8, int16, uint16, int32, "
                             "uint32, int64, uint64, float, double)");
    }

    void take_encoding() {
        const HeaderField& field = demand("encoding");
        const std::string name = lower_case(field.value);
        if (name == "raw") {
            header_.encoding = NrrdEncoding::raw;
        } else if (name == "ascii" || name == "text" || name == "txt") {
            header_.encoding = NrrdEncoding::text;
        } else if (name == "gzip" || name == "gz") {
            header_.encoding = NrrdEncoding::gzip;
        } else {
            fail(field.line,
                 "the encoding " + excerpt(field.value) + " is not read; known are raw, ascii and gzip");
        }
    }

    void take_sizes() {
        const HeaderField& dimension = demand("dimension");
        const HeaderField& field = demand("sizes");
        const auto count = parse_integer(dimension.value);
        if (!count || (*count != 3 && *count != 4)) {
            fail(dimension.line, "the dimension must be 3 (or 4 with a first axis of size 1), not " +
                                     excerpt(dimension.value));
        }
        axes_ = static_cast<std::size_t>(*count);
        const auto sizes = words(field.value);
        if (sizes.size() != axes_) {
            fail(field.line, "there must be " + std::to_string(axes_) +
                                 " sizes, as the dimension says, not " + std::to_string(sizes.size()));
        }
        for (std::size_t i = 0; i < axes_; ++i) {
            const auto size = parse_integer(sizes[i]);
            if (!size || *size < 1) fail(field.line, excerpt(sizes[i]) + " is no size of an axis");
            if (axes_ == 4 && i == 0) {
                if (*size != 1) fail(field.line, "of 4 axes the first must have size 1: one number a voxel");
                continue;
            }
            header_.size[i + 3 - axes_] = static_cast<std::size_t>(*size);
        }
        check_volume_size(header_.size, sample_bytes(header_.type), name_);
    }

    void take_data_file() {
        const HeaderField* field = find("datafile");
        if (!field) return;
        if (field->value.empty()) fail(field->line, "the data file has no name");
        if (field->value.starts_with("LIST") || field->value.find('%') != std::string::npos) {
            fail(field->line, "data in several files are not read; join them into one");
        }
        header_.data_file = field->value;
    }

    void take_endian() {
        const HeaderField& field = demand("endian");
        const std::string name = lower_case(field.value);
        if (name != "little" && name != "big") {
            fail(field.line, "endian must be little or big, not " + excerpt(field.value));
        }
        header_.big_endian = name == "big";
    }

    std::int64_t whole_number(const std::string& field, std::int64_t least) const {
        const HeaderField* found = find(field);
        if (!found) return 0;
        const auto number = parse_integer(found->value);
        if (!number || *number < least) fail(found->line, excerpt(found->value) + " is no number to skip");
        return *number;
    }

    /// Returns true if all quoted words of a field are "mm", or if there is no such field.
    bool is_millimetres(const std::string& field) const {
        const HeaderField* found = find(field);
        if (!found) return true;
        std::string value = lower_case(found->value);
        std::replace(value.begin(), value.end(), '"', ' ');
        const auto units = words(value);
        return std::all_of(units.begin(), units.end(), [](std::string_view unit) {
            return unit == "mm" || unit == "millimeter" || unit == "millimetre";
        });
    }

    void take_box() {
        const HeaderField* directions = find("spacedirections");
        const HeaderField* spacings = find("spacings");
        const HeaderField* origin = find("spaceorigin");
        dvec3 step(0.0);
        if (directions) {
            const auto vectors = vectors_of(*directions);
            if (vectors.size() != axes_) {
                fail(directions->line, "there must be " + std::to_string(axes_) + " space directions");
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const dvec3 v = vectors[i + axes_ - 3].value_or(dvec3(0.0));
                for (std::size_t k = 0; k < 3; ++k) {
                    if (k != i && v[static_cast<int>(k)] != 0) return;
                }
                step[static_cast<int>(i)] = v[static_cast<int>(i)];
            }
            if (!is_millimetres("spaceunits")) return;
        } else if (spacings) {
            const auto numbers = words(spacings->value);
            if (numbers.size() != axes_) {
                fail(spacings->line, "there must be " + std::to_string(axes_) + " spacings");
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const auto spacing = parse_double(numbers[i + axes_ - 3]);
                if (!spacing) fail(spacings->line, excerpt(numbers[i + axes_ - 3]) + " is no spacing");
                step[static_cast<int>(i)] = *spacing;
            }
            if (!is_millimetres("units")) return;
        }
        dvec3 lowest(0.0);
        if (directions && origin) {
            const auto vectors = vectors_of(*origin);
            if (vectors.size() != 1 || !vectors[0])
                fail(origin->line, "the space origin must be one vector (x,y,z)");
            lowest = *vectors[0] - step / 2.0;
        }
        const dvec3 size(static_cast<double>(header_.size[0]), static_cast<double>(header_.size[1]),
                         static_cast<double>(header_.size[2]));
        const Box box{lowest, lowest + step * size};
        for (int i = 0; i < 3; ++i) {
            // A spacing may be NaN if it is unknown.
            if (!(step[i] > 0 && std::abs(box.lo[i]) < 1e9 && std::abs(box.hi[i]) < 1e9)) return;
        }
        header_.box = box;
    }

    /// Parses vectors written as "(x,y,z)" or "none".
    std::vector<std::optional<dvec3>> vectors_of(const HeaderField& field) const {
        std::vector<std::optional<dvec3>> vectors;
        std::string_view rest = trim_blanks(field.value);
        while (!rest.empty()) {
            if (lower_case(rest.substr(0, 4)) == "none") {
                vectors.emplace_back();
                rest = trim_blanks(rest.substr(4));
                continue;
            }
            const std::size_t end = rest.find(')');
            if (rest.front() != '(' || end == rest.npos) {
                fail(field.line, excerpt(rest) + " is no vector; one is written (x,y,z)");
            }
            std::string inner(rest.substr(1, end - 1));
            std::replace(inner.begin(), inner.end(), ',', ' ');
            const auto numbers = words(inner);
            dvec3 v(0.0);
            for (std::size_t i = 0; i < numbers.size() && i < 3; ++i) {
                const auto number = parse_double(numbers[i]);
                if (!number) fail(field.line, excerpt(numbers[i]) + " is not a number");
                v[static_cast<int>(i)] = *number;
            }
            if (numbers.size() != 3)
                fail(field.line, "a vector must have three coordinates: the space has 3 dimensions");
            vectors.emplace_back(v);
            rest = trim_blanks(rest.substr(end + 1));
        }
        return vectors;
    }

    std::istream& in_;
    const std::string& name_;
    std::map<std::string, HeaderField> fields_;
    std::size_t line_ = 0;
    std::size_t length_ = 0;
    std::size_t axes_ = 3;
    NrrdHeader header_;
};

}  // namespace

std::size_t sample_bytes(NrrdType type) {
    switch (type) {
        case NrrdType::int8:
        case NrrdType::uint8:
            return 1;
        case NrrdType::int16:
        case NrrdType::uint16:
            return 2;
        case NrrdType::int32:
        case NrrdType::uint32:
        case NrrdType::real32:
            return 4;
        case NrrdType::int64:
        case NrrdType::uint64:
        case NrrdType::real64:
            return 8;
    }
    throw InputError("unknown type of sample");
}

NrrdHeader read_nrrd_header(std::istream& in, const std::string& name) {
    return HeaderReader(in, name).read();
}

}  // namespace lamella
