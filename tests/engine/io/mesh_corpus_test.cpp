// A corpus of dialects: one solid of known volume, area and size in every form that programs write it.
#include "engine/base/error.h"
#include "engine/mesh/mesh_repair.h"
#include "tests/engine/io/dialect_files.h"

namespace mesh_corpus_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

double area_of(const TriangleMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const dvec3 normal =
            glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        area += std::sqrt(glm::dot(normal, normal)) / 2;
    }
    return area;
}

/// The file is the L, whole, closed and turned outwards; `note` is part of its only note, empty for none.
void check_l(const std::string& what, const std::string& name, const std::string& bytes,
             const std::string& note = "", double scale = 1, MeshReadOptions options = {}) {
    INFO(what << ", " << name);
    const MeshFile file = from_memory(name, bytes, options);
    CHECK(file.mesh.triangles.size() == 20);
    CHECK(volume(file.mesh) == Approx(l_volume * scale * scale * scale).epsilon(1e-6));
    CHECK(area_of(file.mesh) == Approx(l_area * scale * scale).epsilon(1e-6));
    const dvec3 size = file.mesh.bounds().size();
    CHECK(size.x == Approx(10 * scale).epsilon(1e-6));
    CHECK(size.y == Approx(12 * scale).epsilon(1e-6));
    CHECK(size.z == Approx(8 * scale).epsilon(1e-6));
    CHECK(close_mesh(file.mesh).oriented_manifold);
    std::string said;
    for (const std::string& text : file.notes) said += text + "\n";
    INFO(said);
    CHECK(file.notes.size() == (note.empty() ? 0 : 1));
    CHECK(said.find(note) != std::string::npos);
}

/// The faces of the L as they are: six walls of four corners, two ends of six.
std::vector<std::vector<int>> polygons() {
    std::vector<std::vector<int>> faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (int i = 0; i < 6; ++i) faces.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
    return faces;
}

std::vector<std::vector<int>> triangles() {
    std::vector<std::vector<int>> faces;
    for (const auto& [a, b, c] : l_shape().triangles)
        faces.push_back({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
    return faces;
}

std::string point(const dvec3& p) { return number(p.x) + " " + number(p.y) + " " + number(p.z); }

std::string stl_text(const std::string& normal, const std::string& name, std::size_t solids = 1) {
    const TriangleMesh mesh = l_shape();
    std::string text;
    for (std::size_t k = 0; k < solids; ++k) {
        text += "solid" + name + "\n";
        for (std::size_t i = k; i < mesh.triangles.size(); i += solids) {
            text += "  facet" + normal + "\n    outer loop\n";
            for (const std::uint32_t v : mesh.triangles[i])
                text += "      vertex " + point(mesh.vertices[v]) + "\n";
            text += "    endloop\n  endfacet\n";
        }
        text += "endsolid" + name + "\n";
    }
    return text;
}

std::string obj_text(const std::vector<std::vector<int>>& faces, const std::string& vertex_end,
                     const std::string& corner_end, bool negative = false) {
    std::string text = "# facets and vertices: f 1 2 3\nmtllib a.mtl\no f v vertex\ng v f\ns 1\n";
    for (const dvec3& p : l_shape().vertices) text += "v " + point(p) + vertex_end + "\n";
    text += "vn nan 0 1\nvt 0.5 0.5\nusemtl f\n";
    for (const auto& face : faces) {
        text += "f";
        for (const int v : face) text += " " + std::to_string(negative ? v - 12 : v + 1) + corner_end;
        text += "\n";
    }
    return text;
}

/// What a PLY holds beside the plain vertices and faces.
struct PlyDialect {
    const char* name;
    PlyBody::Form form;
    std::vector<std::vector<int>> faces;
    bool at_vertices = false;  ///< normals and colours, and a list, in rows of vertices
    bool around = false;       ///< elements before, between and behind
    bool strips = false;
    int announced_faces = 0;  ///< beyond those that are there
};

/// Writes coordinates as T, and list lengths and corners as Length and Index.
template <typename T, typename Length, typename Index>
std::string ply(const PlyDialect& dialect, const std::string& t, const std::string& length,
                const std::string& index) {
    std::string head = std::string("ply\nformat ") + PlyBody::name(dialect.form) +
                       " 1.0\ncomment element vertex 3 end_header\nobj_info property list\n";
    PlyBody body(dialect.form);
    if (dialect.around) {
        head += "element camera 1\nproperty float view\nproperty list uchar int counts\n";
        body.put(1.5F)
            .put(static_cast<unsigned char>(2))
            .put(std::int32_t{3})
            .put(std::int32_t{-1})
            .end_row();
    }
    head += "element vertex 12\n";
    if (dialect.at_vertices)
        head += "property uchar red\nproperty float nx\nproperty list uchar short tags\n";
    for (const char* const axis : {"x", "y", "z"}) head += "property " + t + " " + axis + "\n";
    if (dialect.at_vertices) head += "property double quality\n";
    for (const dvec3& p : l_shape().vertices) {
        if (dialect.at_vertices) {
            body.put(static_cast<unsigned char>(200)).put(std::nanf("")).put(static_cast<unsigned char>(1));
            body.put(std::int16_t{-7});
        }
        body.put(static_cast<T>(p.x)).put(static_cast<T>(p.y)).put(static_cast<T>(p.z));
        if (dialect.at_vertices) body.put(0.25);
        body.end_row();
    }
    if (dialect.around) {
        head += "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
        body.put(std::int32_t{0}).put(std::int32_t{1});
        body.end_row();
    }
    const auto put_list = [&](const std::vector<int>& list) {
        body.put(static_cast<Length>(list.size()));
        for (const int v : list) body.put(static_cast<Index>(v));
        if (dialect.at_vertices) body.put(static_cast<unsigned char>(9));
        body.end_row();
    };
    const int rows = dialect.strips ? 1 : static_cast<int>(dialect.faces.size());
    head += std::string("element ") + (dialect.strips ? "tristrips " : "face ") +
            std::to_string(rows + dialect.announced_faces) + "\nproperty list " + length + " " + index + " " +
            (dialect.around ? "vertex_index" : "vertex_indices") + "\n";
    if (dialect.at_vertices) head += "property uchar flags\n";
    if (dialect.strips) {
        std::vector<int> strip;
        for (int i = 0; i <= 6; ++i) strip.insert(strip.end(), {i % 6 + 6, i % 6});
        for (int i = 1; i < 5; ++i) strip.insert(strip.end(), {-1, 0, i + 1, i, -1, 6, 6 + i, 7 + i});
        put_list(strip);
    } else {
        for (const auto& face : dialect.faces) put_list(face);
    }
    if (dialect.around) {
        head += "element tail 2\nproperty double end\n";
        for (int i = 0; i < 2; ++i) body.put(1.0).end_row();
    }
    return head + "end_header\n" + body.bytes();
}

}  // namespace

TEST_CASE("corpus: text STL in every layout", "[corpus]") {
    for (const auto& [name, style] : text_styles()) {
        check_l(name, "a.stl", styled(stl_text(" normal 0 0 1", " part"), style));
        check_l(name, "a", styled(stl_text(" normal nan nan nan", " vertex facet outer endsolid"), style));
        check_l(name, "a.obj", styled(stl_text(" normal -nan(ind) 1.#QNAN inf", ""), style));
        check_l(name, "a.stl", styled(stl_text("", " two", 2), style));
    }
    const std::string whole = stl_text(" normal 0 0 1", " part");
    check_l("no endsolid", "a.stl", whole.substr(0, whole.find("endsolid")));
    check_l("inches", "a.stl", whole, "", 25.4, {25.4});
}

TEST_CASE("corpus: binary STL, whatever its header says", "[corpus]") {
    const std::string plain = binary_stl(l_shape());
    check_l("plain", "a.stl", plain);
    check_l("another ending", "a.txt", plain);
    check_l("a header that begins like a text", "a.stl",
            binary_stl(l_shape(), "solid facet normal vertex\n"));
    check_l("a header that begins with a byte order mark", "a.stl",
            binary_stl(l_shape(), "\xef\xbb\xbfsolid"));
    std::string bytes = plain;
    for (std::size_t i = 0; i < 20; ++i) {
        bytes.replace(84 + 50 * i, 12, std::string(12, '\xff'));  // normals that are NaN
        bytes.replace(84 + 50 * i + 48, 2, "\x7f\x12");           // colours
    }
    check_l("normals that are NaN, and colours", "a.stl", bytes);
    const auto announcing = [&](unsigned count) {
        std::string other = plain;
        for (int i = 0; i < 4; ++i)
            other[80 + static_cast<std::size_t>(i)] = static_cast<char>(count >> (8 * i));
        return other;
    };
    check_l("no count", "a.stl", announcing(0), "the header announces 0 triangles, but 20 follow");
    check_l("too few", "a.stl", announcing(1), "the header announces 1 triangle, but 20 follow");
    check_l("too few", "a.stl", announcing(19), "the header announces 19 triangles, but 20 follow");
    check_l("too many", "a.stl", announcing(21), "announces 21 triangles, only 20 are there whole");
    check_l("far too many", "a.stl", announcing(0xffffffffU), "only 20 are there whole");
    check_l("bytes behind", "a.stl", plain + "made by a program", "17 bytes after the last");
}

TEST_CASE("corpus: OBJ in every layout, with triangles, quads and hexagons", "[corpus]") {
    for (const auto& faces : {triangles(), polygons()}) {
        for (const auto& [name, style] : text_styles()) {
            check_l(name, "a.obj", styled(obj_text(faces, "", ""), style));
            check_l(name, "a", styled(obj_text(faces, " 0.5 0.25 1", "/1/1"), style));
            check_l(name, "a.obj", styled(obj_text(faces, " 1.0", "//1", true), style));
        }
    }
    std::string text = obj_text(polygons(), "", "");
    text.replace(text.find("f 6 5 4 3 2 1"), 13, "f 6 5 4 \\\n 3 2 1  # an end");
    check_l("a face over two lines, and a comment", "a.obj", text);
    check_l("centimetres", "a.obj", text, "", 10, {10});
}

TEST_CASE("corpus: PLY in every layout", "[corpus]") {
    using Form = PlyBody::Form;
    for (const auto& faces : {triangles(), polygons()}) {
        const std::string text = ply<double, int, int>({"", Form::ascii, faces}, "double", "uchar", "int");
        for (const auto& [name, style] : text_styles()) check_l(name, "a.ply", styled(text, style));
    }
}

TEST_CASE("corpus: PLY in every encoding, with every kind of data", "[corpus]") {
    using Form = PlyBody::Form;
    for (const Form form : {Form::ascii, Form::little, Form::big}) {
        const std::vector<PlyDialect> dialects{{"triangles", form, triangles()},
                                               {"quads and hexagons", form, polygons()},
                                               {"data at vertices", form, triangles(), true},
                                               {"elements around", form, polygons(), false, true},
                                               {"both", form, polygons(), true, true},
                                               {"strips", form, {}, false, false, true},
                                               {"strips and all", form, {}, true, true, true}};
        for (const PlyDialect& dialect : dialects) {
            const std::string what = std::string(dialect.name) + ", " + PlyBody::name(form);
            check_l(what, "a.ply", ply<float, unsigned char, std::int32_t>(dialect, "float", "uchar", "int"));
            check_l(what, "a",
                    ply<double, std::uint32_t, std::int16_t>(dialect, "float64", "uint32", "int16"));
            check_l(what, "a.ply",
                    ply<float, std::int16_t, signed char>(dialect, "float32", "short", "char"));
            check_l(what, "a.ply",
                    ply<std::int16_t, std::uint16_t, float>(dialect, "int16", "ushort", "float"));
            if (!dialect.strips)
                check_l(what, "a.stl",
                        ply<float, std::int32_t, std::uint32_t>(dialect, "float", "int", "uint"));
        }
        const std::string what = PlyBody::name(form);
        check_l(what, "a.ply",
                ply<float, unsigned char, std::int32_t>({"", form, triangles(), false, false, false, 5},
                                                        "float", "uchar", "int"),
                "announces 25 face elements, only 20 are there whole");
        std::vector<std::vector<int>> more = triangles();
        more.push_back({0, 1, 2});
        const std::string fewer = ply<float, unsigned char, std::int32_t>(
            {"", form, more, false, false, false, -1}, "float", "uchar", "int");
        check_l(what, "a.ply", fewer,
                form == Form::ascii ? "7 bytes behind all that the header announces were ignored"
                                    : "13 bytes behind all that the header announces were ignored");
        // A strip's restart as the greatest number of a type without a sign.
        check_l(what, "a.ply",
                ply<float, std::int32_t, unsigned char>(
                    {"", form == Form::ascii ? Form::little : form, {}, false, false, true}, "float", "int",
                    "uchar"));
    }
}

TEST_CASE("corpus: 3MF in every kind of archive", "[corpus]") {
    const std::string model = model_xml(object_xml("1", l_shape()), "<item objectid=\"1\"/>");
    const std::string relations =
        "<Relationships><Relationship Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\" "
        "Target=\"/3D/3dmodel.model\" Id=\"r\"/></Relationships>";
    for (const bool deflated : {false, true}) {
        const std::string how = deflated ? "deflated" : "stored";
        const auto zip = [&](ZipVariant variant) {
            variant.deflated = deflated;
            return zip_by_hand({{"[Content_Types].xml", "<Types/>"},
                                {"_rels/.rels", relations},
                                {"3D/", ""},
                                {"3D/3dmodel.model", model}},
                               variant);
        };
        check_l(how, "a.3mf", zip({}));
        check_l(how + ", another ending", "a.stl", zip({}));
        check_l(how + ", data descriptors", "a.3mf", zip({true, true, true}));
        check_l(how + ", data descriptors without a signature", "a.3mf", zip({true, true, false}));
        check_l(how + ", an extra field", "a.3mf",
                zip({true, false, true, std::string("\x55\x58\4\0abcd", 8)}));
        check_l(how + ", a comment", "a.3mf", zip({true, false, true, "", "made by hand"}));
        const auto alone = [&](const std::string& name) {
            ZipVariant variant;
            variant.deflated = deflated;
            return zip_by_hand({{name, model}}, variant);
        };
        check_l(how + ", the model alone", "a.3mf", alone("3D/3dmodel.model"));
        check_l(how + ", capitals", "a.3mf", alone("3d/3DModel.MODEL"));
    }
}

TEST_CASE("corpus: 3MF XML in every layout", "[corpus]") {
    const std::string core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
    const std::string model = model_xml(object_xml("1", l_shape()), "<item objectid=\"1\"/>");
    const auto packed = [](const std::string& xml) { return zip_of({{"3D/3dmodel.model", xml}}); };
    check_l("plain", "a.3mf", packed(model));
    check_l("a byte order mark", "a.3mf", packed("\xef\xbb\xbf" + model));
    check_l("carriage returns", "a.3mf", packed(styled(model, {"\r\n"})));
    std::string sixteen = "\xff\xfe";
    for (const char c : model) (sixteen += c) += '\0';
    check_l("UTF-16", "a.3mf", packed(sixteen));
    std::string prefixed;
    for (std::size_t i = 0; i < model.size(); ++i) {
        prefixed += model[i];
        if (model[i] != '<' || model[i + 1] == '?') continue;
        if (model[i + 1] == '/') prefixed += model[++i];
        prefixed += "m:";
    }
    prefixed.replace(prefixed.find("xmlns="), 6, "xmlns:m=");
    check_l("a prefix", "a.3mf", packed(prefixed));
    std::string single = model;
    std::replace(single.begin(), single.end(), '"', '\'');
    check_l("single quotes", "a.3mf", packed(single));
    const std::string commented = "<!-- <mesh> --><?program <mesh> ?>";
    std::string noisy = model;
    for (const std::string tag : {"<mesh>", "<vertices>", "<triangles>", "<build>", "<resources>"})
        noisy.insert(noisy.find(tag) + tag.size(), commented);
    check_l("comments", "a.3mf", packed(noisy));
    REQUIRE(model.find(core) != std::string::npos);
}

TEST_CASE("corpus: 3MF units, components and mirrors", "[corpus]") {
    const std::string one = object_xml("1", l_shape());
    const std::vector<std::pair<std::string, double>> units{{"micron", 0.001},  {"millimeter", 1},
                                                            {"centimeter", 10}, {"inch", 25.4},
                                                            {"foot", 304.8},    {"meter", 1000}};
    for (const auto& [unit, mm] : units) {
        check_l(unit, "a.3mf", threemf(one, "<item objectid=\"1\"/>", "unit=\"" + unit + "\""), "", mm);
        check_l(unit + ", the option is for other formats", "a.3mf",
                threemf(one, "<item objectid=\"1\"/>", "unit=\"" + unit + "\""), "", mm, {7});
    }
    const auto assembly = [&](const std::string& inner, const std::string& outer) {
        return threemf(one + "<object id=\"2\"><components><component objectid=\"1\" transform=\"" + inner +
                           "\"/></components></object>",
                       "<item objectid=\"2\" transform=\"" + outer + "\"/>");
    };
    const std::string same = "1 0 0 0 1 0 0 0 1 5 6 7", mirror = "-1 0 0 0 1 0 0 0 1 0 0 0",
                      point_mirror = "-1 0 0 0 -1 0 0 0 -1 1 2 3", doubled = "2 0 0 0 2 0 0 0 2 0 0 0";
    check_l("moved", "a.3mf", assembly(same, same));
    check_l("mirrored inside", "a.3mf", assembly(mirror, same));
    check_l("mirrored outside", "a.3mf", assembly(same, mirror));
    check_l("mirrored twice", "a.3mf", assembly(mirror, mirror));
    check_l("mirrored at a point", "a.3mf", assembly(point_mirror, doubled), "", 2);
    check_l("mirrored and doubled", "a.3mf", assembly(doubled, "1 0 0 0 1 0 0 0 -1 0 0 0"), "", 2);
}

TEST_CASE("corpus: decimal commas and commas between numbers are refused with their line", "[corpus]") {
    const auto message = [](const std::string& name, const std::string& bytes) -> std::string {
        try {
            from_memory(name, bytes);
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing was refused";
    };
    const auto changed = [](std::string text, const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        return text.replace(at, from.size(), to);
    };
    const std::string stl = stl_text(" normal 0 0 1", ""), obj = obj_text(triangles(), "", "");
    const std::string text =
        ply<double, int, int>({"", PlyBody::Form::ascii, triangles()}, "double", "uchar", "int");
    CHECK_THAT(message("a.stl", changed(stl, "vertex 10 0 0", "vertex 10,0 0,0 0,0")),
               Catch::Contains("line 5: \"10,0\" where a coordinate"));
    CHECK_THAT(message("a.stl", changed(stl, "vertex 10 0 0", "vertex 10, 0, 0")),
               Catch::Contains("line 5: \"10,\""));
    CHECK_THAT(message("a.obj", changed(obj, "v 10 0 0", "v 10,0 0,0 0,0")),
               Catch::Contains("line 7: \"10,0\" is not a number; \"v\" is followed by three of them, with a "
                               "decimal point"));
    CHECK_THAT(message("a.ply", changed(text, "\n10 0 0\n", "\n10,0 0,0 0,0\n")),
               Catch::Contains("line 13: \"10,0\" is not a number"));
}

}  // namespace mesh_corpus_test
