// PLY, as text and as little-endian or big-endian binary.
#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/base/whole_file.h"
#include "engine/io/mesh_attribute.h"
#include "engine/io/mesh_source.h"
#include "engine/io/ply_header.h"
#include "engine/mesh/triangulate.h"

namespace lamella {

namespace {

using ply::Element, ply::Encoding, ply::Header, ply::Property, ply::Scalar;

/// Returns the values of the body one after another; `ok` becomes false at the end of the data.
class BodyCursor {
  public:
    BodyCursor(const MeshSource& source, const Header& header)
        : source_(source),
          encoding_(header.encoding),
          text_(source.bytes, header.data_at),
          at_(header.data_at) {}

    bool ok() const { return ok_; }

    /// Moves to the next row: of a text file, the next line that is not blank.
    void begin_row() {
        if (encoding_ != Encoding::text || !ok_) return;
        values_ = 0;
        for (TextCursor ahead = text_; ahead.token_on_line().empty(); text_ = ahead) {
            ahead.skip_line();
            if (!ahead.at_end()) continue;
            text_ = ahead;
            ok_ = false;
            return;
        }
    }

    /// Ends a row. A line may hold more than the header announces; the rest of it is skipped and counted.
    void end_row() {
        if (encoding_ != Encoding::text || !ok_) return;
        if (!text_.token_on_line().empty() && surplus_rows_++ == 0) first_surplus_ = text_.line();
        text_.skip_line();
    }

    /// Returns the number of bytes from here to the end, without white space at either end.
    std::size_t bytes_behind() const {
        return ok_ ? trimmed(std::string_view(source_.bytes).substr(offset())).size() : 0;
    }
    std::size_t surplus_rows() const { return surplus_rows_; }
    std::size_t first_surplus() const { return first_surplus_; }  ///< its line
    std::size_t bytes_left() const { return source_.bytes.size() - offset(); }
    Encoding encoding() const { return encoding_; }

    double value(const Scalar& scalar) {
        if (!ok_) return 0.0;
        return encoding_ == Encoding::text ? text_value() : binary_value(scalar);
    }

    void skip_bytes(std::size_t bytes) { at_ += bytes; }

    std::string where() const {
        return encoding_ == Encoding::text ? "line " + std::to_string(text_.line())
                                           : "byte " + std::to_string(at_);
    }

  private:
    std::size_t offset() const { return encoding_ == Encoding::text ? text_.offset() : at_; }

    double text_value() {
        const std::string_view token = text_.token_on_line();
        if (token.empty() && text_.at_end()) {
            ok_ = false;
            return 0.0;
        }
        if (token.empty()) {
            reject(source_, where() + ": the line holds only " + counted(values_, "number") +
                                ", fewer than the header announces for a row; a row is one line");
        }
        const auto number = parse_double(token);
        if (!number) reject(source_, where() + ": " + excerpt(token) + " is not a number");
        ++values_;
        return *number;
    }

    double binary_value(const Scalar& scalar) {
        if (source_.bytes.size() - at_ < scalar.bytes) {
            ok_ = false;
            return 0.0;
        }
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < scalar.bytes; ++i) {
            const std::size_t byte = encoding_ == Encoding::little_endian ? scalar.bytes - 1 - i : i;
            bits = bits << 8U | static_cast<unsigned char>(source_.bytes[at_ + byte]);
        }
        at_ += scalar.bytes;
        if (scalar.kind == Scalar::Kind::unsigned_integer) return static_cast<double>(bits);
        if (scalar.kind == Scalar::Kind::real && scalar.bytes == 8) return std::bit_cast<double>(bits);
        if (scalar.kind == Scalar::Kind::real) {
            return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        }
        const std::uint64_t sign = std::uint64_t{1} << (8 * scalar.bytes - 1);
        return static_cast<double>(static_cast<std::int64_t>(bits ^ sign) - static_cast<std::int64_t>(sign));
    }

    const MeshSource& source_;
    Encoding encoding_;
    TextCursor text_;
    std::size_t at_;
    bool ok_ = true;
    std::size_t values_ = 0;  // in this row
    std::size_t surplus_rows_ = 0;
    std::size_t first_surplus_ = 0;
};

class PlyReader {
  public:
    explicit PlyReader(const MeshSource& source)
        : source_(source), header_(ply::read_header(source)), body_(source, header_) {}

    MeshFile read() {
        read_elements();
        return build();
    }

    /// Rejects what read() repairs, so that no number ends up at another corner.
    AttributedMesh read_with(const std::string& attribute) {
        choose(attribute);
        read_elements();
        if (!notes_.empty()) reject(source_, notes_.front());
        if (!has_faces_) reject(source_, without_faces());
        AttributedMesh out;
        out.mesh.vertices = std::move(vertices_);
        out.values = std::move(values_);
        cut_faces(out.mesh);
        return out;
    }

  private:
    void read_elements() {
        for (const Element& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
            } else if (element.name == "tristrips") {
                read_strips(element);
            } else {
                skip(element);
            }
            if (!body_.ok()) break;
        }
    }

    /// Finds the property to read at each vertex, and the full scale of its type.
    void choose(const std::string& attribute) {
        std::string names;
        for (const Element& element : header_.elements) {
            if (element.name != "vertex") continue;
            if (!names.empty()) reject(source_, "its header announces vertices twice");
            for (const Property& p : element.properties) {
                if (p.name == "x" || p.name == "y" || p.name == "z" || p.count) continue;
                names += (names.empty() ? "" : ", ") + excerpt(p.name);
                if (p.name != attribute) continue;
                attribute_ = element.index_of(attribute);
                const bool channel =
                    attribute == "red" || attribute == "green" || attribute == "blue" || attribute == "alpha";
                if (channel && p.value.kind != Scalar::Kind::real) full_scale_ = greatest(p.value);
            }
        }
        if (attribute_ != none) return;
        reject(source_, "its vertices have no number named " + excerpt(attribute) + "; there " +
                            (names.empty() ? "is none beside x, y and z" : "are " + names));
    }

    static double greatest(const Scalar& scalar) {
        const std::size_t bits = 8 * scalar.bytes - (scalar.kind == Scalar::Kind::signed_integer ? 1 : 0);
        return static_cast<double>((std::uint64_t{1} << bits) - 1);
    }

    /// Returns an upper bound of the number of rows in the file, so that no announced count causes a huge
    /// allocation.
    std::size_t possible_rows(const Element& element) const {
        const std::size_t least =
            body_.encoding() == Encoding::text ? 2 * element.properties.size() : element.row_bytes();
        return least == 0 ? 0 : std::min(element.count, body_.bytes_left() / least + 1);
    }

    void read_vertices(const Element& element) {
        const std::size_t x = element.index_of_word("x");
        const std::size_t y = element.index_of_word("y");
        const std::size_t z = element.index_of_word("z");
        if (std::max({x, y, z}) >= element.properties.size()) {
            reject(source_, "its vertices lack one of the properties x, y and z");
        }
        vertices_.reserve(possible_rows(element));
        for (std::size_t row = 0; row < element.count; ++row) {
            dvec3 p(0.0);
            double number = 0.0;
            body_.begin_row();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const double value = read_property(element.properties[i], nullptr);
                if (i == x) p.x = value;
                if (i == y) p.y = value;
                if (i == z) p.z = value;
                if (i == attribute_) number = value;
            }
            body_.end_row();
            if (!body_.ok()) cut_off(element, row);
            if (!body_.ok()) return;
            vertices_.push_back(p * source_.unit_mm);
            if (attribute_ != none)
                values_.push_back(std::isfinite(number) ? number / full_scale_ : std::nan(""));
        }
    }

    void read_faces(const Element& element) {
        const std::size_t list = corners_of(element, "faces");
        has_faces_ = true;
        face_ends_.reserve(possible_rows(element));
        for (std::size_t row = 0; row < element.count; ++row) {
            const std::size_t begin = corners_.size();
            read_row(element, list, &corners_);
            if (!body_.ok()) corners_.resize(begin);
            if (!body_.ok()) cut_off(element, row);
            if (!body_.ok()) return;
            face_ends_.push_back(corners_.size());
        }
    }

    /// Strips: every vertex makes a triangle with the two before it; -1 begins a new strip.
    void read_strips(const Element& element) {
        const std::size_t list = corners_of(element, "strips of triangles");
        const Scalar& type = element.properties[list].value;
        const auto none_of_type =
            type.kind == Scalar::Kind::unsigned_integer ? static_cast<std::int64_t>(greatest(type)) : -1;
        has_faces_ = true;
        std::vector<std::int64_t> strip;
        for (std::size_t row = 0; row < element.count; ++row) {
            strip.clear();
            read_row(element, list, &strip);
            if (!body_.ok()) cut_off(element, row);
            if (!body_.ok()) return;
            std::size_t begin = 0;
            for (std::size_t i = 0; i < strip.size(); ++i) {
                if (strip[i] == -1 || strip[i] == none_of_type) begin = i + 1;
                if (i >= begin + 2) add_strip_triangle(&strip[i - 2], (i - begin) % 2 != 0);
            }
        }
    }

    /// Every second triangle of a strip turns the other way. Those that repeat a vertex only join strips.
    void add_strip_triangle(const std::int64_t* v, bool reversed) {
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return;
        corners_.insert(corners_.end(), {v[reversed ? 1 : 0], v[reversed ? 0 : 1], v[2]});
        face_ends_.push_back(corners_.size());
    }

    std::size_t corners_of(const Element& element, const std::string& what) const {
        const std::size_t list = element.index_of_corners();
        if (list >= element.properties.size() || !element.properties[list].count)
            reject(source_, "its " + what + " lack the list property vertex_indices");
        return list;
    }

    void skip(const Element& element) {
        if (element.properties.empty()) return;
        if (body_.encoding() != Encoding::text && !element.has_lists()) {
            const std::size_t rows = std::min(element.count, body_.bytes_left() / element.row_bytes());
            body_.skip_bytes(rows * element.row_bytes());
            if (rows < element.count) cut_off(element, rows);
            return;
        }
        for (std::size_t row = 0; row < element.count && body_.ok(); ++row) {
            read_row(element, none, nullptr);
            if (!body_.ok()) cut_off(element, row);
        }
    }

    /// Reads a row, and appends the values of the property number `list` to `values` as indices.
    void read_row(const Element& element, std::size_t list, std::vector<std::int64_t>* values) {
        body_.begin_row();
        for (std::size_t i = 0; i < element.properties.size(); ++i)
            read_property(element.properties[i], i == list ? values : nullptr);
        body_.end_row();
    }

    /// Returns a scalar's value, or reads a list and stores its values in `list` (unless null) as indices.
    double read_property(const Property& property, std::vector<std::int64_t>* list) {
        if (!property.count) return body_.value(property.value);
        const double length = body_.value(*property.count);
        if (!(length >= 0.0 && length <= 1e9 && length == std::floor(length))) {
            reject(source_, body_.where() + ": a list of impossible length");
        }
        for (auto left = static_cast<std::size_t>(length); left > 0 && body_.ok(); --left) {
            const double value = body_.value(property.value);
            if (list) list->push_back(std::abs(value) < 1e15 ? static_cast<std::int64_t>(value) : -1);
        }
        return length;
    }

    void cut_off(const Element& element, std::size_t rows) {
        notes_.push_back("the file is cut off: its header announces " +
                         counted(element.count, element.name + " element") + ", only " + grouped(rows) +
                         (rows == 1 ? " is" : " are") + " there whole");
    }

    std::string without_faces() const {
        return notes_.empty() ? "it holds points but no faces" : notes_.front();
    }

    /// Cuts the faces into triangles over the unchanged vertices; skips degenerate triangles.
    void cut_faces(TriangleMesh& mesh) const {
        std::vector<dvec3> loop;
        std::vector<std::array<std::uint32_t, 3>> cut;
        std::size_t begin = 0;
        for (std::size_t face = 0; face < face_ends_.size(); begin = face_ends_[face++]) {
            loop.clear();
            for (std::size_t i = begin; i < face_ends_[face]; ++i) {
                loop.push_back(checked_corner(mesh, face, corners_[i]));
            }
            cut.clear();
            triangulate_loop(loop, cut);
            for (const auto& t : cut) {
                if (loop[t[0]] == loop[t[1]] || loop[t[1]] == loop[t[2]] || loop[t[2]] == loop[t[0]])
                    continue;
                mesh.triangles.push_back({static_cast<std::uint32_t>(corners_[begin + t[0]]),
                                          static_cast<std::uint32_t>(corners_[begin + t[1]]),
                                          static_cast<std::uint32_t>(corners_[begin + t[2]])});
            }
        }
        if (mesh.triangles.empty()) reject(source_, "none of its faces has an extent");
    }

    dvec3 checked_corner(const TriangleMesh& mesh, std::size_t face, std::int64_t corner) const {
        const auto fail = [&](const std::string& what) {
            reject(source_, "face " + grouped(face + 1) + " " + what);
        };
        if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.vertices.size()) {
            fail("points to a vertex that does not exist");
        }
        const dvec3 p = mesh.vertices[static_cast<std::size_t>(corner)];
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(p[axis]) <= max_coordinate)) {
                fail("has a corner that is NaN, infinite or absurdly large");
            }
        }
        return p;
    }

    MeshFile build() {
        if (!has_faces_) reject(source_, without_faces() + ", so there is nothing to print");
        PolygonWelder welder(std::move(vertices_));
        std::size_t begin = 0;
        std::size_t bad_index = 0;
        std::size_t too_short = 0;
        std::vector<std::uint32_t> polygon;
        for (const std::size_t end : face_ends_) {
            polygon.clear();
            bool known = true;
            for (; begin < end; ++begin) {
                known = known && corners_[begin] >= 0 &&
                        static_cast<std::size_t>(corners_[begin]) < welder.vertex_count();
                polygon.push_back(static_cast<std::uint32_t>(corners_[begin]));
            }
            if (!known) ++bad_index;
            if (known && polygon.size() < 3) ++too_short;
            if (known && polygon.size() >= 3) welder.polygon(polygon);
        }
        note(bad_index, "pointed to vertices that do not exist");
        note(too_short, "had fewer than 3 corners");
        if (const std::size_t rows = body_.surplus_rows(); rows > 0) {
            notes_.push_back(counted(rows, "line") + (rows == 1 ? " holds" : " hold") +
                             " more numbers than the header announces for a row, which were skipped (" +
                             (rows == 1 ? "" : "the first is ") + "line " +
                             std::to_string(body_.first_surplus()) + ")");
        }
        if (const std::size_t behind = body_.bytes_behind(); behind > 0) {
            notes_.push_back(counted(behind, "byte") + " behind all that the header announces " +
                             (behind == 1 ? "was" : "were") + " ignored");
        }
        notes_.insert(notes_.begin(), header_.notes.begin(), header_.notes.end());
        return welder.finish(source_, std::move(notes_));
    }

    void note(std::size_t count, const std::string& why) {
        if (count == 0) return;
        notes_.push_back(grouped(count) + " of " + counted(face_ends_.size(), "face") + " " + why + " and " +
                         (count == 1 ? "was" : "were") + " left out");
    }

    const MeshSource& source_;
    Header header_;
    BodyCursor body_;
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::size_t attribute_ = none;
    double full_scale_ = 1.0;
    std::vector<dvec3> vertices_;
    std::vector<double> values_;
    std::vector<std::int64_t> corners_;
    std::vector<std::size_t> face_ends_;
    std::vector<std::string> notes_;
    bool has_faces_ = false;
};

}  // namespace

bool is_ply(std::string_view bytes) {
    TextCursor text(without_byte_order_mark(bytes).substr(0, 80));
    return same_word(text.token_on_line(), "ply") && !text.at_end() && text.token_on_line().empty();
}

MeshFile read_ply(const MeshSource& source) { return PlyReader(source).read(); }

AttributedMesh read_ply_attribute(std::string_view name, std::span<const std::byte> bytes,
                                  const std::string& attribute, double unit_mm) {
    const MeshSource source = mesh_source(name, bytes, unit_mm);
    if (!is_ply(source.bytes)) {
        reject(source,
               "a PLY file begins with a line \"ply\", and this one does not; no other mesh format "
               "is read for numbers at its vertices");
    }
    return PlyReader(source).read_with(attribute);
}

AttributedMesh read_ply_attribute(const std::string& path, const std::string& attribute, double unit_mm) {
    const std::string bytes = whole_file(path, "a PLY file");
    return read_ply_attribute(path, std::as_bytes(std::span(bytes)), attribute, unit_mm);
}

}  // namespace lamella
