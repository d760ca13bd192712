// Shared code of the mesh readers: the bytes of a file, a cursor over its text, and the welding of equal
// corners.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/text.h"
#include "engine/io/mesh_reader.h"

namespace lamella {

/// A file to read, entirely in memory.
struct MeshSource {
    std::string name;        ///< as the user knows it
    std::string_view bytes;  ///< the content
    double unit_mm = 1.0;    ///< mm per number, for formats that state no unit
};

/// Returns the source of these bytes. Throws InputError for a unit that is not positive or absurdly large.
MeshSource mesh_source(std::string_view name, std::span<const std::byte> bytes, double unit_mm);

/// Throws InputError("name: what").
[[noreturn]] void reject(const MeshSource& source, const std::string& what);

/// Splits text into tokens separated by white space.
class TextCursor {
  public:
    explicit TextCursor(std::string_view text, std::size_t at = 0) : text_(text), at_(at) {}

    std::string_view token();          ///< the next token, over line ends; empty at the end of the text
    std::string_view token_on_line();  ///< the next token on this line; empty at the end of the line
    void skip_line();                  ///< moves behind the next line end
    bool at_end() const { return at_ >= text_.size(); }
    std::size_t offset() const { return at_; }
    /// Returns the line of an offset, from 1. Counts from the start, so use it for messages only.
    std::size_t line_at(std::size_t offset) const;
    std::size_t line() const { return line_at(at_); }

  private:
    std::string_view text_;
    std::size_t at_;
};

/// Collects triangles, giving equal corners one vertex and skipping degenerate triangles.
class MeshWelder {
  public:
    static constexpr std::uint32_t unusable = 0xffffffffU;

    explicit MeshWelder(std::size_t expected_vertices = 0);

    /// Returns the vertex at p (mm), or `unusable` when a coordinate is NaN, infinite or absurdly large.
    std::uint32_t vertex(dvec3 p);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    std::size_t offered() const { return offered_; }

    /// Returns the mesh, with notes about skipped triangles. Throws InputError when no triangle is left.
    MeshFile finish(const MeshSource& source, std::vector<std::string> notes);

  private:
    void grow();

    TriangleMesh mesh_;
    std::vector<std::uint32_t> slots_;
    std::size_t offered_ = 0;
    std::size_t not_finite_ = 0;
    std::size_t degenerate_ = 0;
};

/// Collects polygons over a list of vertices, cutting them into triangles.
class PolygonWelder {
  public:
    /// The vertices of the file in mm, in file order.
    explicit PolygonWelder(std::vector<dvec3> vertices);

    std::size_t vertex_count() const { return vertices_.size(); }
    /// Adds a face by vertex indices, all below vertex_count(); 3 corners or more.
    void polygon(std::span<const std::uint32_t> corners);
    MeshFile finish(const MeshSource& source, std::vector<std::string> notes) {
        return welder_.finish(source, std::move(notes));
    }

  private:
    std::vector<dvec3> vertices_;
    MeshWelder welder_;
    std::vector<std::uint32_t> welded_;
    std::vector<std::uint32_t> ring_;
    std::vector<dvec3> points_;
    std::vector<std::array<std::uint32_t, 3>> cut_;
};

MeshFile read_stl(const MeshSource& source);
MeshFile read_obj(const MeshSource& source);
MeshFile read_ply(const MeshSource& source);
MeshFile read_3mf(const MeshSource& source);

/// True when the first line is "ply", with or without a byte order mark.
bool is_ply(std::string_view bytes);
/// True when the bytes read as the text form of STL rather than the binary one.
bool is_ascii_stl(std::string_view bytes);
/// True when the length is exactly what a binary STL's triangle count calls for.
bool is_exact_binary_stl(std::string_view bytes);

}  // namespace lamella
