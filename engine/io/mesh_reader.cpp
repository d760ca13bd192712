// Detects the format of a mesh file and calls the format's reader.
#include "engine/io/mesh_reader.h"

#include "engine/base/error.h"
#include "engine/base/whole_file.h"
#include "engine/io/mesh_source.h"

namespace lamella {

namespace {

std::string extension_of(std::string_view name) {
    const std::size_t dot = name.find_last_of("./\\");
    return lower_case(dot == name.npos || name[dot] != '.' ? std::string_view() : name.substr(dot + 1));
}

/// Returns true if one of the first lines starts with a keyword of OBJ files.
bool is_obj(std::string_view bytes) {
    constexpr int lines_to_look_at = 200;
    TextCursor text(without_byte_order_mark(bytes).substr(0, std::size_t{1} << 16U));
    for (int line = 0; line < lines_to_look_at && !text.at_end(); ++line, text.skip_line()) {
        const std::string_view keyword = text.token_on_line();
        for (const std::string_view known : {"v", "vn", "vt", "f", "mtllib", "usemtl"}) {
            if (same_word(keyword, known)) return true;
        }
    }
    return false;
}

MeshFile read_as_content_says(const MeshSource& source) {
    const std::string_view bytes = source.bytes;
    const std::string extension = extension_of(source.name);
    if (bytes.empty()) reject(source, "the file is empty (0 bytes)");
    if (bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06")) return read_3mf(source);
    if (is_ply(bytes)) return read_ply(source);
    if (bytes.starts_with("ISO-10303-21")) {
        reject(source,
               "this is a STEP file (curved surfaces, not triangles); export it as STL, OBJ, PLY or 3MF");
    }
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
        reject(source, "this is text in UTF-16, which is not read; save it as UTF-8 or plain ASCII");
    }
    if (is_exact_binary_stl(bytes) || is_ascii_stl(bytes) || extension == "stl") return read_stl(source);
    if (extension == "3mf") reject(source, "a 3MF file is a ZIP archive, and this is none");
    if (extension == "ply") reject(source, "a PLY file begins with a line \"ply\", and this one does not");
    if (extension == "obj" || is_obj(bytes)) return read_obj(source);
    reject(source, "its format is not recognised; mesh files are STL, OBJ, PLY or 3MF");
}

}  // namespace

MeshFile read_mesh(const std::string& path, const MeshReadOptions& options) {
    const std::string bytes = whole_file(path, "a mesh file (STL, OBJ, PLY or 3MF)");
    return read_mesh(path, std::as_bytes(std::span(bytes)), options);
}

MeshFile read_mesh(std::string_view name, std::span<const std::byte> bytes, const MeshReadOptions& options) {
    return read_as_content_says(mesh_source(name, bytes, options.unit_mm));
}

}  // namespace lamella
