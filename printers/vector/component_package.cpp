// One object for each mesh, one of components, one item.
#include "printers/vector/component_package.h"

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/archive/package_3mf.h"
#include "printers/archive/zip_writer.h"

namespace lamella {
namespace {

constexpr int place_decimals = 5, matrix_decimals = 9;

class ModelWriter {
  public:
    explicit ModelWriter(ZipWriter& zip) : zip_(zip) {}

    void write(std::span<const TriangleMesh> meshes, std::span<const MeshCopy> copies,
               const std::string& name) {
        text_ +=
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<model unit=\"millimeter\" xml:lang=\"en-US\" "
            "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
            "<metadata name=\"Application\">Lamella</metadata>\n<resources>\n";
        std::vector<std::uint8_t> is_used(meshes.size(), 0);
        for (const MeshCopy& copy : copies) is_used.at(copy.mesh) = 1;
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            if (is_used[i] != 0) write_mesh(i + 1, meshes[i]);
        }
        const std::string id = std::to_string(meshes.size() + 1);
        text_ +=
            "<object id=\"" + id + "\" type=\"model\" name=\"" + xml_attribute(name) + "\">\n<components>\n";
        for (const MeshCopy& copy : copies) write_copy(copy);
        text_ += "</components>\n</object>\n</resources>\n<build>\n<item objectid=\"" + id +
                 "\"/>\n</build>\n</model>\n";
        zip_.write(text_);
    }

  private:
    void write_mesh(std::size_t id, const TriangleMesh& mesh) {
        text_ += "<object id=\"" + std::to_string(id) + "\" type=\"model\">\n<mesh>\n<vertices>\n";
        for (const dvec3 p : mesh.vertices) {
            text_ += "<vertex x=\"";
            append_number(text_, p.x, place_decimals);
            text_ += "\" y=\"";
            append_number(text_, p.y, place_decimals);
            text_ += "\" z=\"";
            append_number(text_, p.z, place_decimals);
            text_ += "\"/>\n";
            pass_on();
        }
        text_ += "</vertices>\n<triangles>\n";
        for (const auto& [a, b, c] : mesh.triangles) {
            text_ += "<triangle v1=\"" + std::to_string(a) + "\" v2=\"" + std::to_string(b) + "\" v3=\"" +
                     std::to_string(c) + "\"/>\n";
            pass_on();
        }
        text_ += "</triangles>\n</mesh>\n</object>\n";
    }

    /// The format's matrices multiply rows from the left: the images of the axes are its rows.
    void write_copy(const MeshCopy& copy) {
        text_ += "<component objectid=\"" + std::to_string(copy.mesh + 1) + "\" transform=\"";
        for (const dvec3 row : {copy.x, copy.y, copy.z, copy.at}) {
            for (int i = 0; i < 3; ++i) {
                append_number(text_, row[i], matrix_decimals);
                text_ += ' ';
            }
        }
        text_.back() = '"';
        text_ += "/>\n";
        pass_on();
    }

    void pass_on() {
        constexpr std::size_t piece = 1 << 16;
        if (text_.size() < piece) return;
        zip_.write(text_);
        text_.clear();
    }

    ZipWriter& zip_;
    std::string text_;
};

}  // namespace

void write_component_package(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                             std::span<const MeshCopy> copies, const std::string& name) {
    if (copies.empty()) throw InputError("a package of copies needs some, and there are none");
    ZipWriter zip(path);
    begin_model(zip);
    ModelWriter(zip).write(meshes, copies, name);
    zip.finish();
}

}  // namespace lamella
