// STL, in binary and text form.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/io/mesh_source.h"

namespace lamella {

namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t record_bytes = 50;

std::uint32_t little_u32(const char* p) {
    unsigned char b[4];
    std::memcpy(b, p, 4);
    return static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8U |
           static_cast<std::uint32_t>(b[2]) << 16U | static_cast<std::uint32_t>(b[3]) << 24U;
}

double little_float(const char* p) { return static_cast<double>(std::bit_cast<float>(little_u32(p))); }

std::size_t exact_size(std::string_view bytes) {
    return header_bytes + record_bytes * static_cast<std::size_t>(little_u32(bytes.data() + 80));
}

/// Returns true if all these bytes are triangles with usable corners, none of them all zeros as padding is.
bool are_triangles(std::string_view records) {
    if (records.size() % record_bytes != 0) return false;
    for (std::size_t at = 0; at < records.size(); at += record_bytes) {
        bool zeros = true;
        for (std::size_t i = 12; i < 48; i += 4) {
            const double number = little_float(records.data() + at + i);
            if (!(std::abs(number) <= max_coordinate)) return false;
            zeros = zeros && number == 0.0;
        }
        if (zeros) return false;
    }
    return true;
}

/// Returns how many complete triangles to read; adds a note when the header's count and the length disagree.
std::size_t usable_records(const MeshSource& source, std::vector<std::string>& notes) {
    const std::size_t announced = little_u32(source.bytes.data() + 80);
    const std::size_t room = source.bytes.size() - header_bytes;
    const std::size_t whole = room / record_bytes;
    const auto are = [](std::size_t count, const char* one, const char* many) {
        return grouped(count) + (count == 1 ? one : many);
    };
    if (announced > whole) {
        notes.push_back("the file is cut off: its header announces " + counted(announced, "triangle") +
                        ", only " + are(whole, " is", " are") + " there whole");
        return whole;
    }
    if (announced == 0 && whole > 0) {
        notes.push_back("the header announces 0 triangles, but " + are(whole, " follows", " follow") +
                        "; they were read");
        return whole;
    }
    const std::size_t extra = room - announced * record_bytes;
    if (extra == 0) return announced;
    if (are_triangles(source.bytes.substr(header_bytes + announced * record_bytes))) {
        notes.push_back("the header announces " + counted(announced, "triangle") + ", but " +
                        are(whole, " follows", " follow") + "; all of them were read");
        return whole;
    }
    notes.push_back(counted(extra, "byte") + " after the last of the " + counted(announced, "triangle") +
                    " that the header announces " + (extra == 1 ? "was" : "were") + " ignored");
    return announced;
}

MeshFile read_binary(const MeshSource& source) {
    if (source.bytes.size() < header_bytes) {
        reject(source, "the file has only " + counted(source.bytes.size(), "byte") +
                           "; a binary STL begins with a header of 84 bytes, a text STL with \"solid\"");
    }
    std::vector<std::string> notes;
    const std::size_t count = usable_records(source, notes);
    MeshWelder welder(count / 2 + 2);
    for (std::size_t i = 0; i < count; ++i) {
        const char* record = source.bytes.data() + header_bytes + i * record_bytes + 12;
        std::uint32_t corner[3];
        for (std::uint32_t& c : corner) {
            c = welder.vertex(
                dvec3(little_float(record), little_float(record + 4), little_float(record + 8)) *
                source.unit_mm);
            record += 12;
        }
        welder.triangle(corner[0], corner[1], corner[2]);
    }
    return welder.finish(source, std::move(notes));
}

/// Text form: a keyword decides what follows; line ends matter only behind a solid's name.
class AsciiStl {
  public:
    explicit AsciiStl(const MeshSource& source) : source_(source), text_(source.bytes) {
        text_ = TextCursor(source.bytes, source.bytes.size() - without_byte_order_mark(source.bytes).size());
    }

    MeshFile read() {
        for (std::string_view word = text_.token(); !word.empty() && !cut_off_; word = text_.token())
            take(word);
        if (corners_ > 0 || cut_off_) {
            notes_.push_back("the file is cut off in the middle of triangle " +
                             grouped(welder_.offered() + 1) + "; the whole triangles before it were read");
        }
        return welder_.finish(source_, std::move(notes_));
    }

  private:
    void take(std::string_view word) {
        if (same_word(word, "end")) return take_end();
        if (same_word(word, "vertex")) {
            take_vertex();
        } else if (same_word(word, "endloop") || same_word(word, "endfacet") || same_word(word, "facet")) {
            end_loop();
            if (same_word(word, "facet")) skip_normal();
        } else if (same_word(word, "solid") || same_word(word, "endsolid") || same_word(word, "color")) {
            end_loop();
            text_.skip_line();
        } else if (!same_word(word, "outer") && !same_word(word, "loop")) {
            refuse(word, "a keyword of a text STL (facet, outer loop, vertex, endloop, endfacet)");
        }
    }

    /// "end solid", "end facet" and "end loop": some programs separate the words.
    void take_end() {
        const std::string_view word = text_.token_on_line();
        if (!same_word(word, "solid") && !same_word(word, "facet") && !same_word(word, "loop"))
            return refuse(word, "what ends (solid, facet or loop)");
        end_loop();
        if (same_word(word, "solid")) text_.skip_line();
    }

    void take_vertex() {
        double v[3] = {};
        for (double& coordinate : v) {
            const std::string_view token = text_.token();
            const auto number = parse_double(token);
            if (number && text_.at_end()) cut_off_ = true;  // its last digits may be missing
            if (!number) refuse(token, "a coordinate (three numbers follow \"vertex\")");
            if (cut_off_) return;
            coordinate = *number;
        }
        if (corners_ == 3) {
            reject(source_, "line " + std::to_string(text_.line()) +
                                ": a fourth corner in one facet; the facets of an STL are triangles");
        }
        corner_[corners_++] = welder_.vertex(dvec3(v[0], v[1], v[2]) * source_.unit_mm);
    }

    void skip_normal() {
        // The normal is ignored, because exporters write arbitrary ones; the winding determines the outside.
        TextCursor ahead = text_;
        if (!same_word(ahead.token(), "normal")) return;
        text_ = ahead;
        for (int i = 0; i < 3; ++i) {
            const std::string_view word = ahead.token();
            if (same_word(word, "outer") || same_word(word, "loop") || same_word(word, "vertex")) return;
            text_ = ahead;
        }
    }

    void end_loop() {
        if (corners_ == 0) return;
        if (corners_ != 3) {
            reject(source_, "line " + std::to_string(text_.line()) + ": a facet with only " +
                                counted(corners_, "corner") + "; the facets of an STL are triangles");
        }
        welder_.triangle(corner_[0], corner_[1], corner_[2]);
        corners_ = 0;
    }

    void refuse(std::string_view token, const std::string& expected) {
        if (text_.at_end()) {
            cut_off_ = true;
            return;
        }
        reject(source_, "line " + std::to_string(text_.line()) + ": " + excerpt(token) + " where " +
                            expected + " was expected");
    }

    const MeshSource& source_;
    TextCursor text_;
    MeshWelder welder_;
    std::vector<std::string> notes_;
    std::uint32_t corner_[3] = {};
    std::size_t corners_ = 0;
    bool cut_off_ = false;
};

}  // namespace

bool is_exact_binary_stl(std::string_view bytes) {
    return bytes.size() >= header_bytes && exact_size(bytes) == bytes.size();
}

bool is_ascii_stl(std::string_view bytes) {
    if (is_exact_binary_stl(bytes)) return false;
    bytes = without_byte_order_mark(bytes);
    if (!same_word(TextCursor(bytes).token(), "solid")) return false;
    // Binary headers may begin with "solid" too. But no text contains a zero byte, and triangles in binary
    // soon do.
    constexpr std::size_t probe = 1024;
    return bytes.substr(0, probe).find('\0') == bytes.npos;
}

MeshFile read_stl(const MeshSource& source) {
    return is_ascii_stl(source.bytes) ? AsciiStl(source).read() : read_binary(source);
}

}  // namespace lamella
