// Reads, places and closes meshes.
#include "recipe/inputs/read_solid.h"

#include <utility>

#include "engine/io/mesh_reader.h"
#include "engine/mesh/mesh_field.h"
#include "recipe/inputs/input_cache.h"

namespace lamella {

double enclosed_volume(const TriangleMesh& mesh) {
    double six_volumes = 0;
    const dvec3 origin = mesh.vertices.empty() ? dvec3(0) : mesh.vertices.front();
    for (const auto& triangle : mesh.triangles) {
        const dvec3 a = mesh.vertices[triangle[0]] - origin;
        const dvec3 b = mesh.vertices[triangle[1]] - origin;
        const dvec3 c = mesh.vertices[triangle[2]] - origin;
        six_volumes += glm::dot(a, glm::cross(b, c));
    }
    return six_volumes / 6;
}

SolidMesh read_closed_mesh(const SolidSource& source, std::optional<MeshReport>& report) {
    const auto& [path, unit, scale, place] = source;
    MeshReadOptions options;
    options.unit_mm = millimetres(unit);
    MeshFile file = read_mesh(path, options);
    if (scale != 1 || place.axes != glm::dmat3(1) || place.at != dvec3(0)) {
        for (dvec3& vertex : file.mesh.vertices) vertex = place.axes * (vertex * scale) + place.at;
    }
    if (glm::determinant(place.axes) < 0) {
        for (auto& triangle : file.mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    MeshReport& found = report.emplace();
    found.path = path;
    found.notes = std::move(file.notes);
    SolidMesh solid = close_mesh(std::move(file.mesh), path);
    found.vertices = solid.mesh.vertices.size();
    found.triangles = solid.mesh.triangles.size();
    found.caps = solid.caps;
    found.oriented_manifold = solid.oriented_manifold;
    found.volume = enclosed_volume(solid.mesh);
    found.notes.insert(found.notes.end(), solid.notes.begin(), solid.notes.end());
    return solid;
}

FieldPtr read_solid(const SolidSource& source, std::optional<MeshReport>& report, InputCache* cache) {
    if (cache != nullptr) {
        const InputCache::Solid solid = cache->solid(source);
        report = solid.report;
        return solid.field;
    }
    return make_mesh_field(read_closed_mesh(source, report));
}

}  // namespace lamella
