// Copies of meshes in a 3MF package, read back.
#include "printers/vector/component_package.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/io/mesh_reader.h"
#include "tests/app/commands/folder.h"

namespace component_package_test {

using namespace lamella;

TEST_CASE("copies of meshes come back where they were put", "[3mf]") {
    const Folder folder;
    const std::filesystem::path file = folder.path() / "copies.3mf";
    const TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                                   {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    const std::vector<TriangleMesh> meshes{{}, tetrahedron};  // nothing copies the empty one
    // Turned by a quarter about z and twice as large, and one that is only moved.
    const std::vector<MeshCopy> copies{{1, {0, 2, 0}, {-2, 0, 0}, {0, 0, 2}, {10, 0, 0}},
                                       {1, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -5}}};
    write_component_package(file, meshes, copies, "a \"name\" & more");
    const TriangleMesh back = read_mesh(file.string()).mesh;
    REQUIRE(back.vertices.size() == 8);
    REQUIRE(back.triangles.size() == 8);
    std::size_t found = 0;
    for (const MeshCopy& copy : copies) {
        for (const dvec3 p : tetrahedron.vertices) {
            const dvec3 q = copy.x * p.x + copy.y * p.y + copy.z * p.z + copy.at;
            for (const dvec3 vertex : back.vertices) found += length(vertex - q) < 1e-4 ? 1 : 0;
        }
    }
    CHECK(found == 8);
    CHECK_THROWS_AS(write_component_package(file, meshes, {}, "none"), InputError);
}

}  // namespace component_package_test
