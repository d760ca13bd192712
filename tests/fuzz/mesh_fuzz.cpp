// Fuzz target: any bytes, read as a mesh file of one format and closed, end in a closed chain or an
// InputError.
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>

#include "engine/base/error.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_repair.h"
#include "tests/fuzz/packed_model.h"

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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string bytes(reinterpret_cast<const char*>(data), size);
    if (LAMELLA_FUZZ_PACK) bytes = lamella::packed_model(data, size);
    try {
        const lamella::MeshFile file = lamella::read_mesh(LAMELLA_FUZZ_NAME, std::as_bytes(std::span(bytes)));
        if (file.mesh.triangles.empty()) std::abort();
        const lamella::SolidMesh solid = lamella::close_mesh(file.mesh);
        if (!has_no_boundary(solid.mesh) || solid.caps > solid.mesh.triangles.size()) std::abort();
    } catch (const lamella::InputError&) {
    }
    return 0;
}
