// Text files by their lines: rows of a PLY, keywords of an STL, and marks and lines that other programs add.
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/io/mesh_attribute.h"
#include "engine/mesh/mesh_repair.h"
#include "tests/engine/io/package_samples.h"
#include "tests/engine/mesh/mesh_samples.h"

namespace mesh_rows_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

/// The L as PLY. `row_end` follows every face; `header` goes in front of end_header.
std::string ply(const std::string& row_end, const std::string& header = "",
                const std::string& magic = "ply") {
    const TriangleMesh mesh = l_shape();
    std::string text = magic + "\nformat ascii 1.0\n" +
                       "element vertex 12\nproperty float x\nproperty float y\n" +
                       "property float z\nelement face 20\nproperty list uchar int vertex_indices\n" +
                       header + "end_header\n";
    for (const dvec3& p : mesh.vertices) text += number(p.x) + " " + number(p.y) + " " + number(p.z) + "\n";
    for (const auto& [a, b, c] : mesh.triangles) {
        text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + row_end + "\n";
    }
    return text;
}

std::string stl(const std::string& solid_end, const std::string& facet_end, const std::string& loop_end) {
    const TriangleMesh mesh = l_shape();
    std::string text = "solid end of vertex\n";
    for (const auto& t : mesh.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const std::uint32_t v : t) {
            const dvec3 p = mesh.vertices[v];
            text += "vertex " + number(p.x) + " " + number(p.y) + " " + number(p.z) + "\n";
        }
        text += loop_end + "\n" + facet_end + "\n";
    }
    return text + solid_end + "\n";
}

void check_l(const MeshFile& file, std::size_t notes = 0) {
    CHECK(file.mesh.triangles.size() == 20);
    CHECK(volume(file.mesh) == Approx(l_volume));
    CHECK(file.mesh.bounds().size() == dvec3(10, 12, 8));
    CHECK(close_mesh(file.mesh).oriented_manifold);
    INFO((file.notes.empty() ? "" : file.notes.front()));
    CHECK(file.notes.size() == notes);
}

std::string message_of(const std::string& name, const std::string& bytes) {
    try {
        from_memory(name, bytes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing was refused";
}

AttributedMesh attributes(const std::string& bytes) {
    return read_ply_attribute("a.ply", std::as_bytes(std::span(bytes)), "n");
}

/// A square of two strips: their vertices have the numbers 1 to 6.
std::string strips(const std::string& list) {
    return "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
           "property float n\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
           "0 0 0 1\n4 0 0 2\n0 4 0 3\n4 4 0 4\n0 8 0 5\n4 8 0 6\n" +
           list + "\n";
}

double signed_area(const TriangleMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        area += glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]).z / 2;
    return area;
}

}  // namespace

TEST_CASE("a row of a text PLY is a line, however many numbers it holds", "[mesh_dialects]") {
    check_l(from_memory("a.ply", ply("")));
    const MeshFile longer = from_memory("a.ply", ply(" 255 255 255 0.5"));
    check_l(longer, 1);
    CHECK(longer.notes.front() ==
          "20 lines hold more numbers than the header announces for a row, which were skipped (the first is "
          "line 22)");
    check_l(from_memory("a.ply", ply("\n\n \t")));  // blank lines
}

TEST_CASE("a row of a text PLY that is too short is refused with its line", "[mesh_dialects]") {
    std::string text = ply("");
    text.replace(text.find("\n10 4 0\n"), 8, "\n10 4\n");
    CHECK(
        message_of("a.ply", text) ==
        "a.ply: line 12: the line holds only 2 numbers, fewer than the header announces for a row; a row is "
        "one line");
    text = ply("");
    text.replace(text.find("\n3 0 1 7\n"), 9, "\n4 0 1 7\n");
    CHECK_THAT(message_of("a.ply", text), Catch::Contains("line 22: the line holds only 4 numbers"));
    text.replace(text.find("\n4 0 1 7\n"), 9, "\n3.5 0 1 7\n");
    CHECK_THAT(message_of("a.ply", text), Catch::Contains("line 22: a list of impossible length"));
}

TEST_CASE("numbers at vertices are read from lines that hold more", "[mesh_dialects]") {
    const AttributedMesh mesh = attributes(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float n\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 1 9\n4 0 0 2 9\n0 4 0 3 9\n3 0 1 2 9 9\n");
    CHECK(mesh.values == std::vector<double>{1, 2, 3});
    CHECK(signed_area(mesh.mesh) == 8);
}

TEST_CASE("a PLY begins with a byte order mark, in capitals or with blanks", "[mesh_dialects]") {
    check_l(from_memory("a.ply", "\xef\xbb\xbf" + ply("")));
    check_l(from_memory("a", "\xef\xbb\xbf" + ply("")));
    check_l(from_memory("a.ply", ply("", "", "PLY ")));
    std::string capitals = ply("");
    for (char& c : capitals) c = static_cast<char>(std::toupper(c));
    check_l(from_memory("a.ply", capitals));
    CHECK_THAT(message_of("a.ply", "plywood\n"), Catch::Contains("begins with a line \"ply\""));
    CHECK_THAT(message_of("a.ply", std::string("\xff\xfep\0l\0y\0\n\0", 10)),
               Catch::Contains("UTF-16, which is not read; save it as UTF-8"));
}

TEST_CASE("a line of a PLY header that is no comment is skipped with a note", "[mesh_dialects]") {
    const MeshFile file = from_memory("a.ply", ply("", "made by hand\ncomment twice\nobj_info 3\n"));
    check_l(file, 1);
    CHECK_THAT(file.notes.front(),
               Catch::Contains("line 9 of the header begins with \"made\" and was skipped"));
    std::string many;
    for (int i = 0; i < 1001; ++i) many += "noise\n";
    CHECK_THAT(message_of("a.ply", ply("", many)), Catch::Contains("more than 1,000 lines"));
}

TEST_CASE("strips of triangles turn the same way throughout, and begin anew at -1", "[mesh_dialects]") {
    const MeshFile one = from_memory("a.ply", strips("6 0 1 2 3 4 5"));
    CHECK(one.mesh.triangles.size() == 4);
    CHECK(signed_area(one.mesh) == 32);
    CHECK(one.notes.empty());
    const MeshFile two = from_memory("a.ply", strips("9 0 1 2 3 -1 2 3 4 5"));
    CHECK(two.mesh.triangles.size() == 4);
    CHECK(signed_area(two.mesh) == 32);
    // Repeated vertices join strips and make no triangles.
    const MeshFile joined = from_memory("a.ply", strips("10 0 1 2 3 3 2 2 3 4 5"));
    CHECK(joined.mesh.triangles.size() == 4);
    CHECK(signed_area(joined.mesh) == 32);
    CHECK(joined.notes.empty());
    const MeshFile bad = from_memory("a.ply", strips("6 0 1 2 3 4 9"));
    CHECK(bad.mesh.triangles.size() == 3);
    CHECK_THAT(bad.notes.front(), Catch::Contains("1 of 4 faces pointed to vertices that do not exist"));
    CHECK_THAT(message_of("a.ply", strips("2 0 1")), Catch::Contains("it holds no triangles"));
    const AttributedMesh numbers = attributes(strips("9 0 1 2 3 -1 2 3 4 5"));
    CHECK(numbers.values == std::vector<double>{1, 2, 3, 4, 5, 6});
    CHECK(signed_area(numbers.mesh) == 32);
}

TEST_CASE("the ends of a text STL are one word or two", "[mesh_dialects]") {
    check_l(from_memory("a.stl", stl("endsolid", "endfacet", "endloop")));
    check_l(from_memory("a.stl", stl("end solid", "endfacet", "endloop")));
    check_l(from_memory("a.stl", stl("End Solid facet", "END FACET", "end\tloop")));
    CHECK_THAT(message_of("a.stl", stl("end part", "endfacet", "endloop")),
               Catch::Contains("line 142: \"part\" where what ends (solid, facet or loop) was expected"));
}

TEST_CASE("a facet's normal may lack numbers", "[mesh_dialects]") {
    for (const std::string normal : {"facet normal", "facet normal nan", "facet normal -nan(ind) 1.#QNAN x",
                                     "facet", "FACET NORMAL 0 0 1", "facet normal 0\n0\n1"}) {
        std::string text = stl("endsolid", "endfacet", "endloop");
        const std::string plain = "facet normal 0 0 0";
        for (std::size_t at = 0; (at = text.find(plain, at)) != std::string::npos; at += normal.size())
            text.replace(at, plain.size(), normal);
        INFO(normal);
        check_l(from_memory("a.stl", text));
    }
}

}  // namespace mesh_rows_test
