// Beam lattices: the file's beams are the beams given, and the file keeps the rules of the format.
#include "printers/vector/beam_lattice.h"

#include <catch2/catch.hpp>
#include <map>
#include <pugixml.hpp>
#include <random>
#include <set>

#include "engine/base/error.h"
#include "printers/archive/zip_writer.h"
#include "procedural/foam/voronoi_foam.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"

namespace beam_lattice_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

constexpr double rounding = 0.5e-5 * (1 + 1e-9) + 1e-12;

struct Lattice {
    std::string name;
    std::vector<dvec3> vertices;
    std::vector<std::array<std::size_t, 2>> ends;
    std::vector<Beam> beams;
};

/// A number as the extension's schema allows it.
double positive_number(const pugi::xml_attribute& attribute) {
    const std::string text = attribute.value();
    INFO(attribute.name() << "=" << text);
    REQUIRE(!text.empty());
    REQUIRE(text.find_first_not_of("0123456789.") == std::string::npos);
    REQUIRE(std::isdigit(static_cast<unsigned char>(text.front())) != 0);
    REQUIRE(std::isdigit(static_cast<unsigned char>(text.back())) != 0);
    REQUIRE(attribute.as_double() > 0);
    return attribute.as_double();
}

/// Reads a lattice by the rules of the core specification and the extension, and checks those rules.
Lattice read_lattice(const fs::path& path) {
    const auto entries = read_zip(path);
    REQUIRE(entries.size() == 3);
    const std::map<std::string, std::string> parts(entries.begin(), entries.end());
    pugi::xml_document types, relations, model;
    REQUIRE(types.load_string(parts.at("[Content_Types].xml").c_str()));
    REQUIRE(
        types.select_node("/Types/Default[@Extension='model' and "
                          "@ContentType='application/vnd.ms-package.3dmanufacturing-3dmodel+xml']"));
    REQUIRE(types.select_node("/Types/Default[@Extension='rels']"));
    REQUIRE(relations.load_string(parts.at("_rels/.rels").c_str()));
    REQUIRE(
        relations.select_node("/Relationships/Relationship[@Target='/3D/3dmodel.model' and "
                              "@Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel']"));
    const std::string& text = parts.at("3D/3dmodel.model");
    REQUIRE(model.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8));
    const pugi::xml_node root = model.child("model");
    REQUIRE(root.attribute("unit").value() == std::string("millimeter"));
    REQUIRE(root.attribute("xmlns").value() ==
            std::string("http://schemas.microsoft.com/3dmanufacturing/core/2015/02"));
    REQUIRE(root.attribute("requiredextensions").value() == std::string("b"));
    REQUIRE(root.attribute("xmlns:b").value() ==
            std::string("http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"));
    const pugi::xml_node object = root.child("resources").child("object");
    REQUIRE(object.attribute("type").value() == std::string("model"));
    REQUIRE(root.child("build").child("item").attribute("objectid").as_int() ==
            object.attribute("id").as_int(-1));

    Lattice lattice;
    lattice.name = object.attribute("name").value();
    const pugi::xml_node mesh = object.child("mesh");
    std::set<std::array<double, 3>> places;
    for (const auto& vertex : mesh.child("vertices").children("vertex")) {
        lattice.vertices.emplace_back(vertex.attribute("x").as_double(NAN),
                                      vertex.attribute("y").as_double(NAN),
                                      vertex.attribute("z").as_double(NAN));
        const dvec3 p = lattice.vertices.back();
        REQUIRE(places.insert({p.x, p.y, p.z}).second);
    }
    REQUIRE_FALSE(mesh.child("triangles"));
    const pugi::xml_node node = mesh.child("b:beamlattice");
    REQUIRE(node == mesh.last_child());
    REQUIRE(node.attribute("cap").value() == std::string("sphere"));
    const double shortest = positive_number(node.attribute("minlength"));
    const double radius = positive_number(node.attribute("radius"));
    for (const auto& beam : node.child("b:beams").children("b:beam")) {
        const std::array<std::size_t, 2> ends{beam.attribute("v1").as_uint(UINT_MAX),
                                              beam.attribute("v2").as_uint(UINT_MAX)};
        REQUIRE(ends[0] != ends[1]);
        REQUIRE(std::max(ends[0], ends[1]) < lattice.vertices.size());
        const pugi::xml_attribute r1 = beam.attribute("r1"), r2 = beam.attribute("r2");
        REQUIRE((r1 || !r2));
        const double ra = r1 ? positive_number(r1) : radius, rb = r2 ? positive_number(r2) : ra;
        const Beam read{lattice.vertices[ends[0]], ra, lattice.vertices[ends[1]], rb};
        REQUIRE(glm::length(read.a - read.b) >= shortest * (1 - 1e-3));
        lattice.beams.push_back(read);
        lattice.ends.push_back(ends);
    }
    return lattice;
}

bool same(const Beam& a, const Beam& b) {
    bool close = std::abs(a.ra - b.ra) <= rounding && std::abs(a.rb - b.rb) <= rounding;
    for (int k = 0; k < 3; ++k) {
        close = close && std::abs(a.a[k] - b.a[k]) <= rounding && std::abs(a.b[k] - b.b[k]) <= rounding;
    }
    return close;
}

}  // namespace

TEST_CASE("a lattice holds every beam of a foam, with shared nodes", "[beam_lattice]") {
    const TemporaryFolder folder;
    FoamSettings settings;
    settings.cell = 2;
    settings.beam_radius = 0.2;
    settings.region = {dvec3(0), dvec3(20)};
    const std::vector<Beam> beams = make_voronoi_foam(settings)->beams_touching(settings.region);
    REQUIRE(beams.size() > 5000);
    const BeamLatticeReport report = write_beam_lattice(folder / "foam.3mf", beams, "foam");
    const Lattice lattice = read_lattice(folder / "foam.3mf");
    REQUIRE(lattice.name == "foam");
    REQUIRE(report.vertices == lattice.vertices.size());
    REQUIRE(report.beams == lattice.beams.size());
    REQUIRE(report.beams + report.dropped == beams.size());
    std::size_t next = 0;
    for (const Beam& beam : beams) {
        if (next < lattice.beams.size() && same(beam, lattice.beams[next])) {
            ++next;
        } else {
            REQUIRE(glm::length(beam.a - beam.b) < 2e-5);
        }
    }
    REQUIRE(next == lattice.beams.size());
    // Four edges meet at an inner node of a Voronoi diagram.
    std::vector<int> degree(lattice.vertices.size());
    for (const auto& ends : lattice.ends) {
        for (const std::size_t end : ends) ++degree[end];
    }
    for (std::size_t v = 0; v < degree.size(); ++v) {
        const dvec3 p = lattice.vertices[v];
        if (glm::all(glm::greaterThan(p, dvec3(1))) && glm::all(glm::lessThan(p, dvec3(19))))
            REQUIRE(degree[v] >= 4);
    }
}

TEST_CASE("radii of all kinds come back", "[beam_lattice]") {
    const TemporaryFolder folder;
    const std::vector<Beam> beams = {{{0, 0, 0}, 0.5, {1, 0, 0}, 0.5},
                                     {{1, 0, 0}, 0.5, {1, 2, 0}, 0.25},
                                     {{1, 2, 0}, 0.25, {1, 2, 3}, 0.25},
                                     {{0, 0, 0}, 0.25, {1, 2, 3}, 0.5},
                                     {{-7.25, 1e-5, 123456.78901}, 1e-9, {0, 0, 0}, 1234.5}};
    const BeamLatticeReport report = write_beam_lattice(folder / "a.3mf", beams, "");
    REQUIRE(report.vertices == 5);
    REQUIRE(report.beams == 5);
    REQUIRE(report.dropped == 0);
    const Lattice lattice = read_lattice(folder / "a.3mf");
    for (std::size_t i = 0; i < 4; ++i) REQUIRE(lattice.beams[i] == beams[i]);
    REQUIRE(lattice.beams[4].a == beams[4].a);
    REQUIRE(lattice.beams[4].ra == 1e-5);
}

TEST_CASE("beams without a length are dropped and counted, and near ends are one node", "[beam_lattice]") {
    const TemporaryFolder folder;
    const dvec3 near(1e-7, -1e-7, 0);
    const std::vector<Beam> beams = {{{5, 5, 5}, 1, {5, 5, 5}, 1},
                                     {{0, 0, 0}, 1, near, 2},
                                     {near, 1, {1, 0, 0}, 1},
                                     {{-0.0, 0, 0}, 1, {0, 1, 0}, 1},
                                     {{0, 1, 0}, 1, {0, 1 + 1.01e-5, 0}, 1}};
    const BeamLatticeReport report = write_beam_lattice(folder / "a.3mf", beams, "a");
    REQUIRE(report.dropped == 2);
    REQUIRE(report.beams == 3);
    REQUIRE(report.vertices == 4);
    REQUIRE(read_lattice(folder / "a.3mf").ends ==
            std::vector<std::array<std::size_t, 2>>{{0, 1}, {0, 2}, {2, 3}});
}

TEST_CASE("any name is valid XML", "[beam_lattice]") {
    const TemporaryFolder folder;
    const std::vector<Beam> beams = {{{0, 0, 0}, 1, {1, 0, 0}, 1}};
    const std::vector<std::pair<std::string, std::string>> names = {
        {"<\"Fish\" & 'chips'>", "<\"Fish\" & 'chips'>"},
        {"\xc3\xa9t\xc3\xa9 \xf0\x9f\x90\xa8", "\xc3\xa9t\xc3\xa9 \xf0\x9f\x90\xa8"},
        {std::string("a\0b\x01\x7f\n", 6), "ab"},
        {"\xc3 \xff\xed\xa0\x80 \xe2\x82", "  "}};
    for (const auto& [given, expected] : names) {
        write_beam_lattice(folder / "a.3mf", beams, given);
        CHECK(read_lattice(folder / "a.3mf").name == expected);
    }
}

TEST_CASE("equal beams give equal bytes", "[beam_lattice]") {
    const TemporaryFolder folder;
    std::mt19937 random(9);
    std::uniform_real_distribution<double> at(-50, 50);
    std::vector<Beam> beams;
    for (int i = 0; i < 5000; ++i) {
        beams.push_back(
            {{at(random), at(random), at(random)}, 0.3, {at(random), at(random), at(random)}, 0.2});
    }
    write_beam_lattice(folder / "a.3mf", beams, "a");
    write_beam_lattice(folder / "b.3mf", beams, "a");
    CHECK(read_text(folder / "a.3mf") == read_text(folder / "b.3mf"));
    const Lattice lattice = read_lattice(folder / "a.3mf");
    REQUIRE(lattice.beams.size() == beams.size());
    for (std::size_t i = 0; i < beams.size(); ++i) REQUIRE(same(beams[i], lattice.beams[i]));
}

TEST_CASE("beams that no file can hold are refused, and an older file stays", "[beam_lattice]") {
    const TemporaryFolder folder;
    const Beam good{{0, 0, 0}, 1, {1, 0, 0}, 1};
    write_beam_lattice(folder / "a.3mf", std::vector{good}, "a");
    const std::string before = read_text(folder / "a.3mf");
    std::vector<Beam> bad(6, good);
    bad[0].a.x = NAN;
    bad[1].b.y = INFINITY;
    bad[2].ra = 0;
    bad[3].rb = -1;
    bad[4].ra = NAN;
    bad[5].b.z = 2e6;
    for (const Beam& beam : bad) {
        CHECK_THROWS_WITH(write_beam_lattice(folder / "a.3mf", std::vector{good, beam}, "a"),
                          Catch::Contains("beam 1"));
    }
    CHECK_THROWS_AS(write_beam_lattice(folder / "a.3mf", {}, "a"), InputError);
    const std::vector<Beam> point{{{1, 1, 1}, 1, {1, 1, 1}, 1}};
    CHECK_THROWS_AS(write_beam_lattice(folder / "a.3mf", point, "a"), InputError);
    CHECK(read_text(folder / "a.3mf") == before);
    CHECK_FALSE(fs::exists(folder / "a.3mf.tmp"));
}

}  // namespace beam_lattice_test
