// Fuzz target: any bytes, read as a mesh file of one format and closed, end in a closed chain or an
// InputError.
#include <zip.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>

#include "engine/error.h"
#include "engine/mesh_reader.h"
#include "engine/mesh_repair.h"

namespace {

bool has_no_boundary(const lamella::TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> net;
    for (const auto& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            ++net[{t[i], t[(i + 1) % 3]}];
            --net[{t[(i + 1) % 3], t[i]}];
        }
    }
    for (const auto& [edge, count] : net) {
        if (count != 0) return false;
    }
    return true;
}

/// The bytes as the model part of a 3MF package: mutations of a package itself rarely get past its checksums.
std::string packed(const std::uint8_t* data, std::size_t size) {
    zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, nullptr);
    zip_source_keep(target);
    zip_t* zip = zip_open_from_source(target, ZIP_TRUNCATE, nullptr);
    const zip_int64_t index = zip_file_add(zip, "3D/3dmodel.model", zip_source_buffer(zip, data, size, 0), 0);
    zip_set_file_compression(zip, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
    if (zip_close(zip) != 0 || zip_source_open(target) != 0) std::abort();
    zip_source_seek(target, 0, SEEK_END);
    std::string bytes(static_cast<std::size_t>(zip_source_tell(target)), '\0');
    zip_source_seek(target, 0, SEEK_SET);
    zip_source_read(target, bytes.data(), bytes.size());
    zip_source_close(target);
    zip_source_free(target);
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes(reinterpret_cast<const char*>(data), size);
    if (LAMELLA_FUZZ_PACK) bytes = packed(data, size);
    try {
        const lamella::MeshFile file = lamella::read_mesh(LAMELLA_FUZZ_NAME, std::as_bytes(std::span(bytes)));
        if (file.mesh.triangles.empty()) std::abort();
        const lamella::SolidMesh solid = lamella::close_mesh(file.mesh);
        if (!has_no_boundary(solid.mesh) || solid.caps > solid.mesh.triangles.size()) std::abort();
    } catch (const lamella::InputError&) {
    }
    return 0;
}
