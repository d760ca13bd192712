// Gradings of a recipe are the numbers that their entries describe, and foams and skins get them.
#include "recipe/build/build_gradings.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "app/reports/foam_statistics.h"
#include "app/reports/grading_report.h"
#include "engine/base/error.h"
#include "recipe/build/build_job.h"
#include "recipe/identity.h"
#include "recipe/recipe_draft.h"
#include "tests/engine/io/implicit_samples.h"

namespace build_gradings_test {

using namespace lamella;

namespace {

Recipe read(const std::string& text) {
    RecipeDraft draft;
    draft.read_text("[part]\nshape = \"sphere\"\nradius = 10\n" + text, "test.toml");
    return draft.finish();
}

std::string grading(const std::string& keys) { return "[[grading]]\nname = \"g\"\n" + keys; }

/// What a formula over the grading `g` gives at a point.
double at(const std::string& keys, dvec3 p, const std::string& formula = "g") {
    const Recipe recipe = read(grading(keys));
    Gradings gradings(recipe);
    return gradings.resolve({formula, "here"})->at(p);
}

/// A file that is gone when the test is.
class File {
  public:
    File(const std::string& ending, const std::string& bytes)
        : path_((std::filesystem::temp_directory_path() /
                 ("lamella_gradings_" + std::to_string(getpid()) + ending))
                    .string()) {
        write(bytes);
    }
    ~File() { std::remove(path_.c_str()); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

}  // namespace

TEST_CASE("constants, formulas, points, lines and planes are what geometry says") {
    CHECK(at("kind = \"constant\"\nvalue = 2.5\n", {1, 2, 3}) == 2.5);
    CHECK(at("kind = \"formula\"\nformula = \"x + 10*y\"\n", {1, 2, 3}, "g + 1") == 22);
    CHECK(at("kind = \"point\"\nat = [1, 0, 0]\n", {4, 4, 0}) == Approx(5));
    CHECK(at("kind = \"line\"\na = [0, 0, 0]\nb = [0, 0, 10]\n", {3, 4, 5}) == Approx(5));
    CHECK(at("kind = \"plane\"\nat = [0, 0, 2]\nnormal = [0, 0, 3]\n", {7, 7, 1}) == Approx(-1));
}

TEST_CASE("attractors give near at a point or segment and far beyond the radius") {
    const std::string keys =
        "kind = \"attractors\"\npoints = [[0, 0, 0], [20, 0, 0]]\nsegments = [[[0, 50, 0], [10, 50, 0]]]\n"
        "near = 1.5\nfar = 5\nradius = 8\nfalloff = \"linear\"\n";
    CHECK(at(keys, {20, 0, 0}) == Approx(1.5));
    CHECK(at(keys, {5, 50, 0}) == Approx(1.5));
    CHECK(at(keys, {0, -4, 0}) == Approx(3.25));
    CHECK(at(keys, {0, -9, 0}) == Approx(5));
}

TEST_CASE("a table has its rows in the recipe or in a file") {
    CHECK(at("kind = \"table\"\nalong = \"z\"\nrows = [[0, 2], [40, 5]]\n", {9, 9, 20}) == Approx(3.5));
    const File csv(".csv", "height,cell\n0,2\n40,5\n");
    CHECK(at("kind = \"table\"\nalong = \"2*z\"\nfile = \"" + csv.path() + "\"\n", {9, 9, 10}) ==
          Approx(3.5));
}

TEST_CASE("a volume lies in its box") {
    const File nrrd(".nrrd", "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 1 1\nencoding: text\n\n1 3\n");
    const std::string keys =
        "kind = \"volume\"\nfile = \"" + nrrd.path() + "\"\nbox = [[0,0,0],[20,10,10]]\n";
    CHECK(at(keys, {5, 5, 5}) == Approx(1));
    CHECK(at(keys, {10, 5, 5}) == Approx(2));
    CHECK(at(keys, {15, 5, 5}) == Approx(3));
}

TEST_CASE("properties and functions of a 3MF are gradings") {
    using namespace lamella::samples;
    const File file(
        ".3mf", zip_of({{"3D/3dmodel.model",
                         volumetric_xml(sphere_function("5", 0.5) +
                                            "<v:volumedata id=\"8\"><v:property name=\"n:density\" "
                                            "functionid=\"5\" channel=\"shape\"/></v:volumedata>" +
                                            box_object("1", 3, "volumeid=\"8\""),
                                        "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/>")}}));
    const std::string keys = "kind = \"3mf\"\nfile = \"" + file.path() + "\"\n";
    CHECK(at(keys + "property = \"density\"\n", {5, 3, 4}) == Approx(4.5));
    CHECK(at(keys + "property = \"n:density\"\nobject = \"1\"\n", {5, 3, 4}, "2*g") == Approx(9));
    CHECK(at(keys + "function = \"sphere.place.x\"\n", {5, 3, 4}) == Approx(5));
    CHECK_THROWS_WITH(
        at(keys + "property = \"modulus\"\n", {0, 0, 0}),
        Catch::Contains("test.toml:4: [[grading]] `g`: ") || Catch::Contains("a property \"modulus\""));
    CHECK_THROWS_WITH(at(keys, {0, 0, 0}), Catch::Contains("property"));
}

TEST_CASE("an attribute is what the mesh's nearest surface has, in the part's scale") {
    // A cube of side 10 whose corners carry their own x.
    std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
        "property float warmth\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n";
    for (int i = 0; i < 8; ++i) {
        const int x = i & 1 ? 10 : 0;
        ply +=
            std::to_string(x) + (i & 2 ? " 10" : " 0") + (i & 4 ? " 10 " : " 0 ") + std::to_string(x) + "\n";
    }
    ply += "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
    const File cube(".ply", ply);
    RecipeDraft draft;
    draft.read_text("[part]\nmesh = \"" + cube.path() + "\"\nscale = 2\n" +
                        grading("kind = \"attribute\"\nattribute = \"warmth\"\n") +
                        "[foam]\ncell = \"2 + 0.1*g\"\nbeam = 0.2\n[skin]\nthickness = \"0.5 + 0.1*g\"\n",
                    "test.toml");
    const BuiltJob built = build_job(draft.finish());
    CHECK(built.body->bounds().hi.x == Approx(20));
    CHECK(built.foam->cell.made->at({6, 10, 1}) == Approx(2.3));
    CHECK(built.foam->cell.made->at({19, 10, 10}) == Approx(3));
    CHECK(built.skin->made->at({12, 10, 19.5}) == Approx(1.1));
}

TEST_CASE("the depth is measured from the part's surface") {
    const Recipe recipe = read("");
    Gradings gradings(recipe);
    CHECK_THROWS_AS(gradings.resolve({"d", "--cell"}), InputError);
    std::optional<MeshReport> none;
    gradings.set_body(build_body(recipe, gradings, none));
    CHECK(gradings.resolve({"2 * d", "--cell"})->at({0, 0, 7}) == Approx(6));
}

TEST_CASE("a file that is missing is told with the grading that wants it, and only when it is used") {
    const std::string lost = grading("kind = \"table\"\nalong = \"z\"\nfile = \"/no/such.csv\"\n");
    CHECK_NOTHROW(build_foam_alone(read(lost + "[foam]\ncell = 3\nbeam = 0.2\n"), {dvec3(0), dvec3(5)}));
    try {
        build_foam_alone(read(lost + "[foam]\ncell = \"g\"\nbeam = 0.2\n"), {dvec3(0), dvec3(5)});
        FAIL("the file is not there");
    } catch (const InputError& error) {
        const std::string text = error.what();
        INFO(text);
        CHECK(text.starts_with("test.toml:4: grading `g`: "));
        CHECK(text.find("/no/such.csv") != std::string::npos);
    }
}

TEST_CASE("a foam's cells and beams are as the formulas ask, kept within the printable range") {
    const Recipe recipe =
        read("[foam]\ncell = \"2 + 0.3*x\"\ncell_min = 1.5\ncell_max = 4\nbeam = \"0.1 * cell\"\n");
    const BuiltJob built = build_job(recipe);
    REQUIRE(built.foam);
    CHECK(built.foam->cell.made->at({0, 0, 0}) == Approx(2));
    CHECK(built.foam->cell.made->at({-5, 0, 0}) == 1.5);
    CHECK(built.foam->cell.made->at({9, 0, 0}) == 4);
    CHECK(built.foam->member.made->at({9, 0, 0}) == Approx(0.4));
    // Where cells are small, beams are many and thin.
    const auto fine = built.foam->beams_touching({{-9, -2, -2}, {-5, 2, 2}});
    const auto coarse = built.foam->beams_touching({{5, -2, -2}, {9, 2, 2}});
    CHECK(fine.size() > 3 * coarse.size());
    for (const Beam& beam : fine) CHECK(beam.ra < 0.25);
    for (const Beam& beam : coarse) CHECK(beam.ra > 0.25);
}

TEST_CASE("expected seeds are the integral of the density") {
    const BuiltJob built = build_job(read("[foam]\ncell = \"2 + 0.1*x\"\nbeam = 0.1\n"));
    // The integral of (2 + x/10)^-3 over x from -10 to 10 is 5 (1 - 1/9); times the box's section.
    const double expected = 5 * (1 - 1.0 / 9) * 400;
    CHECK(foam_statistics(*built.foam, built.job.bounds, 96).seeds == Approx(expected).epsilon(0.01));
}

TEST_CASE("what is clamped, undefined or too steep is reported with its share of the part") {
    const BuiltJob built = build_job(read(
        "[foam]\ncell = \"3 + 0.01*x\"\ncell_min = 3\nbeam = \"z > 0 ? sqrt(-1) : 0.2\"\nbeam_max = 0.5\n"));
    const auto reports = grading_reports(built);
    REQUIRE(reports.size() == 2);
    CHECK(reports[0].key == "foam.cell");
    CHECK(reports[0].clamped == Approx(0.5).margin(0.02));
    CHECK(reports[0].asked.lo == Approx(2.9).margin(0.01));
    CHECK(reports[0].asked.hi == Approx(3.1).margin(0.01));
    CHECK(reports[0].undefined == 0);
    CHECK(reports[0].steepest < 1.1);
    REQUIRE(warnings(reports[0]).size() == 1);
    CHECK(reports[1].key == "foam.beam");
    CHECK(reports[1].undefined == Approx(0.5).margin(0.02));
    REQUIRE(warnings(reports[1]).size() == 1);
    const auto steep = grading_reports(build_job(read("[foam]\ncell = \"x < 0 ? 1 : 4\"\nbeam = 0.1\n")));
    REQUIRE(steep.size() == 1);
    CHECK(steep[0].steepest == Approx(4));
    CHECK(warnings(steep[0]).size() == 1);
    CHECK(grading_reports(build_job(read("[foam]\ncell = 3\nbeam = 0.2\n"))).empty());
}

TEST_CASE("a skin may vary in thickness") {
    const BuiltJob built = build_job(read("[skin]\nthickness = \"2 + 0.1*z\"\n"));
    const Field& part = *built.job.part;
    CHECK(part.value({0, 0, 7.4}) < 0);  // 2.6 deep, 2.74 thick
    CHECK(part.value({0, 0, 7.2}) > 0);  // 2.8 deep, 2.72 thick
    CHECK(part.value({8.5, 0, 0}) < 0);
    CHECK(part.value({7.5, 0, 0}) > 0);
    CHECK(part.value({0, 0, -8}) > 0);
}

TEST_CASE("every kind of foam fills a part with something that is neither empty nor full") {
    for (const FoamBuilder& builder : foam_builders()) {
        const std::string kind = builder.kind.word;
        CAPTURE(kind);
        std::string keys = "[foam]\nkind = \"" + kind + "\"\ncell = \"3 + 0.05*z\"\n";
        keys += builder.member == "wall" ? "wall = 0.4\n" : "beam = 0.3\n";
        if (kind == "closed") keys += "wall = 0.2\nwindow = 0.5\n";
        if (kind == "lattice") keys += "unit_cell = \"octet\"\n";
        const BuiltJob built = build_job(read(keys));
        int solid = 0, inside = 0;
        for (int i = 0; i < 4000; ++i) {
            const dvec3 p(std::fmod(i * 0.754877, 12.0) - 6, std::fmod(i * 0.569840, 12.0) - 6,
                          std::fmod(i * 0.430159, 10.0) - 5);
            if (!(built.body->value(p) < 0)) continue;
            ++inside;
            solid += built.job.part->value(p) < 0;
        }
        CHECK(solid > inside / 100);
        CHECK(solid < inside * 3 / 4);
    }
}

TEST_CASE("the identity follows formulas, gradings and the bytes of their files") {
    const File csv(".csv", "0,2\n40,5\n");
    const std::string table =
        grading("kind = \"table\"\nalong = \"z\"\nfile = \"" + csv.path() + "\"\n") + "[foam]\nbeam = 0.2\n";
    const Recipe recipe = read(table + "cell = \"g\"\n");
    const std::string before = job_identity(recipe);
    CHECK(job_identity(read(table + "cell = \"g + 0\"\n")) != before);
    csv.write("0,2\n40,6\n");
    CHECK(job_identity(recipe) != before);
    csv.write("0,2\n40,5\n");
    CHECK(job_identity(recipe) == before);
}

}  // namespace build_gradings_test
