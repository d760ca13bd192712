// 3MF beam lattices as solids against closed forms, and everything that is refused of them.
#include "procedural/volume/lattice_solid.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "engine/base/error.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "printers/vector/beam_lattice.h"
#include "procedural/volume/volumetric_model.h"
#include "tests/engine/io/package_samples.h"
#include "tests/engine/mesh/mesh_samples.h"
#include "tests/engine/runs/plane_runs.h"
#include "tests/procedural/grading/grading_checks.h"
#include "tests/procedural/volume/scratch_folder.h"

namespace lattice_solid_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A model of objects, the last of which is built; with the two namespaces of the extension.
std::string package(const std::string& objects, const std::string& items, const std::string& attributes = "",
                    bool required = true) {
    return threemf(objects, items,
                   "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" "
                   "xmlns:c=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07\" " +
                       std::string(required ? "requiredextensions=\"b c\" " : "") + attributes);
}

/// An object of vertices 0 (-3, 0, 0), 1 (3, 0, 0), 2 (3, 4, 0), and more, with a lattice.
std::string lattice_object(const std::string& id, const std::string& attributes, const std::string& beams,
                           const std::string& balls = "", const std::string& more_vertices = "") {
    return "<object id=\"" + id +
           "\"><mesh><vertices><vertex x=\"-3\" y=\"0\" z=\"0\"/><vertex x=\"3\" y=\"0\" z=\"0\"/>"
           "<vertex x=\"3\" y=\"4\" z=\"0\"/>" +
           more_vertices + "</vertices><b:beamlattice minlength=\"0.001\" " + attributes + "><b:beams>" +
           beams + "</b:beams>" + (balls.empty() ? "" : "<c:balls>" + balls + "</c:balls>") +
           "</b:beamlattice></mesh></object>";
}

FieldPtr built(const std::string& objects, const std::string& items = "<item objectid=\"1\"/>",
               const std::string& attributes = "") {
    return VolumetricModel("a.3mf", package(objects, items, attributes)).built();
}

/// By rows and planes that lie in no symmetric places.
double volume_of(const FieldPtr& solid) {
    Box box = grown(solid->bounds(), 0.1);
    box.lo -= dvec3(0.0123, 0.0456, 0.0789);
    const dvec3 size = box.size();
    return volume_in(*solid, box, std::max(0.01, std::max(size.y, size.z) / 1500));
}

std::string message_of(const std::string& objects, const std::string& items = "<item objectid=\"1\"/>") {
    try {
        built(objects, items);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing was refused";
}

double frustum_volume(double r1, double r2, double length) {
    return pi * length / 3 * (r1 * r1 + r1 * r2 + r2 * r2);
}
double ball_volume(double r) { return 4.0 / 3 * pi * r * r * r; }

/// The volume about an axis of a solid whose squared radius at x is profile(x), by midpoints.
template <typename Profile>
double revolved(double from, double to, const Profile& profile) {
    constexpr int steps = 200'000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += std::max(0.0, profile(from + (i + 0.5) / steps * (to - from)));
    return pi * sum * (to - from) / steps;
}

double square(double v) { return v * v; }

}  // namespace

TEST_CASE("a beam has the ends that its caps say", "[beam_lattice]") {
    const auto beam = [](const std::string& attributes) {
        return volume_of(
            built(lattice_object("1", "radius=\"1\"", "<b:beam v1=\"0\" v2=\"1\" " + attributes + "/>")));
    };
    CHECK(beam("") == Approx(pi * 6 + ball_volume(1)).epsilon(1e-3));
    CHECK(beam("cap1=\"hemisphere\" cap2=\"hemisphere\"") == Approx(pi * 6 + ball_volume(1)).epsilon(1e-3));
    CHECK(beam("cap1=\"butt\" cap2=\"butt\"") == Approx(pi * 6).epsilon(1e-3));
    CHECK(beam("cap1=\"butt\"") == Approx(pi * 6 + ball_volume(1) / 2).epsilon(1e-3));
    CHECK(beam("r1=\"2\"") == Approx(pi * 4 * 6 + ball_volume(2)).epsilon(1e-3));
    CHECK(beam("r1=\"2\" r2=\"0.5\" cap1=\"butt\" cap2=\"butt\"") ==
          Approx(frustum_volume(2, 0.5, 6)).epsilon(1e-3));
    CHECK(beam("r1=\"2\" r2=\"0.5\" cap1=\"hemisphere\" cap2=\"hemisphere\"") ==
          Approx(frustum_volume(2, 0.5, 6) + ball_volume(2) / 2 + ball_volume(0.5) / 2).epsilon(1e-3));
    // The ball at the thicker end also stands out of the frustum's flank.
    CHECK(beam("r1=\"2\" r2=\"0.5\"") ==
          Approx(revolved(-5, 3.5, [](double x) {
              const double cone = x > -3 && x < 3 ? 2 - (x + 3) * 0.25 : 0;
              return std::max({square(cone), 4 - square(x + 3), 0.25 - square(x - 3)});
          })).epsilon(1e-3));
    const FieldPtr lattice =
        built(lattice_object("1", "radius=\"1\" cap=\"butt\"", "<b:beam v1=\"0\" v2=\"1\"/>"));
    CHECK(lattice->bounds().lo == dvec3(-3, -1, -1));
    CHECK(lattice->bounds().hi == dvec3(3, 1, 1));
}

TEST_CASE("balls are at the vertices that the mode says", "[beam_lattice]") {
    const std::string beams = "<b:beam v1=\"0\" v2=\"1\"/>";
    const auto balls = [&](const std::string& mode, const std::string& list) {
        return volume_of(built(lattice_object("1", "radius=\"0.5\" cap=\"butt\" " + mode, beams, list)));
    };
    const double alone = pi * 0.25 * 6;
    // What a ball of radius 1 at the end of the beam adds to it: all but the beam within the ball.
    const double within = revolved(0, 1, [](double x) { return std::min(0.25, 1 - x * x); });
    const double added = ball_volume(1) - within;
    CHECK(balls("", "<c:ball vindex=\"0\" r=\"1\"/>") == Approx(alone).epsilon(2e-3));
    CHECK(balls("c:ballmode=\"mixed\" c:ballradius=\"2\"", "<c:ball vindex=\"0\" r=\"1\"/>") ==
          Approx(alone + added).epsilon(2e-3));
    CHECK(balls("c:ballmode=\"mixed\" c:ballradius=\"1\"", "<c:ball vindex=\"1\"/>") ==
          Approx(alone + added).epsilon(2e-3));
    CHECK(balls("c:ballmode=\"all\" c:ballradius=\"1\"", "") == Approx(alone + 2 * added).epsilon(2e-3));
    // A vertex without a beam has a ball only by name.
    CHECK(balls("c:ballmode=\"all\" c:ballradius=\"1\"", "<c:ball vindex=\"2\" r=\"0.7\"/>") ==
          Approx(alone + 2 * added + ball_volume(0.7)).epsilon(2e-3));
}

TEST_CASE("a lattice is kept inside or outside its clipping mesh", "[beam_lattice]") {
    const std::string box = object_xml("7", box_mesh(dvec3(0, -9, -9), dvec3(2, 9, 9)));
    const auto clipped = [&](const std::string& mode) {
        return volume_of(built(
            box + lattice_object("1", "radius=\"1\" cap=\"butt\" " + mode, "<b:beam v1=\"0\" v2=\"1\"/>")));
    };
    CHECK(clipped("clippingmode=\"none\"") == Approx(pi * 6).epsilon(1e-3));
    CHECK(clipped("clippingmode=\"inside\" clippingmesh=\"7\"") == Approx(pi * 2).epsilon(1e-3));
    CHECK(clipped("clippingmode=\"outside\" clippingmesh=\"7\"") == Approx(pi * 4).epsilon(1e-3));
}

TEST_CASE("a lattice is united with the triangles of its own mesh", "[beam_lattice]") {
    std::string object = object_xml("1", box_mesh(dvec3(0), dvec3(4)));
    object.insert(object.find("</mesh>"),
                  "<b:beamlattice minlength=\"0.001\" radius=\"0.5\" cap=\"butt\"><b:beams>"
                  "<b:beam v1=\"0\" v2=\"1\"/></b:beams></b:beamlattice>");
    // The beam lies along an edge of the box, three quarters of it outside.
    CHECK(volume_of(built(object)) == Approx(64 + 0.75 * pi * 0.25 * 4).epsilon(1e-3));
}

TEST_CASE("a lattice is placed by items, components and the unit", "[beam_lattice]") {
    const std::string lattice = lattice_object(
        "7", "radius=\"1\" cap=\"butt\"", "<b:beam v1=\"0\" v2=\"1\" r1=\"0.5\" r2=\"1\" cap2=\"sphere\"/>");
    const double alone = frustum_volume(0.5, 1, 6) + revolved(0, 1, [](double x) { return 1 - x * x; }) +
                         revolved(2, 3, [](double x) {
                             return std::max(0.0, 1 - square(x - 3) - square(0.5 + (x + 3) / 12));
                         });
    const std::string twice =
        lattice +
        "<object id=\"1\"><components><component objectid=\"7\"/><component objectid=\"7\" "
        "transform=\"0 -2 0 2 0 0 0 0 2 50 0 0\"/></components></object>";
    const FieldPtr turned =
        built(twice, "<item objectid=\"1\" transform=\"-0.6 0.8 0 0.8 0.6 0 0 0 1 5 0 1\"/>");
    CHECK(volume_of(turned) == Approx(9 * alone).epsilon(1e-3));
    CHECK(turned->value(dvec3(5, 0, 1)) < 0);
    const FieldPtr inches =
        built(lattice, "<item objectid=\"7\" transform=\"0.1 0 0 0 0.1 0 0 0 0.1 0 0 0\"/>", "unit=\"inch\"");
    CHECK(volume_of(inches) == Approx(alone * 2.54 * 2.54 * 2.54).epsilon(1e-3));
    // A map that keeps no angles makes the beams elliptic.
    const FieldPtr flat = built(lattice, "<item objectid=\"7\" transform=\"1 0 0 0 2 0 0 0 0.5 0 0 0\"/>");
    CHECK(volume_of(flat) == Approx(alone).epsilon(2e-3));
    CHECK(flat->bounds().hi.y == Approx(2));
}

TEST_CASE("rows of a lattice are the sign of its value, and values never exceed the distance",
          "[beam_lattice]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-3, 3), radius(0.1, 1.5);
    for (int round = 0; round < 16; ++round) {
        const auto point = [&] { return dvec3(place(random), place(random), place(random)); };
        LatticePieces pieces;
        const dvec3 way = glm::normalize(point());
        const dvec3 at = point();
        switch (round % 4) {
            case 0:
                pieces.flat.emplace_back(Frustum{point(), radius(random), point(), radius(random)});
                break;
            case 1:  // upright, and so steep that rows run into its flank from outside
                pieces.flat.emplace_back(Frustum{at, 0.2, at + dvec3(0.3, 0, 0), 2.5});
                break;
            case 2:
                pieces.flat.emplace_back(HalfBall{at, radius(random), way});
                break;
            default:
                pieces.beams.push_back({at, 0.8, at, 0.8});
                pieces.flat.emplace_back(Frustum{at, 0.4, at + way * 2.0, 0.2});
        }
        const FieldPtr solid = make_lattice_solid(pieces);
        const Box around = grown(solid->bounds(), 0.2);
        for (const Axis axis : {Axis::x, Axis::y}) {
            RowBand band = band_over(around, 0.05);
            band.axis = axis;
            if (axis == Axis::y) {
                std::swap(band.along_origin, band.across_origin);
                band.count = static_cast<int>(std::ceil(around.size().x / 0.05));
                band.hi = static_cast<int>(std::ceil(around.size().y / 0.05));
            }
            const double z =
                around.lo.z + std::uniform_real_distribution<double>(0, 1)(random) * around.size().z;
            const RunRows rows = runs_at(*solid, z, band);
            for (int line = 0; line < band.lines(); ++line) {
                for (int unit = 0; unit < band.hi * run_unit; unit += 211) {
                    const double along = band.along(unit + 0.5), across = band.line(line);
                    const dvec3 p = axis == Axis::x ? dvec3(along, across, z) : dvec3(across, along, z);
                    const double value = solid->value(p);
                    bool in_run = false;
                    for (const Run& run : rows.line(line))
                        in_run = in_run || (run.begin <= unit && unit < run.end);
                    if (std::abs(value) > 1e-3 && in_run != (value < 0)) {
                        CAPTURE(round, value, p.x, p.y, p.z);
                        FAIL("a row and the value differ");
                    }
                }
            }
        }
        double previous = 0;
        dvec3 before(0);
        for (int i = 0; i < 400; ++i) {
            const dvec3 p = checks::random_point(random, around);
            const double value = solid->value(p);
            if (i > 0) CHECK(std::abs(value - previous) <= length(p - before) * (1 + 1e-12));
            CHECK((value >= 0 || solid->bounds().contains(p)));
            previous = value;
            before = p;
        }
    }
}

TEST_CASE("the distance to a frustum and to half a ball is that to the nearest point of its surface",
          "[beam_lattice]") {
    const Frustum frustum{{0, 0, 0}, 1.5, {0, 0, 2}, 0.5};
    const double s = std::sqrt(5.0);  // of the flank: 1 across to 2 along
    CHECK(signed_distance(frustum, {0, 0, -1}) == Approx(1));
    CHECK(signed_distance(frustum, {0, 0, 3}) == Approx(1));
    CHECK(signed_distance(frustum, {2.5, 0, 0}) == Approx(1));
    CHECK(signed_distance(frustum, {2.5, 0, 1}) == Approx(1.5 * 2 / s).epsilon(1e-12));
    CHECK(signed_distance(frustum, {2.5, 0, -1}) == Approx(std::sqrt(2.0)));
    CHECK(signed_distance(frustum, {0, 0, 1}) == Approx(-2 / s));
    CHECK(signed_distance(frustum, {0, 0, 0.25}) == Approx(-0.25));
    const HalfBall half{{0, 0, 0}, 2, {0, 0, 1}};
    CHECK(signed_distance(half, {0, 0, 3}) == Approx(1));
    CHECK(signed_distance(half, {0, 0, -1}) == Approx(1));
    CHECK(signed_distance(half, {3, 0, -1}) == Approx(std::sqrt(2.0)));
    CHECK(signed_distance(half, {0, 0, 0.5}) == Approx(-0.5));
    CHECK(signed_distance(half, {0, 0, 1.75}) == Approx(-0.25));
    CHECK(bounds(half).lo == dvec3(-2, -2, 0));
    CHECK(bounds(half).hi == dvec3(2, 2, 2));
}

TEST_CASE("the lattice of a foam is read back as the beams that were written", "[beam_lattice]") {
    std::vector<Beam> beams;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 10);
    for (int i = 0; i < 300; ++i) {
        const dvec3 a(place(random), place(random), place(random));
        beams.push_back(
            {a, 0.25, a + dvec3(place(random) - 5, place(random) - 5, place(random) - 5) * 0.4, 0.25});
    }
    const ScratchFolder folder("lattice");
    const std::string path = (folder / "foam.3mf").string();
    write_beam_lattice(path, beams, "foam");
    const FieldPtr read = VolumetricModel(path).built();
    for (int i = 0; i < 2000; ++i) {
        const dvec3 p(place(random), place(random), place(random));
        double nearest = infinity;
        for (const Beam& beam : beams) nearest = std::min(nearest, signed_distance(beam, p));
        CHECK(read->value(p) == Approx(nearest).margin(2e-5));
    }
    const FieldPtr grown_by = make_offset(read, 0.1);
    CHECK(grown_by->value(dvec3(5)) == Approx(read->value(dvec3(5)) - 0.1));
}

TEST_CASE("lattices that the format does not allow are refused with their place", "[beam_lattice]") {
    const std::string beam = "<b:beam v1=\"0\" v2=\"1\"/>";
    const auto refused = [](const std::string& attributes, const std::string& beams,
                            const std::string& balls = "") {
        return message_of(lattice_object("1", attributes, beams, balls));
    };
    CHECK_THAT(refused("", beam), Catch::Contains("a.3mf: part \"3D/3dmodel.model\", byte ") &&
                                      Catch::Contains("beamlattice: radius=\"\" is no radius"));
    CHECK_THAT(refused("radius=\"-1\"", beam), Catch::Contains("radius=\"-1\" is no radius"));
    CHECK_THAT(refused("radius=\"nan\"", beam), Catch::Contains("radius=\"nan\" is no radius"));
    CHECK_THAT(refused("radius=\"1\"", ""), Catch::Contains("it has no beams"));
    CHECK_THAT(refused("radius=\"1\"", "<b:beam v1=\"0\" v2=\"0\"/>"),
               Catch::Contains("ends are one vertex"));
    CHECK_THAT(refused("radius=\"1\"", "<b:beam v1=\"0\" v2=\"3\"/>"),
               Catch::Contains("beam: v2=\"3\" is no vertex of its mesh, which has 3"));
    CHECK_THAT(refused("radius=\"1\"", "<b:beam v1=\"-1\" v2=\"1\"/>"),
               Catch::Contains("v1=\"-1\" is no vertex"));
    CHECK_THAT(refused("radius=\"1\"", "<b:beam v1=\"0\" v2=\"1\" r2=\"2\"/>"),
               Catch::Contains("r2 without r1"));
    CHECK_THAT(refused("radius=\"1\" cap=\"flat\"", beam),
               Catch::Contains("cap=\"flat\" is unknown; known: sphere, hemisphere, butt"));
    CHECK_THAT(refused("radius=\"1\" c:ballmode=\"some\"", beam),
               Catch::Contains("ballmode=\"some\" is unknown; known: none, mixed, all"));
    CHECK_THAT(refused("radius=\"1\" c:ballmode=\"all\"", beam),
               Catch::Contains("ballradius=\"\" is no radius"));
    CHECK_THAT(
        refused("radius=\"1\" c:ballmode=\"mixed\" c:ballradius=\"1\"", beam, "<c:ball vindex=\"5\"/>"),
        Catch::Contains("ball: vindex=\"5\" is no vertex"));
    CHECK_THAT(refused("radius=\"1\" clippingmode=\"around\"", beam),
               Catch::Contains("known: none, inside, outside"));
    CHECK_THAT(refused("radius=\"1\" clippingmode=\"inside\"", beam),
               Catch::Contains("clippingmode needs one"));
    CHECK_THAT(refused("radius=\"1\" clippingmode=\"inside\" clippingmesh=\"9\"", beam),
               Catch::Contains("object 9 is referred to but does not exist"));
    CHECK_THAT(refused("radius=\"1\" clippingmode=\"inside\" clippingmesh=\"1\"", beam),
               Catch::Contains("its clippingmesh is object 1, which has beams itself"));
    CHECK_THAT(
        message_of(lattice_object("1", "radius=\"1\"", beam, "", "<vertex x=\"1e12\" y=\"0\" z=\"0\"/>")),
        Catch::Contains("absurdly far away"));
}

TEST_CASE("a mesh's reader says that beams are not read, and which field reads them", "[beam_lattice]") {
    std::string object = object_xml("1", box_mesh(dvec3(0), dvec3(4)));
    object.insert(object.find("</mesh>"),
                  "<b:beamlattice minlength=\"0.001\" radius=\"2\"><b:beams><b:beam v1=\"0\" v2=\"7\"/>"
                  "<b:beam v1=\"1\" v2=\"2\"/></b:beams></b:beamlattice>");
    const MeshFile file = from_memory("a.3mf", package(object, "<item objectid=\"1\"/>", "", false));
    CHECK(volume(file.mesh) == Approx(64));
    REQUIRE(file.notes.size() == 1);
    CHECK(file.notes.front() ==
          "its lattice of 2 beams is no mesh and was left out; a [[field]] of kind 3mf reads it");
    CHECK_THROWS_WITH(from_memory("a.3mf", package(object, "<item objectid=\"1\"/>")),
                      Catch::Contains("is no mesh; a [[field]] of kind 3mf reads it"));
    CHECK_THROWS_WITH(
        from_memory("a.3mf", package(lattice_object("1", "radius=\"1\"", "<b:beam v1=\"0\" v2=\"1\"/>"),
                                     "<item objectid=\"1\"/>", "", false)),
        Catch::Contains("it holds no triangles; its lattice of 1 beam is no mesh"));
    // Shapes of extensions that nobody knows here.
    std::string other = object_xml("1", box_mesh(dvec3(0), dvec3(4)));
    other.insert(other.find("<mesh>"), "<b:displacementmesh/>");
    const MeshFile noted = from_memory("a.3mf", package(other, "<item objectid=\"1\"/>", "", false));
    REQUIRE(noted.notes.size() == 1);
    CHECK(noted.notes.front() == "1 shape of a kind that is not read (\"displacementmesh\") was left out");
}

}  // namespace lattice_solid_test
