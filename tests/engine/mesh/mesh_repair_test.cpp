// Closing meshes: against brute-force winding numbers, closed-form volumes and every broken file.
#include "engine/mesh/mesh_repair.h"

#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <set>

#include "engine/base/error.h"
#include "engine/io/mesh_reader.h"
#include "tests/engine/mesh/mesh_samples.h"

namespace mesh_repair_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

/// Every directed edge occurs as often as its reverse.
bool has_no_boundary(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> net;
    for (const auto& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            ++net[{t[i], t[(i + 1) % 3]}];
            --net[{t[(i + 1) % 3], t[i]}];
        }
    }
    return std::all_of(net.begin(), net.end(), [](const auto& entry) { return entry.second == 0; });
}

/// Sum of the signed solid angles of the triangles over 4 pi (van Oosterom and Strackee 1983).
double winding_number(const TriangleMesh& mesh, dvec3 p) {
    double sum = 0.0;
    for (const auto& t : mesh.triangles) {
        const dvec3 a = mesh.vertices[t[0]] - p;
        const dvec3 b = mesh.vertices[t[1]] - p;
        const dvec3 c = mesh.vertices[t[2]] - p;
        const double la = glm::length(a);
        const double lb = glm::length(b);
        const double lc = glm::length(c);
        const double above = glm::dot(a, glm::cross(b, c));
        const double below = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        sum += 2.0 * std::atan2(above, below);
    }
    return sum / (4.0 * 3.14159265358979323846);
}

/// Triangles by their corners' positions, rotated so that the least comes first, in order.
std::multiset<std::array<std::array<double, 3>, 3>> as_set(const TriangleMesh& mesh) {
    std::multiset<std::array<std::array<double, 3>, 3>> out;
    for (const auto& t : mesh.triangles) {
        std::array<std::array<double, 3>, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = {mesh.vertices[t[i]].x, mesh.vertices[t[i]].y, mesh.vertices[t[i]].z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        out.insert(corners);
    }
    return out;
}

bool mentions(const std::vector<std::string>& notes, const std::string& text) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& n) { return n.find(text) != n.npos; });
}

std::string message_of(const TriangleMesh& mesh, const std::string& name) {
    try {
        close_mesh(mesh, name);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TriangleMesh unit_box() { return box_mesh(dvec3(0.0), dvec3(1.0)); }

double cap_area(const SolidMesh& solid) {
    double area = 0.0;
    for (std::size_t t = solid.mesh.triangles.size() - solid.caps; t < solid.mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = solid.mesh.triangles[t];
        const dvec3 p = solid.mesh.vertices[a];
        area += 0.5 * glm::length(glm::cross(solid.mesh.vertices[b] - p, solid.mesh.vertices[c] - p));
    }
    return area;
}

/// mt19937 with results of 32 bits by type, as well.
struct Random {
    using result_type = std::uint32_t;
    explicit Random(unsigned seed) : engine(seed) {}
    static constexpr result_type min() { return 0; }
    static constexpr result_type max() { return 0xffffffffU; }
    result_type operator()() { return static_cast<result_type>(engine()); }
    std::mt19937 engine;
};

struct Expected {
    const char* file;
    std::size_t triangles, caps;
    bool oriented_manifold;
    double volume;
    const char* note;  // a piece of one of the notes; empty: no notes at all
};

}  // namespace

TEST_CASE("every broken file that holds a solid gives that solid, closed") {
    const Expected expected = GENERATE(values<Expected>({
        {"flipped_every_7th.stl", 1252, 0, true, 767362.0, "179 triangles faced the other way"},
        {"header_invalid_unicode.stl", 12, 0, true, 8.0, ""},
        {"inside_out_sphere.stl", 1360, 0, true, 4129.37, "inside out"},
        {"multibody.stl", 32, 0, true, 0.00742322, "faced the other way"},
        {"nan_inf_vertex.stl", 1360, 2, false, 4129.37, "2 holes were closed"},
        {"openscad_nonmanifold.obj", 1438, 0, false, 451.96, "back to back"},
        {"sphere_with_hole.stl", 288, 3, false, 13.5816, "3 holes were closed"},
        {"thingi_61460.stl", 108, 0, true, 6898.53, "back to back"},
        {"thingi_63506.stl", 132, 0, true, 17153.2, "4 corners along open seams"},
        {"thingi_68251.stl", 164, 0, false, 4491.6, ""},
        {"thingi_68254.stl", 116, 0, true, 2713.3, ""},
        {"thingi_68256.stl", 80, 0, true, 9564.06, "2 closed surfaces were inside out"},
        {"thingi_68435.stl", 204, 22, false, 3263.99, "2 holes were closed"},
        {"thingi_70375.stl", 40, 0, true, 1132.0, "open seams"},
        {"thingi_71987.stl", 120, 0, true, 4878.87, ""},
        {"thingi_73340.stl", 168, 0, true, 35349.3, "faced the other way"},
        {"thingi_90225.stl", 172, 0, true, 54766.3, ""},
        {"thingi_93068.stl", 30, 0, true, 46537.6, ""},
        {"thingi_97171.stl", 228, 0, true, 16992.6, "open seams"},
        {"trailing_byte.stl", 288, 0, true, 2.34315, ""},
        {"truncated.stl", 1196, 0, true, 219778.0, "1 flat sheet"},
        {"wallhole.obj", 66, 0, true, 1066.67, ""},
        {"malformed.obj", 8, 3, false, 0.5, "faced the other way"},
    }));
    INFO(expected.file);
    const SolidMesh solid = close_mesh(read_mesh(model(std::string("broken/") + expected.file)).mesh);
    CHECK(has_no_boundary(solid.mesh));
    CHECK(solid.mesh.triangles.size() == expected.triangles);
    CHECK(solid.caps == expected.caps);
    CHECK(solid.oriented_manifold == expected.oriented_manifold);
    CHECK(volume(solid.mesh) == Approx(expected.volume).epsilon(1e-5));
    CHECK((*expected.note == '\0' ? solid.notes.empty() : mentions(solid.notes, expected.note)));
}

TEST_CASE("files without a solid end in one message that says why") {
    const auto [file, reason] = GENERATE(table<const char*, const char*>({
        {"soup.stl",
         "soup.stl: the 100 triangles enclose no volume (they share no edges), so there is nothing to print"},
        {"deg_faces.obj", "deg_faces.obj: the 3 triangles enclose no volume, so"},
        {"not_enough_indices.obj", "not_enough_indices.obj: the one triangle encloses no volume"},
    }));
    const std::string message = message_of(read_mesh(model(std::string("broken/") + file)).mesh, file);
    INFO(message);
    CHECK(message.find(reason) == 0);
}

TEST_CASE(
    "the winding number of a closed mesh is whole everywhere, and that of the open one where that is clear") {
    const std::string file = GENERATE(
        "broken/sphere_with_hole.stl", "broken/nan_inf_vertex.stl", "broken/thingi_68435.stl",
        "broken/openscad_nonmanifold.obj", "broken/wallhole.obj", "broken/thingi_63506.stl",
        "broken/malformed.obj", "broken/thingi_68251.stl", "good/featuretype.3mf", "good/featuretype.stl");
    INFO(file);
    const TriangleMesh original = read_mesh(model(file)).mesh;
    const SolidMesh solid = close_mesh(original);
    const bool only_closed = !mentions(solid.notes, "turned") && !mentions(solid.notes, "left out");
    const Box box = grown(original.bounds(), 0.05 * glm::length(original.bounds().size()));
    Random random(7);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::size_t compared = 0;
    for (int i = 0; i < 200; ++i) {
        const dvec3 p = box.lo + box.size() * dvec3(uniform(random), uniform(random), uniform(random));
        const double closed = winding_number(solid.mesh, p);
        INFO("seed 7, point " << p.x << " " << p.y << " " << p.z);
        REQUIRE(std::abs(closed - std::round(closed)) < 1e-6);
        const double open = winding_number(original, p);
        if (!only_closed || std::abs(open - std::round(open)) > 0.25) continue;
        ++compared;
        REQUIRE(std::round(closed) == std::round(open));
    }
    CHECK((compared > 150 || !only_closed));
}

TEST_CASE("a plate with every seventh triangle flipped is mended to the original plate") {
    const SolidMesh solid = close_mesh(read_mesh(model("broken/flipped_every_7th.stl")).mesh);
    CHECK(as_set(solid.mesh) == as_set(read_mesh(model("good/plate_holes.stl")).mesh));
}

TEST_CASE("a sphere turned inside out is mended to the original sphere") {
    const SolidMesh solid = close_mesh(read_mesh(model("broken/inside_out_sphere.stl")).mesh);
    CHECK(as_set(solid.mesh) == as_set(read_mesh(model("good/sphere_20mm.stl")).mesh));
    CHECK(solid.oriented_manifold);
}

TEST_CASE("a sound mesh comes back as it was") {
    for (const char* file :
         {"good/fish_mm.obj", "good/fixed_top.ply", "good/torus.3mf", "good/two_solids.stl"}) {
        INFO(file);
        const TriangleMesh mesh = read_mesh(model(file)).mesh;
        const SolidMesh solid = close_mesh(mesh);
        CHECK(solid.mesh.triangles == mesh.triangles);
        CHECK(solid.oriented_manifold);
        CHECK(solid.notes.empty());
    }
}

TEST_CASE("seams that only nearly meet are joined without caps") {
    const SolidMesh real = close_mesh(read_mesh(model("good/featuretype.stl")).mesh);
    CHECK(real.oriented_manifold);
    CHECK(volume(real.mesh) == Approx(11.6277).epsilon(1e-5));

    // A box of six plates, each pushed aside by up to 2e-6 of its size.
    Random random(11);
    std::uniform_real_distribution<double> jitter(-2e-6, 2e-6);
    const TriangleMesh box = unit_box();
    TriangleMesh plates;
    for (std::size_t side = 0; side < 6; ++side) {
        TriangleMesh plate{box.vertices, {box.triangles[2 * side], box.triangles[2 * side + 1]}};
        for (dvec3& v : plate.vertices) v += dvec3(jitter(random), jitter(random), jitter(random));
        append(plates, plate);
    }
    const SolidMesh solid = close_mesh(plates);
    CHECK(solid.oriented_manifold);
    CHECK(solid.mesh.triangles.size() == 12);
    CHECK(volume(solid.mesh) == Approx(1.0).epsilon(2e-5));
}

TEST_CASE("a missing side of a box is put back exactly") {
    for (std::size_t side = 0; side < 6; ++side) {
        TriangleMesh mesh = unit_box();
        mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(2 * side),
                             mesh.triangles.begin() + static_cast<std::ptrdiff_t>(2 * side + 2));
        const SolidMesh solid = close_mesh(mesh);
        CHECK(solid.caps == 2);
        CHECK(volume(solid.mesh) == Approx(1.0));
        CHECK_FALSE(solid.oriented_manifold);
        CHECK(mentions(solid.notes, "1 hole was closed, with 2 triangles"));
    }
}

TEST_CASE("flat concave holes get caps that do not overlap") {
    // Star sizes on either side of the limits between the ways of triangulating.
    const int points = GENERATE(3, 8, 16, 17, 100, 250);
    INFO(points << " points");
    const std::vector<dvec2> polygon = star(points, points > 20 ? 0.8 : 0.4);
    const SolidMesh solid = close_mesh(tube(polygon, 3.0));
    const double area = polygon_area(polygon);
    CHECK(has_no_boundary(solid.mesh));
    CHECK(solid.caps == 2 * (polygon.size() - 2));
    CHECK(volume(solid.mesh) == Approx(3.0 * area));
    CHECK(cap_area(solid) == Approx(2.0 * area));
    CHECK(mentions(solid.notes, "2 holes were closed"));
}

TEST_CASE("a hole with 100,000 corners is closed in a moment") {
    const std::vector<dvec2> polygon = star(50'000, 0.999);
    const SolidMesh solid = close_mesh(tube(polygon, 3.0));
    CHECK(solid.caps == 2 * (polygon.size() - 2));
    CHECK(volume(solid.mesh) == Approx(3.0 * polygon_area(polygon)));
    CHECK(cap_area(solid) == Approx(2.0 * polygon_area(polygon)).epsilon(0.01));
}

TEST_CASE("a T-junction is a hairline gap, not a hole") {
    TriangleMesh mesh = unit_box();
    // The bottom's edge from 0 to 1 gets a corner in the middle; the front wall's does not.
    mesh.vertices.emplace_back(0.5, 0.0, 0.0);
    mesh.triangles[1] = {0, 3, 8};
    mesh.triangles.push_back({8, 3, 1});
    const SolidMesh solid = close_mesh(mesh);
    CHECK(has_no_boundary(solid.mesh));
    CHECK(volume(solid.mesh) == Approx(1.0));
    CHECK(solid.caps == 1);
    CHECK(mentions(solid.notes, "1 hairline gap was closed"));
}

TEST_CASE("a cavity stays a cavity, whichever way the whole file faces") {
    const bool inside_out = GENERATE(false, true);
    TriangleMesh mesh;
    append(mesh, box_mesh(dvec3(1.0), dvec3(2.0)), !inside_out);
    append(mesh, box_mesh(dvec3(0.0), dvec3(3.0)), inside_out);
    append(mesh, box_mesh(dvec3(1.25), dvec3(1.75)), inside_out);
    const SolidMesh solid = close_mesh(mesh);
    CHECK(volume(solid.mesh) == Approx(27.0 - 1.0 + 0.125));
    CHECK(std::round(winding_number(solid.mesh, dvec3(1.1))) == 0.0);
    CHECK(std::round(winding_number(solid.mesh, dvec3(1.5))) == 1.0);
    CHECK(std::round(winding_number(solid.mesh, dvec3(0.5))) == 1.0);
    CHECK(mentions(solid.notes, "inside out") == inside_out);
}

TEST_CASE("a body that is inside out beside a sound one is turned alone") {
    TriangleMesh mesh = box_mesh(dvec3(0.0), dvec3(3.0));
    append(mesh, box_mesh(dvec3(5.0, 0.0, 0.0), dvec3(6.0, 1.0, 1.0)), true);
    // One that stands right on top of the other's face is beside it, not inside.
    append(mesh, box_mesh(dvec3(1.0, 1.0, 3.0), dvec3(2.0, 2.0, 4.0)), true);
    append(mesh, box_mesh(dvec3(1.0, 1.0, -1.0), dvec3(2.0, 2.0, 0.0)), true);
    const SolidMesh solid = close_mesh(mesh);
    CHECK(volume(solid.mesh) == Approx(30.0));
    CHECK(mentions(solid.notes, "3 closed surfaces were inside out"));
}

TEST_CASE("triangles listed twice count once") {
    TriangleMesh mesh = unit_box();
    mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.begin() + 5);
    const SolidMesh solid = close_mesh(mesh);
    CHECK(solid.mesh.triangles == unit_box().triangles);
    CHECK(mentions(solid.notes, "5 triangles were there more than once"));
}

TEST_CASE("a surface listed once for each side is one surface") {
    TriangleMesh mesh = unit_box();
    for (auto t : unit_box().triangles) mesh.triangles.push_back({t[0], t[2], t[1]});
    const SolidMesh solid = close_mesh(mesh);
    CHECK(as_set(solid.mesh) == as_set(unit_box()));
    CHECK(mentions(solid.notes, "twice"));
}

TEST_CASE("two solids that share a piece of surface both keep it") {
    // Two boxes on the same square: its two triangles are there twice, and both are needed.
    TriangleMesh mesh = unit_box();
    TriangleMesh tall = box_mesh(dvec3(0.0), dvec3(1.0, 1.0, 2.0));
    for (auto t : tall.triangles) {
        for (std::uint32_t& v : t) v = v < 4 ? v : v + 4;
        mesh.triangles.push_back(t);
    }
    mesh.vertices.insert(mesh.vertices.end(), tall.vertices.begin() + 4, tall.vertices.end());
    const SolidMesh solid = close_mesh(mesh);
    CHECK(solid.caps == 0);
    CHECK(volume(solid.mesh) == Approx(3.0));
}

TEST_CASE("loose triangles and flat sheets beside a solid are left out") {
    TriangleMesh mesh = unit_box();
    append(mesh, {{dvec3(3, 0, 0), dvec3(4, 0, 0), dvec3(3, 1, 1)}, {{0, 1, 2}}});
    append(mesh, {{dvec3(3, 3, 0), dvec3(4, 3, 0), dvec3(4, 4, 0), dvec3(3.5, 5, 0), dvec3(3, 4, 0)},
                  {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}}});
    const SolidMesh solid = close_mesh(mesh);
    CHECK(solid.mesh.triangles == unit_box().triangles);
    CHECK(solid.mesh.vertices.size() == 8);
    CHECK(mentions(solid.notes, "loose triangle"));
    CHECK(mentions(solid.notes, "1 flat sheet"));
}

TEST_CASE("a sphere with random damage is closed and keeps its volume") {
    const unsigned seed = GENERATE(range(1U, 21U));
    INFO("seed " << seed);
    const TriangleMesh sphere = read_mesh(model("good/sphere_20mm.stl")).mesh;
    Random random(seed);
    TriangleMesh mesh{sphere.vertices, {}};
    for (auto t : sphere.triangles) {
        const unsigned fate = random() % 100;
        if (fate < 3) continue;
        if (fate < 13) std::swap(t[0], t[1]);
        mesh.triangles.push_back(t);
        if (fate > 97) mesh.triangles.push_back({t[1], t[2], t[0]});
    }
    const SolidMesh solid = close_mesh(mesh);
    CHECK(has_no_boundary(solid.mesh));
    CHECK(volume(solid.mesh) == Approx(volume(sphere)).epsilon(0.01));
    for (int i = 0; i < 20; ++i) {
        const auto coordinate = [&] { return (static_cast<double>(random() % 20001) - 10000.0) / 900.0; };
        const dvec3 p(coordinate(), coordinate(), coordinate());
        if (std::abs(glm::length(p) - 10.0) < 0.7) continue;
        CHECK(winding_number(solid.mesh, p) == Approx(glm::length(p) < 10.0 ? 1.0 : 0.0).margin(1e-6));
    }
}

TEST_CASE("random triangles over few corners always end closed or refused") {
    const unsigned seed = GENERATE(range(1U, 201U));
    INFO("seed " << seed);
    Random random(seed);
    TriangleMesh mesh;
    const std::uint32_t corners = 4 + random() % 30;
    for (std::uint32_t v = 0; v < corners; ++v) {
        const auto coordinate = [&] { return static_cast<double>(random() % 4); };
        mesh.vertices.emplace_back(coordinate(), coordinate(), coordinate());
    }
    const std::uint32_t triangles = 1 + random() % 120;
    for (std::uint32_t t = 0; t < triangles; ++t) {
        mesh.triangles.push_back({static_cast<std::uint32_t>(random() % corners),
                                  static_cast<std::uint32_t>(random() % corners),
                                  static_cast<std::uint32_t>(random() % corners)});
    }
    try {
        const SolidMesh solid = close_mesh(mesh);
        CHECK(has_no_boundary(solid.mesh));
        CHECK(volume(solid.mesh) > 0.0);
        CHECK(solid.mesh.triangles.size() >= 4);
        CHECK(solid.caps <= solid.mesh.triangles.size());
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find("enclose") != std::string::npos);
    }
}

TEST_CASE("a Moebius strip has no sides to agree on, and still ends closed or refused") {
    TriangleMesh mesh;
    constexpr std::uint32_t n = 30;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double turn = 2.0 * 3.14159265358979323846 * i / n;
        for (const double side : {-1.0, 1.0}) {
            const double r = 10.0 + side * std::cos(turn / 2.0);
            mesh.vertices.emplace_back(r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2.0));
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 * i;
        const std::uint32_t b = a + 1;
        const std::uint32_t c = i + 1 < n ? a + 2 : 1;
        const std::uint32_t d = i + 1 < n ? a + 3 : 0;
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
    }
    try {
        CHECK(has_no_boundary(close_mesh(mesh).mesh));
    } catch (const InputError& error) {
        CHECK(std::string(error.what()).find("no volume") != std::string::npos);
    }
}

TEST_CASE("meshes that are no meshes are refused, not crashed on") {
    CHECK(message_of({}, "a.stl") == "a.stl: there are no triangles, so there is nothing to print");
    CHECK(message_of({{dvec3(0.0)}, {{0, 1, 2}}}, "a").find("no volume") != std::string::npos);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    TriangleMesh mesh = unit_box();
    mesh.vertices.emplace_back(nan, 0.0, 0.0);
    mesh.vertices.emplace_back(0.0, infinity, 0.0);
    mesh.triangles.push_back({0, 1, 8});
    mesh.triangles.push_back({0, 1, 9});
    const SolidMesh solid = close_mesh(mesh);
    CHECK(solid.mesh.triangles == unit_box().triangles);
    CHECK(mentions(solid.notes, "2 triangles without three usable corners"));
}

}  // namespace mesh_repair_test
