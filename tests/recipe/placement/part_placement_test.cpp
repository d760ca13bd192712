// Parts that are turned, mirrored, laid on a face and scaled: against the part before, point by point.
#include "recipe/placement/part_placement.h"

#include <fmt/format.h>
#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "engine/io/mesh_reader.h"
#include "tests/app/commands/folder.h"
#include "tests/app/commands/recipes.h"
#include "tests/engine/runs/plane_runs.h"

namespace part_placement_test {

using namespace lamella;

namespace {

const std::string turned = "turn = [30, -50, 20]\nmirror = \"y\"\n";

/// The axes of `turned`, from plain sines and cosines.
glm::dmat3 axes_of_turned() {
    const auto about = [](int axis, double degrees) {
        const double a = degrees * std::numbers::pi / 180;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        glm::dmat3 map(1);
        map[u][u] = map[v][v] = std::cos(a);
        map[u][v] = std::sin(a);
        map[v][u] = -std::sin(a);
        return map;
    };
    glm::dmat3 mirror(1);
    mirror[1][1] = -1;
    return about(2, 20) * about(1, -50) * about(0, 30) * mirror;
}

/// How a turned part differs from the part before it was turned.
struct Difference {
    double largest = 0;    ///< of two values, mm
    int wrong_pixels = 0;  ///< of a slice, where the value before is not nearly 0
    int solid_pixels = 0;
};

Difference difference(const std::string& part, const std::string& rest, double pitch = 0.23) {
    const BuiltJob before = build_job(recipe_of(part + rest)),
                   after = build_job(recipe_of(part + turned + rest));
    const glm::dmat3 axes = axes_of_turned();
    Difference found;
    const Box box = before.designed.bounds;
    std::mt19937_64 random(7);
    for (int i = 0; i < 400; ++i) {
        const auto share = [&] { return std::uniform_real_distribution<double>(-0.1, 1.1)(random); };
        const dvec3 p = box.lo + box.size() * dvec3(share(), share(), share());
        const double difference =
            std::abs(before.designed.part->value(p) - after.designed.part->value(axes * p));
        if (difference > found.largest) found.largest = difference;
    }
    const Box turned_box = after.designed.bounds;
    for (const double height : {0.21, 0.5, 0.83}) {
        const double z = turned_box.lo.z + height * turned_box.size().z;
        const RowBand band = band_over(turned_box, pitch);
        const RunRows rows = runs_at(*after.designed.part, z, band);
        for (int line = 0; line < band.lines(); ++line) {
            std::vector<char> solid(static_cast<std::size_t>(band.hi), 0);
            const auto middle = [](int pixel) { return pixel * run_unit + run_unit / 2; };
            for (const Run& run : rows.line(line)) {
                for (int pixel = 0; pixel < band.hi; ++pixel)
                    if (run.begin <= middle(pixel) && middle(pixel) < run.end)
                        solid[static_cast<std::size_t>(pixel)] = 1;
            }
            for (int pixel = 0; pixel < band.hi; ++pixel) {
                const dvec3 p(band.along_origin + (pixel + 0.5) * pitch, band.line(line), z);
                const double value = before.designed.part->value(glm::transpose(axes) * p);
                const bool is_solid = solid[static_cast<std::size_t>(pixel)] != 0;
                found.solid_pixels += is_solid;
                const bool near_border = std::abs(value) < 0.02 * pitch;
                found.wrong_pixels += !near_border && is_solid != (value < 0);
            }
        }
    }
    return found;
}

void check_same(const std::string& part, const std::string& rest) {
    CAPTURE(part, rest);
    const Difference found = difference(part, rest);
    CHECK(found.largest < 1e-9);
    CHECK(found.wrong_pixels == 0);
    CHECK(found.solid_pixels > 100);
}

const std::string block = "[part]\nshape = \"box\"\nsize = [14, 10, 8]\n";
}  // namespace

TEST_CASE("shapes are turned in closed form", "[placement]") {
    check_same(block, "");
    check_same("[part]\nshape = \"torus\"\nradius = 6\ntube = 2\n", "");
    check_same("[part]\nshape = \"cylinder\"\nradius = 4\nheight = 12\n", "");
    check_same("[part]\nshape = \"capsule\"\nradius = 4\nheight = 12\n", "");
    check_same("[part]\nshape = \"sphere\"\nradius = 4\n", "");
}

TEST_CASE("foam, skin, frame, regions, holes and gradings turn with the part", "[placement]") {
    const std::string foam = "[foam]\ncell = 2.5\nbeam = 0.3\n";
    check_same(block, foam);
    check_same(block, foam + "[skin]\nthickness = 0.8\n");
    check_same(
        block,
        "[foam]\ncell = \"2 + 0.1*x\"\nbeam = \"0.2 + 0.02*d\"\n[skin]\nthickness = \"0.6 + 0.05*z\"\n");
    check_same(block, "[foam]\ncell = 3\nbeam = 0.3\nstretch = [1, 1.5, 0.7]\nturn = [0, 30, 0]\n");
    check_same(block, "[foam]\nkind = \"closed\"\ncell = 3\nbeam = 0.3\nwall = 0.2\nwindow = 0.5\n");
    check_same(block,
               "[foam]\nkind = \"k-nearest\"\ncell = 2.5\nbeam = 0.3\nstretch = [\"1 + 0.05*x\", 1, 2]\n");
    check_same(block, "[foam]\nkind = \"kelvin\"\ncell = 2.5\nbeam = 0.3\n");
    // The surface's curves are traced anew: they differ by less than a thousandth of a cell where slices see
    // it.
    const Difference framed = difference(block, foam + "[frame]\nbeam = 0.4\n");
    CHECK(framed.wrong_pixels == 0);
    CHECK(framed.solid_pixels > 100);
    const std::string fields =
        "[[field]]\nname = \"rod\"\nkind = \"cylinder\"\nradius = 2\nheight = 30\nat = [2, 1, 0]\nturn = [0, "
        "20, 0]\n[[field]]\nname = \"half\"\nformula = \"x - 3\"\n"
        "[[field]]\nname = \"slab\"\nkind = \"box\"\nsize = [3, 20, 20]\nat = [-4, 0, 0]\nturn = [0, 0, "
        "15]\n";
    check_same(block,
               foam + fields +
                   "[[region]]\nfield = \"rod\"\nmake = \"solid\"\n[[region]]\nfield = \"slab\"\nmake = "
                   "\"empty\"\n");
    check_same(block,
               foam +
                   "[skin]\nthickness = 0.8\n[[hole]]\nat = [7, 1, 1]\nradius = 1\n[[hole]]\nat = [0, 5, "
                   "0]\nradius = 0.8\ndirection = [0.2, -1, 0]\nthrough = true\n");
}

TEST_CASE("a mesh that is turned is the mesh turned beforehand", "[placement]") {
    const Folder folder;
    const std::string file = LAMELLA_SOURCE_DIR "/examples/inputs/painted_vase.ply";
    const TriangleMesh mesh = read_mesh(file, {}).mesh;
    std::string text;
    for (const dvec3& vertex : mesh.vertices) {
        const dvec3 p = axes_of_turned() * vertex;
        text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
    }
    for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[2] + 1, t[1] + 1);
    write(folder / "turned.obj", text);
    const BuiltJob before = build_job(recipe_of("[part]\nmesh = \"" + folder / "turned.obj" + "\"\n"));
    const BuiltJob turned_here = build_job(recipe_of("[part]\nmesh = \"" + file + "\"\n" + turned));
    const Box box = before.job.bounds;
    for (int k = 0; k < 9; ++k) {
        const double z = box.lo.z + (k + 0.5) / 9 * box.size().z;
        const RowBand band = band_over(box, box.size().x / 3000);
        const auto area = [&](const BuiltJob& built) {
            return static_cast<double>(runs_at(*built.job.part, z, band).total_length());
        };
        CHECK(area(turned_here) == Approx(area(before)).epsilon(1e-9));
        CHECK(area(before) > 0);
    }
    CHECK(turned_here.mesh->volume == Approx(before.mesh->volume).epsilon(1e-12));
    CHECK(before.mesh->volume > 0);
}

TEST_CASE("a foam that stays fixed to the bed does not turn with the part", "[placement]") {
    const std::string foam = "[foam]\nframe = \"bed\"\ncell = 2.5\nbeam = 0.3\nstretch = [1, 1, 2]\n";
    const BuiltJob upright = build_job(recipe_of(block + foam)),
                   turned_part = build_job(recipe_of(block + turned + foam));
    for (const dvec3 p : {dvec3(0), dvec3(1, 0.5, -2), dvec3(-2, 1, 1)})
        CHECK(upright.foam->field->value(p) == turned_part.foam->field->value(p));
    // As designed, the foam lies in the part as it will when the part is turned.
    const BuiltJob designed = build_job(recipe_of(block + turned + foam), {.as_designed = true});
    for (const dvec3 p : {dvec3(0), dvec3(1, 0.5, -2), dvec3(-2, 1, 1)})
        CHECK(designed.foam->field->value(p) ==
              Approx(turned_part.foam->field->value(axes_of_turned() * p)).margin(1e-9));
}

TEST_CASE("a part is laid on a face by its direction or a point of it", "[placement]") {
    const BuiltJob by_direction = build_job(recipe_of(block + "lay_on = [1, 0, 0]\n"));
    CHECK(by_direction.job.bounds.size().z == Approx(14));
    for (const std::string point : {"[7, 1, 1]", "[-7, 1, 1]"}) {
        const BuiltJob by_point = build_job(recipe_of(fmt::format("{}lay_on_at = [{}]\n", block, point)));
        CHECK(by_point.job.bounds.size().z == Approx(14));
        CHECK(by_point.axes[0].z == Approx(point[1] == '7' ? -1 : 1));
    }
    const glm::dmat3 oblique = part_axes(recipe_of(block + "lay_on = [1, 2, 2]\nturn = [0, 0, 40]\n").part);
    CHECK(glm::length(oblique * dvec3(1, 2, 2) / 3.0 - dvec3(0, 0, -1)) < 1e-14);
    CHECK(glm::determinant(oblique) == Approx(1));
    CHECK(part_axes(recipe_of(block + "lay_on = [0, 0, 1]\n").part)[2] == dvec3(0, 0, -1));
}

TEST_CASE("a part is scaled to fit a box once it is turned", "[placement]") {
    const BuiltJob fitted = build_job(recipe_of(block + "turn = [0, 90, 0]\nfit = [20, 0, 21]\n"));
    CHECK(fitted.job.bounds.size().z == Approx(21));  // 14 mm, 1.5 times
    CHECK(fitted.job.bounds.size().x == Approx(12));
    CHECK(fitted.job.bounds.size().y == Approx(15));
}

TEST_CASE("right angles keep whole numbers", "[placement]") {
    const BuiltJob built = build_job(recipe_of(block + "turn = [90, 0, 90]\n"));
    CHECK(built.job.bounds.lo == dvec3(-4, -7, -5));
    CHECK(built.job.bounds.hi == dvec3(4, 7, 5));
}

TEST_CASE("a turned part stands on the bed, whatever it is made of", "[placement]") {
    const std::string ball =
        "[part]\nfield = \"ball\"\n[[field]]\nname = \"ball\"\nformula = \"sqrt(x*x + y*y + z*z) - "
        "6\"\nbounds = [[-6, -6, -6], [6, 6, 6]]\n";
    std::string leaning = ball;
    leaning.insert(leaning.find("[[field]]"), "turn = [45, 30, 0]\n");
    const Box bounds = build_job(recipe_of(leaning)).job.bounds;
    CHECK(length(bounds.lo - dvec3(-6)) < 1e-3);
    CHECK(length(bounds.hi - dvec3(6)) < 1e-3);
    const Box torus =
        build_job(recipe_of("[part]\nshape = \"torus\"\nradius = 6\ntube = 2\nturn = [0, 30, 0]\n"))
            .job.bounds;
    CHECK(torus.size().x == Approx(2 * (6 * std::cos(std::numbers::pi / 6) + 2)));
    CHECK(torus.size().y == Approx(16));
    CHECK(torus.size().z == Approx(2 * (6 * std::sin(std::numbers::pi / 6) + 2)));
}

TEST_CASE("what cannot be turned says so", "[placement]") {
    const std::string loaded =
        "turn = [90, 0, 0]\n[skin]\nthickness = 1\npattern = \"elements\"\n[[element]]\nkind = "
        "\"stick\"\nlength = "
        "4\nwidth = 1\n[elements]\ncount = 10\n";
    CHECK(mentions(complaint_about(block + loaded), "cannot be turned with the part"));
    CHECK(mentions(complaint_about(block + "lay_on_at = [[0, 0, 0]]\n"), "accepted: a point on a face"));
    CHECK(mentions(complaint_about(block + "lay_on = [0, 0, 1]\nlay_on_at = [[7, 0, 0]]\n"),
                   "lay_on_at: cannot be combined with part.lay_on"));
    const std::string overhang =
        "turn = [90, 0, 0]\n[[load]]\nface = \"+z\"\nforce = [0, 0, -1]\n[[anchor]]\nface = "
        "\"-z\"\n[optimize]\nvolume = 0.5\nelements = 8\niterations = 2\noverhang = true\n";
    CHECK(mentions(complaint_about(block + overhang), "optimize.overhang: "));
}

}  // namespace part_placement_test
