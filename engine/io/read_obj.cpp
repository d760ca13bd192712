// Wavefront OBJ: vertices and faces; everything else in the file is skipped.
#include "engine/io/mesh_source.h"

namespace lamella {

namespace {

class ObjReader {
  public:
    explicit ObjReader(const MeshSource& source)
        : source_(source),
          text_(source.bytes, source.bytes.size() - without_byte_order_mark(source.bytes).size()) {}

    MeshFile read() {
        for (; !text_.at_end(); text_.skip_line()) {
            line_start_ = text_.offset();
            const std::string_view keyword = token();
            if (same_word(keyword, "v")) take_vertex();
            if (same_word(keyword, "f") || same_word(keyword, "fo")) take_face();
        }
        return build();
    }

  private:
    struct Face {
        std::size_t begin, end;  // in corners_
        std::size_t at;          // offset of its line
    };

    /// Returns the next token of a line; a backslash at the line's end continues it on the next one.
    std::string_view token() {
        std::string_view word = text_.token_on_line();
        while (word == "\\") {
            text_.skip_line();
            word = text_.token_on_line();
        }
        return word;
    }

    void take_vertex() {
        dvec3 p(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = token();
            const auto number = parse_double(word);
            if (!number) {
                reject(source_,
                       "line " + line() + ": " +
                           (word.empty() ? "a coordinate is missing" : excerpt(word) + " is not a number") +
                           "; \"v\" is followed by three of them, with a decimal point");
            }
            p[axis] = *number;
        }
        vertices_.push_back(p * source_.unit_mm);
    }

    void take_face() {
        const std::size_t begin = corners_.size();
        for (std::string_view word = token(); !word.empty() && word.front() != '#'; word = token()) {
            const auto index = parse_integer(word.substr(0, word.find('/')));
            corners_.push_back(index ? resolved(*index) : bad);
        }
        faces_.push_back({begin, corners_.size(), line_start_});
    }

    /// Negative indices count back from the vertex read last; positive ones may refer to later vertices.
    std::int64_t resolved(std::int64_t index) const {
        if (index > 0) return index - 1;
        const auto known = static_cast<std::int64_t>(vertices_.size());
        return index < 0 && index >= -known ? known + index : bad;
    }

    MeshFile build() {
        if (faces_.empty()) {
            reject(source_, "it holds " + counted(vertices_.size(), "vertex line") +
                                " but no faces (\"f\" lines), so there is nothing to print");
        }
        PolygonWelder welder(std::move(vertices_));
        std::vector<std::uint32_t> polygon;
        for (const Face& face : faces_) {
            if (!is_valid(face, welder.vertex_count())) continue;
            polygon.clear();
            for (std::size_t i = face.begin; i < face.end; ++i) {
                polygon.push_back(static_cast<std::uint32_t>(corners_[i]));
            }
            welder.polygon(polygon);
        }
        std::vector<std::string> notes;
        note(notes, bad_index_, "pointed to vertices that do not exist");
        note(notes, too_short_, "had fewer than 3 corners");
        return welder.finish(source_, std::move(notes));
    }

    struct Skipped {
        std::size_t count = 0;
        std::size_t first_at = 0;
        void add(const Face& face) {
            if (count++ == 0) first_at = face.at;
        }
    };

    bool is_valid(const Face& face, std::size_t vertex_count) {
        for (std::size_t i = face.begin; i < face.end; ++i) {
            if (corners_[i] < 0 || corners_[i] >= static_cast<std::int64_t>(vertex_count)) {
                bad_index_.add(face);
                return false;
            }
        }
        if (face.end - face.begin < 3) too_short_.add(face);
        return face.end - face.begin >= 3;
    }

    void note(std::vector<std::string>& notes, const Skipped& skipped, const std::string& why) const {
        if (skipped.count == 0) return;
        const bool one = skipped.count == 1;
        notes.push_back(grouped(skipped.count) + " of " + counted(faces_.size(), "face") + " " + why +
                        " and " + (one ? "was" : "were") + " left out (" + (one ? "" : "the first ") +
                        "on line " + std::to_string(text_.line_at(skipped.first_at)) + ")");
    }

    std::string line() const { return std::to_string(text_.line_at(line_start_)); }

    static constexpr std::int64_t bad = -1;
    const MeshSource& source_;
    TextCursor text_;
    std::size_t line_start_ = 0;
    std::vector<dvec3> vertices_;
    std::vector<std::int64_t> corners_;
    std::vector<Face> faces_;
    Skipped bad_index_, too_short_;
};

}  // namespace

MeshFile read_obj(const MeshSource& source) { return ObjReader(source).read(); }

}  // namespace lamella
