// Reading STL, OBJ, PLY and 3MF: real files, files written here, and damaged ones.
#include "engine/io/mesh_reader.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <iterator>
#include <sstream>

#include "engine/base/error.h"
#include "engine/io/model_3mf.h"
#include "engine/mesh/mesh_repair.h"
#include "tests/engine/io/package_samples.h"
#include "tests/engine/mesh/mesh_samples.h"

namespace mesh_reader_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

struct Expected {
    const char* file;
    std::size_t triangles;
    double x, y, z;  // box
};

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& n) { return n.find(text) != std::string::npos; });
}

/// The message with which a file is refused; empty when it is read.
std::string message_of(const std::string& name, const std::string& bytes) {
    try {
        from_memory(name, bytes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TriangleMesh box() { return box_mesh(dvec3(-1.5, 0.25, 2.0), dvec3(3.0, 4.0, 5.5)); }

/// The box was read whole and as it is, in whatever order of vertices.
void check_box(const MeshFile& file, double scale = 1.0) {
    CHECK(file.mesh.vertices.size() == 8);
    CHECK(file.mesh.triangles.size() == 12);
    CHECK(file.mesh.bounds().lo == box().bounds().lo * scale);
    CHECK(file.mesh.bounds().hi == box().bounds().hi * scale);
    CHECK(volume(file.mesh) == Approx(4.5 * 3.75 * 3.5 * scale * scale * scale));
    CHECK(file.notes.empty());
    CHECK(close_mesh(file.mesh).oriented_manifold);
}

std::string ascii_stl(const TriangleMesh& mesh, const std::string& end = "\n") {
    std::string text = "solid box with vertex and facet in its name" + end;
    for (const auto& t : mesh.triangles) {
        text += "  facet normal 0 0 nan" + end + "    outer loop" + end;
        for (const std::uint32_t v : t) {
            const dvec3 p = mesh.vertices[v];
            text += "      vertex " + number(p.x) + " " + number(p.y) + " " + number(p.z) + end;
        }
        text += "    endloop" + end + "  endfacet" + end;
    }
    return text + "endsolid box" + end;
}

std::string obj(const TriangleMesh& mesh) {
    std::string text = "# a box\nmtllib none.mtl\no box\n";
    for (const dvec3& p : mesh.vertices) {
        text += "v " + number(p.x) + " " + number(p.y) + " " + number(p.z) + " 1 0 0\n";
    }
    text += "vn 0 0 1\nvt 0 0\ng a b\ns off\n";
    for (const auto& [a, b, c] : mesh.triangles) {
        text += "f " + std::to_string(a + 1) + "/1/1 " + std::to_string(b + 1) + "//1 " +
                std::to_string(static_cast<int>(c) - static_cast<int>(mesh.vertices.size())) + "\n";
    }
    return text;
}

enum class Ply { ascii, little, big };

/// Doubles, ushort list lengths, short indices, and things to skip before, between and behind.
std::string ply(const TriangleMesh& mesh, Ply form) {
    const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    std::string out =
        std::string("ply\nformat ") + names[static_cast<int>(form)] +
        " 1.0\ncomment a box\nobj_info none\nelement camera 2\nproperty float view\nproperty list uchar "
        "int numbers\nelement vertex 8\nproperty uchar red\nproperty double z\nproperty double y\n"
        "property float64 x\nproperty list uint8 int16 more\nelement edge 1\nproperty int a\nelement "
        "face 12\nproperty char flag\nproperty list ushort short vertex_indices\nelement tail "
        "1\nproperty int end\nend_header\n";
    const auto put = [&](auto value) {
        if (form == Ply::ascii) {
            out += number(static_cast<double>(value)) + " ";
            return;
        }
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        if (form == Ply::big) std::reverse(std::begin(raw), std::end(raw));
        out.append(raw, sizeof value);
    };
    const auto end_row = [&] {
        if (form == Ply::ascii) out += "\n";
    };
    for (int camera = 0; camera < 2; ++camera) {
        put(1.5F);
        put(static_cast<unsigned char>(camera));
        for (int i = 0; i < camera; ++i) put(std::int32_t{77});
        end_row();
    }
    for (const dvec3& p : mesh.vertices) {
        put(static_cast<unsigned char>(200));
        put(p.z);
        put(p.y);
        put(p.x);
        put(static_cast<unsigned char>(2));
        put(std::int16_t{-5});
        put(std::int16_t{5});
        end_row();
    }
    put(std::int32_t{9});
    end_row();
    for (const auto& t : mesh.triangles) {
        put(static_cast<signed char>(-1));
        put(std::uint16_t{3});
        for (const std::uint32_t v : t) put(static_cast<std::int16_t>(v));
        end_row();
    }
    put(std::int32_t{1});
    return out;
}

}  // namespace

TEST_CASE("real files are read with their triangles and boxes") {
    const Expected expected = GENERATE(values<Expected>({
        {"cube_gears.3mf", 25668, 168.0, 125.1, 33.6},
        {"cube_leading_space_crlf.stl", 12, 2.0, 2.0, 2.0},
        {"featuretype.3mf", 2208, 127.0, 63.5, 34.93},
        {"featuretype.stl", 3476, 5.0, 2.5, 1.375},
        {"fish_mm.obj", 1886, 28.43, 58.29, 35.09},
        {"fixed_top.ply", 4772, 120.0, 10.0, 120.0},
        {"negative_indices.obj", 12, 2.0, 2.0, 2.0},
        {"plate_holes.stl", 1252, 203.2, 304.8, 12.7},
        {"sphere_20mm.stl", 1360, 20.0, 20.0, 20.0},
        {"spot_quads.obj", 372, 1.172, 1.743, 1.774},
        {"torus.3mf", 2200, 24.0, 23.95, 3.959},
        {"two_solids.stl", 24, 6.0, 1.0, 1.0},
    }));
    INFO(expected.file);
    const MeshFile file = read_mesh(model(std::string("good/") + expected.file));
    CHECK(file.mesh.triangles.size() == expected.triangles);
    const dvec3 size = file.mesh.bounds().size();
    CHECK(size.x == Approx(expected.x).epsilon(1e-3));
    CHECK(size.y == Approx(expected.y).epsilon(1e-3));
    CHECK(size.z == Approx(expected.z).epsilon(1e-3));
    // Only the gears have something to say: 24 triangles with two corners at one place.
    CHECK(file.notes.size() == (std::string(expected.file) == "cube_gears.3mf" ? 1 : 0));
}

TEST_CASE("broken files are refused with one message or read with a note") {
    const auto [name, expected] = GENERATE(table<const char*, const char*>({
        {"crash.ply", "line 7: \"???\" is no PLY type"},
        {"degenerate_mesh.obj", "every triangle is degenerate"},
        {"empty.obj", "the file is empty"},
        {"empty.ply", "the file is empty"},
        {"zero_bytes.stl", "the file is empty"},
        {"empty_binary.stl", "it holds no triangles"},
        {"empty_solid.stl", "it holds no triangles"},
        {"inf_nan.obj", "every corner position is NaN, infinite"},
        {"deg_faces.obj", "note: 1 of 4 triangles was degenerate"},
        {"nan_inf_vertex.stl", "note: 2 of 1,360 triangles had NaN, infinite"},
        {"truncated.stl",
         "note: the file is cut off: its header announces 2,156 triangles, only 1,198 are there"},
        {"trailing_byte.stl", "note: 1 byte after the last of the "},
        {"not_enough_indices.obj",
         "note: 1 of 2 faces had fewer than 3 corners and was left out (on line 9)"},
        {"malformed.obj",
         "note: 2 of 6 faces pointed to vertices that do not exist and were left out (the first on line 23)"},
        {"thingi_68254.stl", "note: 10 of 126 triangles were degenerate"},
    }));
    const std::string path = model(std::string("broken/") + name);
    std::string said;
    try {
        for (const std::string& note : read_mesh(path).notes) said += "note: " + note;
    } catch (const InputError& error) {
        said = error.what();
        CHECK(said.find(path + ": ") == 0);
    }
    INFO(said);
    CHECK(said.find(expected) != std::string::npos);
}

TEST_CASE("one box reads the same from every format, under any name") {
    for (const std::string name : {"a.stl", "b.obj", "c.ply", "d.3mf", "e"}) {
        INFO(name);
        if (name != "b.obj") check_box(from_memory(name, binary_stl(box())));
        check_box(from_memory(name, binary_stl(box(), "solid but binary")));
        check_box(from_memory(name, ascii_stl(box())));
        check_box(from_memory(name, ply(box(), Ply::ascii)));
        check_box(from_memory(name, ply(box(), Ply::little)));
        check_box(from_memory(name, ply(box(), Ply::big)));
        check_box(from_memory(name, threemf(object_xml("1", box()), "<item objectid=\"1\"/>")));
    }
    check_box(from_memory("a.obj", obj(box())));
    check_box(from_memory("a", obj(box())));
}

TEST_CASE("the unit scales every format but 3MF") {
    const MeshReadOptions halves{0.5};
    check_box(from_memory("a", binary_stl(box()), halves), 0.5);
    check_box(from_memory("a", ascii_stl(box()), halves), 0.5);
    check_box(from_memory("a", obj(box()), halves), 0.5);
    check_box(from_memory("a", ply(box(), Ply::little), halves), 0.5);
    check_box(from_memory("a", threemf(object_xml("1", box()), "<item objectid=\"1\"/>"), halves), 1.0);
    CHECK_THROWS_AS(from_memory("a", obj(box()), {0.0}), InputError);
    CHECK_THROWS_AS(from_memory("a", obj(box()), {-1.0}), InputError);
    CHECK_THROWS_AS(from_memory("a", obj(box()), {std::nan("")}), InputError);
}

TEST_CASE("a text STL may be in capitals, have any line ends and several solids") {
    std::string capitals = ascii_stl(box(), "\r\n");
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](char c) { return static_cast<char>(std::toupper(c)); });
    check_box(from_memory("a.stl", capitals));
    check_box(from_memory("a.stl", ascii_stl(box(), "\r")));
    check_box(from_memory("a.stl", "\xef\xbb\xbf  " + ascii_stl(box())));
    TriangleMesh first = box();
    TriangleMesh second = box();
    first.triangles.resize(5);
    second.triangles.erase(second.triangles.begin(), second.triangles.begin() + 5);
    check_box(from_memory("a.stl", ascii_stl(first) + ascii_stl(second)));
}

TEST_CASE("mistakes in text files are named with their line") {
    const std::string facet = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    CHECK(message_of("a.stl", facet + "vertex 0 1,5 0\nendloop\nendfacet\nendsolid\n") ==
          "a.stl: line 6: \"1,5\" where a coordinate (three numbers follow \"vertex\") was expected");
    CHECK(message_of("a.stl", facet + "endloop\nendfacet\nendsolid\n")
              .find("line 6: a facet with only 2 corners") != std::string::npos);
    CHECK(message_of("a.stl", facet + "vertex 0 0 1\nvertex 0 0 2\nendloop\n")
              .find("line 7: a fourth corner") != std::string::npos);
    CHECK(message_of("a.stl", "solid a\nhello world\n").find("line 2: \"hello\" where a keyword") !=
          std::string::npos);
    CHECK(message_of("a.obj", "v 0 0 0\nv 0 zero 0\n").find("a.obj: line 2: \"zero\" is not a number") == 0);
    CHECK(message_of("a.obj", "v 0 0 0\nv 0 1\n").find("line 2: a coordinate is missing") !=
          std::string::npos);
    CHECK(message_of("a.obj", "v 0 0 0\nv 0 1 2\n").find("no faces") != std::string::npos);
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    CHECK(message_of("a.ply", head + "end_header\n0 0 q \n").find("line 8: \"q\" is not a number") !=
          std::string::npos);
    CHECK(message_of("a.ply", head + "property quad w\n").find("line 7: \"quad\" is no PLY type") !=
          std::string::npos);
    CHECK(message_of("a.ply", head + "end_header\n0 0 1\n").find("points but no faces") != std::string::npos);
    CHECK(message_of("a.ply", head + "element tristrips 0\nproperty int vertex_indices\nend_header\n0 0 1\n")
              .find("its strips of triangles lack the list property vertex_indices") != std::string::npos);
}

TEST_CASE("files of other kinds are refused by name") {
    CHECK(message_of("a.step", "ISO-10303-21;\nHEADER;").find("STEP") != std::string::npos);
    CHECK(message_of("a.txt", "hello").find("STL, OBJ, PLY or 3MF") != std::string::npos);
    CHECK(message_of("a.3mf", "hello").find("ZIP") != std::string::npos);
    CHECK(message_of("a.ply", "hello").find("\"ply\"") != std::string::npos);
    CHECK(message_of("a.stl", "hello").find("only 5 bytes") != std::string::npos);
    CHECK(message_of("a.obj", "hello").find("no faces") != std::string::npos);
    CHECK_THROWS_WITH(read_mesh(model("missing.stl")), Catch::Contains("missing.stl: cannot be opened"));
    CHECK_THROWS_WITH(read_mesh(model("good")), Catch::Contains("this is a folder"));
}

TEST_CASE("a binary STL's wrong count is mended from the length") {
    std::string bytes = binary_stl(box());
    bytes[80] = 0;
    const MeshFile unset = from_memory("a.stl", bytes);
    CHECK(unset.mesh.triangles.size() == 12);
    CHECK(mentions(unset.notes, "announces 0 triangles, but 12 follow"));
    bytes[80] = 10;
    const MeshFile fewer = from_memory("a.stl", bytes);
    CHECK(fewer.mesh.triangles.size() == 12);
    CHECK(volume(fewer.mesh) == Approx(volume(box())));
    CHECK(mentions(fewer.notes, "announces 10 triangles, but 12 follow; all of them were read"));
    bytes[80] = 13;
    const MeshFile more = from_memory("a.stl", bytes);
    CHECK(more.mesh.triangles.size() == 12);
    CHECK(mentions(more.notes, "announces 13 triangles, only 12 are there whole"));
    // What follows the triangles need not be triangles: padding, a text, or a part of one.
    bytes[80] = 12;
    for (const std::string& rest : {std::string(50, '\0'), std::string(100, '\xff'), std::string(7, 'x')}) {
        const MeshFile padded = from_memory("a.stl", bytes + rest);
        CHECK(padded.mesh.triangles.size() == 12);
        CHECK(
            mentions(padded.notes, std::to_string(rest.size()) +
                                       " bytes after the last of the 12 triangles that the header announces "
                                       "were ignored"));
    }
}

TEST_CASE("polygons are cut so that they keep their area, concave ones too") {
    const int points = GENERATE(2, 3, 8, 16, 40, 300);
    const std::vector<dvec2> polygon =
        points == 2 ? std::vector<dvec2>{{0, 0}, {4, 0}, {4, 4}, {3, 1}} : star(points, 0.8);
    std::string text;
    for (const dvec2& p : polygon) text += "v " + number(p.x) + " " + number(p.y) + " 1\n";
    text += "f";
    for (std::size_t i = 1; i <= polygon.size(); ++i)
        text += (i % 7 == 0 ? " \\\n " : " ") + std::to_string(i);
    const MeshFile file = from_memory("a.obj", text + "\n");
    CHECK(file.mesh.triangles.size() == polygon.size() - 2);
    double area = 0.0;
    for (const auto& [a, b, c] : file.mesh.triangles) {
        const dvec3 p = file.mesh.vertices[a];
        const dvec3 normal = glm::cross(file.mesh.vertices[b] - p, file.mesh.vertices[c] - p);
        CHECK(normal.z >= 0.0);
        area += 0.5 * glm::length(normal);
    }
    CHECK(area == Approx(polygon_area(polygon)));
}

TEST_CASE("equal corners become one vertex, minus zero and zero too") {
    const MeshFile file =
        from_memory("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 -0\nv 1 0 0\nv 0 0 1\nf 1 2 3\nf 4 6 5\n");
    CHECK(file.mesh.vertices.size() == 4);
    CHECK(file.mesh.triangles[1][0] == file.mesh.triangles[0][0]);
}

TEST_CASE("odd spellings of numbers are understood") {
    const MeshFile file = from_memory("a.obj",
                                      "v +1.5e+1 .5 5.\nv 1e-999 0 1E1\nv 0 1.#QNAN 0\nv 0 -inf 0\nv 1e999 0 "
                                      "0\nv 1 1 1\nf 1 2 6\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
    CHECK(file.mesh.triangles.size() == 1);
    CHECK(file.mesh.bounds().hi == dvec3(15.0, 1.0, 10.0));
    CHECK(file.mesh.bounds().lo == dvec3(0.0, 0.0, 1.0));
    CHECK(mentions(file.notes, "3 of 4 triangles had NaN, infinite"));
}

TEST_CASE("3MF units, transforms, mirrors and components place the parts") {
    const std::string one = object_xml("7", box());
    check_box(from_memory("a.3mf", threemf(one, "<item objectid=\"7\"/>", "unit=\"centimeter\"")), 10.0);
    CHECK(from_memory("a.3mf", threemf(one, "<item objectid=\"7\"/>", "unit=\"inch\"")).mesh.bounds().hi.x ==
          Approx(3.0 * 25.4));

    // Turned by 90 degrees about z: x' = -y, y' = x; then moved.
    const MeshFile turned =
        from_memory("a.3mf", threemf(one, "<item objectid=\"7\" transform=\"0 1 0 -1 0 0 0 0 1 100 0 0\"/>"));
    CHECK(turned.mesh.bounds().lo == dvec3(96.0, -1.5, 2.0));
    CHECK(turned.mesh.bounds().hi == dvec3(99.75, 3.0, 5.5));
    CHECK(volume(turned.mesh) == Approx(volume(box())));

    const MeshFile mirrored =
        from_memory("a.3mf", threemf(one, "<item objectid=\"7\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>"));
    CHECK(mirrored.mesh.bounds().lo.x == -3.0);
    CHECK(volume(mirrored.mesh) == Approx(volume(box())));

    // Two of it in an assembly (doubled and moved by 10), which itself is moved by 100 and mirrored.
    const std::string assembly =
        one +
        "<object id=\"8\"><components><component objectid=\"7\"/><component objectid=\"7\" transform=\"2 0 0 "
        "0 2 0 0 0 2 10 0 0\"/></components></object>";
    const MeshFile both = from_memory(
        "a.3mf", threemf(assembly, "<item objectid=\"8\" transform=\"-1 0 0 0 1 0 0 0 1 100 0 0\"/>"));
    CHECK(both.mesh.triangles.size() == 24);
    CHECK(both.mesh.bounds().lo == dvec3(100.0 - (2.0 * 3.0 + 10.0), 0.25, 2.0));
    CHECK(both.mesh.bounds().hi == dvec3(101.5, 8.0, 11.0));
    CHECK(volume(both.mesh) == Approx(9.0 * volume(box())));
}

TEST_CASE("a small 3MF whose components multiply its content is refused before it is written out") {
    // 100 x 100 x 100 instances.
    const auto hundredfold = [](const std::string& object) {
        std::string resources = object;
        for (int id = 2; id < 5; ++id) {
            resources += "<object id=\"" + std::to_string(id) + "\"><components>";
            for (int i = 0; i < 100; ++i)
                resources += "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
            resources += "</components></object>";
        }
        return threemf(resources, "<item objectid=\"4\"/>");
    };
    std::string junk;
    for (int i = 0; i < 20'000; ++i) junk += "<a/>";
    const std::string object = "<object id=\"1\">" + junk + "<mesh>" + junk + "</mesh></object>";
    CHECK(message_of("a.3mf", hundredfold(object)).find("more than 30,000,000 elements") !=
          std::string::npos);
    // What a mesh has is counted without being placed, so that this test takes no gigabytes.
    PlacedSize vertices, triangles;
    const MeshSource source{"a.3mf", "", 1.0};
    const ObjectMesh points{std::vector<dvec3>(1'000'000), {}},
        faces{{}, std::vector<std::array<std::uint32_t, 3>>(1'000'000)};
    for (int i = 0; i < 50; ++i) vertices.add(source, points), triangles.add(source, faces);
    CHECK_THROWS_WITH(vertices.add(source, points), Catch::Contains("more than 50,000,000 vertices"));
    CHECK_THROWS_WITH(triangles.add(source, faces), Catch::Contains("more than 50,000,000 triangles"));
}

TEST_CASE("only what the 3MF builds is read, and no supports") {
    const std::string objects = object_xml("1", box()) + object_xml("2", unit_box_at(10.0)) +
                                object_xml("3", unit_box_at(20.0), "type=\"support\"") +
                                object_xml("4", unit_box_at(30.0));
    const MeshFile file = from_memory(
        "a.3mf",
        threemf(objects,
                "<item objectid=\"1\"/><item objectid=\"3\"/><item objectid=\"4\" printable=\"0\"/>"));
    CHECK(file.mesh.triangles.size() == 12);
    CHECK(file.mesh.bounds().hi == box().bounds().hi);
    CHECK(mentions(file.notes, "1 object is support"));
    CHECK(mentions(file.notes, "1 build item is marked as not to be printed"));
}

TEST_CASE("the 3MF root part is found by its relation, and other parts by their path") {
    const std::string relations =
        "<Relationships><Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" "
        "Target=\"/strange/root.model\" Id=\"r\"/></Relationships>";
    const std::string production =
        "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
        "requiredextensions=\"p\"";
    const std::string root = model_xml(
        "<object id=\"1\"><components><component p:path=\"/3D/Objects/one.model\" "
        "objectid=\"5\"/></components></object>",
        "<item objectid=\"1\"/>", production);
    check_box(
        from_memory("a.3mf", zip_of({{"_rels/.rels", relations},
                                     {"strange/root.model", root},
                                     {"3D/Objects/one.model", model_xml(object_xml("5", box()), "")}})));
    CHECK(message_of("a.3mf", zip_of({{"3D/3dmodel.model", root}}))
              .find("the archive has no part \"3D/Objects/one.model\"") != std::string::npos);
    CHECK(message_of("a.3mf", zip_of({{"readme.txt", "hello"}})).find("no part \"3D/3dmodel.model\"") !=
          std::string::npos);
}

TEST_CASE("hostile or mistaken 3MF files are refused with a reason") {
    const std::string one = object_xml("1", box());
    const auto refused = [&](const std::string& resources, const std::string& items,
                             const std::string& attributes = "") {
        return message_of("a.3mf", threemf(resources, items, attributes));
    };
    CHECK_THAT(refused(one, ""), Catch::Contains("lists no items"));
    CHECK_THAT(refused(one, "<item objectid=\"2\"/>"),
               Catch::Contains("object \"2\" is referred to but does not exist"));
    CHECK_THAT(refused(one, "<item objectid=\"1\" transform=\"1 0 0\"/>"), Catch::Contains("12 numbers"));
    CHECK_THAT(refused(one, "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 0 0 0 0\"/>"),
               Catch::Contains("flattens"));
    CHECK_THAT(refused(one, "<item objectid=\"1\"/>", "unit=\"furlong\""),
               Catch::Contains("unknown unit \"furlong\""));
    CHECK_THAT(refused(one, "<item objectid=\"1\"/>",
                       "xmlns:b=\"http://x/beamlattice/2017/02\" requiredextensions=\"b\""),
               Catch::Contains("requires the 3MF extension \"b\" (http://x/beamlattice/2017/02)"));
    const auto group = [](int id, const std::string& parts) {
        return "<object id=\"" + std::to_string(id) + "\"><components>" + parts + "</components></object>";
    };
    const auto part = [](int id) { return "<component objectid=\"" + std::to_string(id) + "\"/>"; };
    CHECK_THAT(refused(group(1, part(2)) + group(2, part(1)), "<item objectid=\"1\"/>"),
               Catch::Contains("contains itself"));
    // A chain that doubles 30 times, and one that is 40 deep.
    std::string doubling = one;
    for (int i = 2; i <= 31; ++i) doubling += group(i, part(i - 1) + part(i - 1));
    CHECK_THAT(refused(doubling, "<item objectid=\"31\"/>"), Catch::Contains("more than"));
    std::string chain = one;
    for (int i = 2; i <= 41; ++i) chain += group(i, part(i - 1));
    CHECK_THAT(refused(chain, "<item objectid=\"41\"/>"), Catch::Contains("32 deep"));
    CHECK_THAT(message_of("a.3mf", zip_of({{"3D/3dmodel.model", "<model><resources>"}})),
               Catch::Contains("not well-formed XML"));
    CHECK_THAT(message_of("a.3mf", zip_of({{"3D/3dmodel.model", "<html/>"}})),
               Catch::Contains("no 3MF model"));
    std::string bad = one;
    bad.replace(bad.find("v1=\"0\""), 6, "v1=\"x\"");
    CHECK_THAT(refused(bad, "<item objectid=\"1\"/>"),
               Catch::Contains("v1=\"x\" of a triangle is not a vertex number"));
    bad = one;
    bad.replace(bad.find("v1=\"0\""), 6, "v1=\"9\"");
    CHECK(mentions(from_memory("a.3mf", threemf(bad, "<item objectid=\"1\"/>")).notes,
                   "1 triangle is pointing to vertices that do not exist"));
}

TEST_CASE("an archive that unpacks to more than half a gibibyte is refused before it fills memory") {
    std::string bytes = threemf(object_xml("1", box()), "<item objectid=\"1\"/>");
    const std::size_t entry = bytes.find("PK\x01\x02");
    REQUIRE(entry != std::string::npos);
    bytes[entry + 27] = '\x21';  // the highest byte of the unpacked size in the directory: 528 MiB
    CHECK_THAT(message_of("a.3mf", bytes), Catch::Contains("unpacks to more than 512 MiB"));
}

TEST_CASE("announced sizes do not make the reader allocate") {
    const std::string vertices =
        "element vertex 4000000000000\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 4000000000000\nproperty list uint int vertex_indices\n";
    for (const std::string form : {"ascii", "binary_little_endian"}) {
        CHECK_THAT(
            message_of("a.ply", "ply\nformat " + form + " 1.0\n" + vertices + faces + "end_header\n1 2 3"),
            Catch::Contains("cut off"));
    }
    CHECK_THAT(message_of("a.ply",
                          "ply\nformat binary_big_endian 1.0\nelement vertex 0\nproperty float x\nproperty "
                          "float y\nproperty float z\n" +
                              faces + "end_header\n\xff\xff\xff\xff"),
               Catch::Contains("impossible length"));
    std::string stl = binary_stl(box());
    for (std::size_t i = 80; i < 84; ++i) stl[i] = '\xff';
    CHECK(from_memory("a.stl", stl).mesh.triangles.size() == 12);
}

TEST_CASE("a file cut off anywhere is read in part or refused, and closes or is refused") {
    const auto [name, bytes] = GENERATE(table<std::string, std::string>({
        {"a.stl", binary_stl(box())},
        {"a.stl", ascii_stl(box())},
        {"a.obj", obj(box())},
        {"a.ply", ply(box(), Ply::ascii)},
        {"a.ply", ply(box(), Ply::little)},
        {"a.ply", ply(box(), Ply::big)},
        {"a.3mf", threemf(object_xml("1", box()), "<item objectid=\"1\"/>")},
    }));
    std::size_t read = 0;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        try {
            const MeshFile file = from_memory(name, bytes.substr(0, length));
            CHECK(file.mesh.triangles.size() <= 12);
            ++read;
            close_mesh(file.mesh, name);
        } catch (const InputError& error) {
            INFO(error.what());
            CHECK(std::string(error.what()).find(name + ": ") == 0);
        }
    }
    CHECK((read > 0 || name == "a.3mf"));
}

}  // namespace mesh_reader_test
