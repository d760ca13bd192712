// Fuzz target: any bytes, read as a mesh file of one format and closed, end in a closed chain whose sections
// are runs in order and contours, or in an InputError.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>

#include "engine/base/error.h"
#include "engine/contours/contours.h"
#include "engine/field/slice_context.h"
#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "tests/fuzz/check_runs.h"
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

/// Cuts the solid in the middle of its height.
void cut(lamella::SolidMesh solid) {
    const lamella::FieldPtr field = lamella::make_mesh_field(std::move(solid));
    const lamella::Box box = field->bounds();
    lamella::SliceContext context;
    lamella::Scratch scratch;
    const lamella::SliceField& slice = context.slice(*field, box.center().z);
    lamella::check_runs(slice, {{box.lo.x, box.lo.y}, {box.hi.x, box.hi.y}}, scratch);
    const double tolerance = std::max(box.size().x, box.size().y) / 200;
    if (tolerance < 1e-9) return;
    for (const lamella::Contour& contour : lamella::trace_contours(slice, tolerance, scratch)) {
        if (contour.points.size() < 3) std::abort();
    }
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
        constexpr std::size_t bearable = 1000;
        if (!solid.mesh.triangles.empty() && solid.mesh.triangles.size() < bearable) cut(solid);
    } catch (const lamella::InputError&) {
    }
    return 0;
}
