// 3MF functions, level sets and properties against closed forms, and everything that is refused.
#include "procedural/volume/volumetric_model.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/formula/formula_field.h"
#include "engine/formula/formula_grading.h"
#include "engine/formula/formula_parser.h"
#include "engine/io/image_file.h"
#include "engine/mesh/mesh_field.h"
#include "engine/mesh/mesh_repair.h"
#include "engine/solids/primitives.h"
#include "tests/engine/io/implicit_samples.h"
#include "tests/engine/runs/plane_runs.h"
#include "tests/procedural/grading/grading_checks.h"

namespace volumetric_model_test {

using namespace lamella;
using namespace lamella::samples;

namespace {

GradingPtr grading_of(VolumetricModel& model, std::string_view function) {
    PlacedFormula placed = model.function(function);
    return make_formula_grading(std::move(placed.formula), std::move(placed.others));
}

VolumetricModel model_of(const std::string& resources, const std::string& items = "<item objectid=\"1\"/>",
                         const std::string& attributes = "",
                         std::vector<std::pair<std::string, std::string>> parts = {}) {
    parts.emplace_back("3D/3dmodel.model", volumetric_xml(resources, items, attributes));
    return VolumetricModel("a.3mf", zip_of(parts));
}

const Box cube{dvec3(-6), dvec3(6)};

/// Pages of a ramp along x, y and z: 1 to 250 in steps.
std::vector<std::pair<std::string, std::string>> ramp_sheets(int columns, int rows, int sheets, int axis,
                                                             int channels = 1) {
    std::vector<std::pair<std::string, std::string>> parts;
    for (int z = 0; z < sheets; ++z) {
        std::vector<std::uint8_t> pixels;
        for (int row = 0; row < rows; ++row) {
            for (int x = 0; x < columns; ++x) {
                const int place[] = {x, rows - 1 - row, z};
                for (int c = 0; c < channels; ++c)
                    pixels.push_back(static_cast<std::uint8_t>(10 * place[(axis + c) % 3] + 5));
            }
        }
        ImageData image;
        image.width = columns;
        image.height = rows;
        image.channels = channels;
        image.pixels = pixels;
        image.linear = true;
        const std::vector<std::byte> file = encode_image("sheet.png", image);
        parts.emplace_back("3D/volumetric/" + std::to_string(z) + ".png",
                           std::string(reinterpret_cast<const char*>(file.data()), file.size()));
    }
    return parts;
}

std::string image_xml(int columns, int rows, int sheets, const std::string& attributes) {
    std::string xml = "<v:image3d id=\"2\"><v:imagestack rowcount=\"" + std::to_string(rows) +
                      "\" columncount=\"" + std::to_string(columns) + "\" sheetcount=\"" +
                      std::to_string(sheets) + "\">";
    for (int z = 0; z < sheets; ++z)
        xml += "<v:imagesheet path=\"/3D/volumetric/" + std::to_string(z) + ".png\"/>";
    return xml + "</v:imagestack></v:image3d><v:functionfromimage3d id=\"3\" image3did=\"2\" " + attributes +
           "/>";
}

}  // namespace

TEST_CASE("a sphere's graph is its closed form, in the model's unit", "[volumetric]") {
    const auto [unit, mm] = GENERATE(
        table<std::string, double>({{"", 1.0}, {"unit=\"inch\"", 25.4}, {"unit=\"micron\"", 0.001}}));
    VolumetricModel model =
        model_of(box_object("1", 6) + sphere_function("5", 2.5), "<item objectid=\"1\"/>", unit);
    const GradingPtr grading = grading_of(model, "sphere");
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const dvec3 p = checks::random_point(random, cube);
        CHECK(grading->at(p * mm) == Approx(glm::length(p) - 2.5).margin(1e-12));
    }
    CHECK(grading_of(model, "5")->at(dvec3(0)) == -2.5);
    CHECK(grading_of(model, "5.shape")->at(dvec3(0)) == -2.5);
    CHECK(grading_of(model, "sphere.shape")->at(dvec3(0)) == -2.5);
    CHECK(grading_of(model, "5.place.y")->at(dvec3(1, 2, 3) * mm) == Approx(2));
}

TEST_CASE("a level set is placed by its item, its components, its own transform and the unit",
          "[volumetric]") {
    // The object's coordinates are halved on the way to the function: radius 5 within a box of side 12.
    const std::string resources =
        box_object("1", 6) + sphere_function("5", 2.5) +
        level_set_object("4",
                         "functionid=\"5\" channel=\"shape\" meshid=\"1\" "
                         "transform=\"0.5 0 0 0 0.5 0 0 0 0.5 0 0 0\"") +
        "<object id=\"9\"><components><component objectid=\"4\" transform=\"1 0 0 0 1 0 0 0 1 0 0 7\"/>"
        "</components></object>";
    const std::string turn = GENERATE("1 0 0 0 1 0 0 0 1 10 20 30", "0 1 0 -1 0 0 0 0 1 10 20 30",
                                      "0.6 0.8 0 -0.8 0.6 0 0 0 1 10 20 30", "-2 0 0 0 2 0 0 0 2 10 20 16");
    CAPTURE(turn);
    const bool doubled = turn.find("-2") == 0;
    const double scale = doubled ? 20.0 : 10.0;
    VolumetricModel model =
        model_of(resources, "<item objectid=\"9\" transform=\"" + turn + "\"/>", "unit=\"centimeter\"");
    const FieldPtr solid = model.built();
    const dvec3 centre(100, 200, doubled ? 300.0 : 370.0);
    const double radius = 5 * scale;
    const FieldPtr truth = make_sphere(centre, radius);
    std::mt19937 random(2);
    const Box around = grown(Box{centre - radius, centre + radius}, 20);
    for (int i = 0; i < 300; ++i) {
        const dvec3 p = checks::random_point(random, around);
        if (std::abs(truth->value(p)) > 1e-6) CHECK((solid->value(p) < 0) == (truth->value(p) < 0));
    }
    CHECK(volume_in(*solid, around, 2.0) == Approx(volume_in(*truth, around, 2.0)).epsilon(2e-4));
    // Its object alone is in its own place where it is not built by itself.
    CHECK(model.object("9")->value(centre) < 0);
    CHECK(model.object("4")->value(centre) < 0);
}

TEST_CASE("what nothing uses may be unfinished, and is refused where it is used", "[volumetric]") {
    // As Gladius writes them: a function whose input is loose, and one with a loose node beside the result.
    const std::string loose =
        graph("7", "draft",
              node("multiplication", "m", {"vectorref A inputs.pos", "vectorref B "}, "vector result"),
              "<i:vectorref identifier=\"result\" ref=\"m.result\"/>");
    const std::string unknown =
        graph("8", "foreign", node("noise", "n", {"vectorref A inputs.pos"}, "scalar result"),
              "<i:scalarref identifier=\"result\" ref=\"n.result\"/>");
    std::string sphere = sphere_function("5", 4);
    sphere.insert(sphere.find("<i:length"), node("abs", "spare", {"scalarref A "}, "scalar result"));
    sphere.insert(sphere.rfind("</i:out>"), "<i:scalarref identifier=\"spare\" ref=\"\"/>");
    VolumetricModel model =
        model_of(box_object("1", 6) + loose + unknown + sphere +
                     level_set_object("4", "functionid=\"5\" channel=\"shape\" meshid=\"1\""),
                 "<item objectid=\"4\"/>");
    CHECK(volume_in(*model.built(), cube, 0.05) == Approx(4.0 / 3 * 3.14159265358979 * 64).epsilon(1e-3));
    CHECK(grading_of(model, "5.shape")->at(dvec3(0)) == -4);
    CHECK_THROWS_WITH(
        model.function("5.spare"),
        "a.3mf: function 5 \"sphere\": output \"spare\": nothing feeds it; it needs a ref of the "
        "form node.output");
    CHECK_THROWS_WITH(
        model.function("draft.result.x"),
        "a.3mf: function 7 \"draft\": node \"m\" (multiplication): input \"B\": nothing feeds it; "
        "it needs a ref of the form node.output");
    CHECK_THROWS_WITH(model.function("foreign"), Catch::Contains("node \"n\" (noise): nodes of this kind"));
}

TEST_CASE("an output may be declared by both of its names, and used by either", "[volumetric]") {
    std::vector<std::string> entries;
    for (const char* const row : {"0", "1", "2", "3"}) {
        for (const char* const column : {"0", "1", "2", "3"})
            entries.push_back(std::string("scalarref m") + row + column +
                              (*row == *column ? " two" : " nil") + ".value");
    }
    for (const char* const used : {"matrix", "result"}) {
        const std::string turned = graph(
            "3", "turned",
            constant_node("two", 2) + constant_node("nil", 0) +
                node("composematrix", "turn", entries, "matrix result matrix matrix") +
                node("matvecmultiplication", "moved",
                     {std::string("matrixref A turn.") + used, "vectorref B inputs.pos"}, "vector result"),
            "<i:vectorref identifier=\"place\" ref=\"moved.result\"/>");
        VolumetricModel model = model_of(box_object("1", 6) + turned);
        CHECK(grading_of(model, "turned.place.y")->at(dvec3(1, 3, 5)) == 6);
    }
    VolumetricModel wrong = model_of(
        box_object("1", 6) +
        graph("3", "turned", node("transpose", "t", {"matrixref A m.result"}, "matrix result scalar matrix"),
              "<i:matrixref identifier=\"m\" ref=\"t.result\"/>"));
    CHECK_THROWS_WITH(wrong.function("turned"),
                      Catch::Contains("output \"matrix\" is said to be a scalar, but is a matrix"));
}

TEST_CASE("a level set ends at its mesh, or at the box about it", "[volumetric]") {
    const TriangleMesh wedge{{{-3, -3, -3}, {3, -3, -3}, {-3, 3, -3}, {-3, -3, 3}},
                             {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    const std::string everything =
        graph("7", "",
              "<i:constant identifier=\"c\" value=\"-1\"><i:out><i:scalar identifier=\"value\"/>"
              "</i:out></i:constant>",
              "<i:scalarref identifier=\"shape\" ref=\"c.value\"/>");
    const std::string resources =
        object_xml("1", wedge) + everything +
        level_set_object("4", "functionid=\"7\" channel=\"shape\" meshid=\"1\"") +
        level_set_object("5", "functionid=\"7\" channel=\"shape\" meshid=\"1\" meshbboxonly=\"true\"");
    VolumetricModel model = model_of(resources, "<item objectid=\"4\"/>");
    const Box around{dvec3(-4), dvec3(4)};
    CHECK(volume_in(*model.object("4"), around, 0.05) == Approx(36).epsilon(0.01));
    CHECK(volume_in(*model.object("5"), around, 0.1) == Approx(216).epsilon(1e-3));
    const Box bounds = model.object("5")->bounds();
    CHECK(bounds.lo == dvec3(-3));
    CHECK(bounds.hi == dvec3(3));
}

TEST_CASE("a gyroid's graph is the same formula: bits, ranges and runs", "[volumetric]") {
    VolumetricModel model =
        model_of(box_object("1", 6) + gyroid_function("5") +
                     level_set_object("4", "functionid=\"5\" channel=\"shape\" meshid=\"1\""),
                 "<item objectid=\"4\"/>");
    const std::string text = "abs(sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)) - 0.3";
    const std::string names[] = {"x", "y", "z"};
    const Formula truth = parse_formula(text, names);
    const PlacedFormula found = model.function("gyroid");
    CHECK(found.others.empty());
    CHECK(found.formula.size() == truth.size());
    std::mt19937 random(3);
    for (int i = 0; i < 500; ++i) {
        const dvec3 p = checks::random_point(random, cube);
        const double inputs[] = {p.x, p.y, p.z};
        CHECK(found.formula.at(inputs) == truth.at(inputs));
    }
    const FieldPtr written = make_formula_field(truth, {}, Box{dvec3(-6), dvec3(6)});
    const FieldPtr read = model.built();
    const RowBand band = band_over(cube, 0.1);
    for (const double z : {-5.0, -1.3, 0.4, 3.3}) {
        const RunRows a = runs_at(*written, z, band), b = runs_at(*read, z, band);
        REQUIRE(a.lines() == b.lines());
        for (std::size_t line = 0; line < a.lines(); ++line) {
            const auto p = a.line(line), q = b.line(line);
            REQUIRE(p.size() == q.size());
            for (std::size_t i = 0; i < p.size(); ++i) {
                CHECK(p[i].begin == q[i].begin);
                CHECK(p[i].end == q[i].end);
            }
        }
    }
    CHECK(read->range({{-1, -1, -1}, {1, 1, 1}}).contains(read->value({0.3, 0.4, 0.5})));
}

TEST_CASE("functions call each other, with resource ids from inputs, too", "[volumetric]") {
    // A union of two spheres by one call each, the function itself handed on as a resource.
    const std::string moved =
        "<i:constresourceid identifier=\"which\" value=\"5\"><i:out><i:resourceid "
        "identifier=\"value\"/></i:out>"
        "</i:constresourceid>"
        "<i:constvec identifier=\"shift\" x=\"3\" y=\"0\" z=\"0\"><i:out><i:vector "
        "identifier=\"vector\"/></i:out>"
        "</i:constvec>" +
        node("subtraction", "there", {"vectorref A inputs.pos", "vectorref B shift.vector"},
             "vector result") +
        node("functioncall", "near", {"resourceref functionID which.value", "vectorref pos inputs.pos"},
             "scalar shape") +
        node("functioncall", "far", {"resourceref functionID which.value", "vectorref pos there.result"},
             "scalar shape") +
        node("min", "both", {"scalarref A near.shape", "scalarref B far.shape"}, "scalar result");
    VolumetricModel model =
        model_of(box_object("1", 6) + sphere_function("5", 2.5) +
                 graph("6", "two", moved, "<i:scalarref identifier=\"shape\" ref=\"both.result\"/>"));
    const GradingPtr grading = grading_of(model, "two");
    for (const double x : {-4.0, 0.0, 1.5, 4.0, 7.0}) {
        CHECK(grading->at({x, 1, 0}) == Approx(std::min(std::hypot(x, 1.0), std::hypot(x - 3, 1.0)) - 2.5));
    }
}

TEST_CASE("distances to meshes are those of the mesh, wherever they are asked", "[volumetric]") {
    const std::string nodes =
        "<i:constresourceid identifier=\"which\" value=\"1\"><i:out><i:resourceid "
        "identifier=\"value\"/></i:out>"
        "</i:constresourceid>"
        "<i:constvec identifier=\"shift\" x=\"3\" y=\"0\" z=\"0\"><i:out><i:vector "
        "identifier=\"vector\"/></i:out>"
        "</i:constvec>" +
        node("subtraction", "there", {"vectorref A inputs.pos", "vectorref B shift.vector"},
             "vector result") +
        node("mesh", "signed", {"vectorref pos there.result", "resourceref mesh which.value"},
             "scalar distance") +
        node("unsignedmesh", "unsigned", {"vectorref pos there.result", "resourceref mesh which.value"},
             "scalar distance");
    VolumetricModel model =
        model_of(box_object("1", 2) + graph("6", "two", nodes,
                                            "<i:scalarref identifier=\"shape\" ref=\"signed.distance\"/>"
                                            "<i:scalarref identifier=\"away\" ref=\"unsigned.distance\"/>"));
    const FieldPtr truth = make_mesh_field(close_mesh(box_mesh(dvec3(-2), dvec3(2))));
    const GradingPtr with_sign = grading_of(model, "6.shape"), without = grading_of(model, "6.away");
    std::mt19937 random(4);
    for (int i = 0; i < 300; ++i) {
        const dvec3 p = checks::random_point(random, cube);
        const double d = truth->value(p - dvec3(3, 0, 0));
        CHECK(with_sign->at(p) == Approx(d).margin(1e-12));
        CHECK(without->at(p) == Approx(std::abs(d)).margin(1e-12));
    }
    checks::check_ranges(*with_sign, cube);
    checks::check_ranges(*without, cube);
}

TEST_CASE("an image's ramp is its formula between the centres, scaled and moved", "[volumetric][image3d]") {
    const int axis = GENERATE(0, 1, 2);
    CAPTURE(axis);
    VolumetricModel model =
        model_of(box_object("1", 6) + image_xml(8, 6, 5,
                                                "valuescale=\"51\" valueoffset=\"-3\" tilestyleu=\"clamp\" "
                                                "tilestylev=\"clamp\" tilestylew=\"clamp\""),
                 "<item objectid=\"1\"/>", "", ramp_sheets(8, 6, 5, axis));
    const GradingPtr grading = grading_of(model, "3.red");
    const int voxels[] = {8, 6, 5};
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
        const dvec3 p = checks::random_point(random, {dvec3(-0.5), dvec3(1.5)});
        const double at = std::clamp(p[axis] * voxels[axis] - 0.5, 0.0, voxels[axis] - 1.0);
        CHECK(grading->at(p) == Approx((10 * at + 5) / 255 * 51 - 3).margin(1e-12));
        CHECK(grading_of(model, "3.color.z")->at(p) == grading->at(p));
        CHECK(grading_of(model, "3.alpha")->at(p) == 48);
    }
    checks::check_ranges(*grading, {dvec3(-1), dvec3(2)});
}

TEST_CASE("coloured images have their channels, and tiles of the style none end", "[volumetric][image3d]") {
    VolumetricModel model = model_of(box_object("1", 6) + image_xml(8, 6, 5, "tilestyleu=\"none\""),
                                     "<item objectid=\"1\"/>", "", ramp_sheets(8, 6, 5, 0, 3));
    const dvec3 p(3.5 / 8, 2.5 / 6, 1.5 / 5);
    CHECK(grading_of(model, "3.red")->at(p) == Approx(35.0 / 255));
    CHECK(grading_of(model, "3.green")->at(p) == Approx(25.0 / 255));
    CHECK(grading_of(model, "3.blue")->at(p) == Approx(15.0 / 255));
    CHECK(grading_of(model, "3.color.y")->at(p) == Approx(25.0 / 255));
    CHECK(std::isnan(grading_of(model, "3.red")->at({1.5, 0.5, 0.5})));
    CHECK(grading_of(model, "3.red")->at({0.5, 7.5, 0.5}) == grading_of(model, "3.red")->at({0.5, 0.5, 0.5}));
}

TEST_CASE("properties follow their object to the platform and fall back where they are undefined",
          "[volumetric]") {
    // sqrt of x: undefined below zero. In the object's coordinates, which begin at x = 10 mm.
    const std::string root =
        node("decomposevector", "parts", {"vectorref A inputs.pos"}, "scalar x scalar y scalar z") +
        node("sqrt", "root", {"scalarref A parts.x"}, "scalar result");
    const std::string resources =
        graph("6", "root", root,
              "<i:scalarref identifier=\"number\" ref=\"root.result\"/>"
              "<i:vectorref identifier=\"place\" ref=\"inputs.pos\"/>") +
        "<v:volumedata id=\"8\"><v:property name=\"n:density\" functionid=\"6\" channel=\"number\" "
        "transform=\"0.5 0 0 0 1 0 0 0 1 0 0 0\" fallbackvalue=\"-7\"/>"
        "<v:property name=\"n:flow\" functionid=\"6\" channel=\"place\"/></v:volumedata>" +
        box_object("1", 6, "v:volumeid=\"8\"") + box_object("2", 3);
    VolumetricModel model = model_of(
        resources, "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"/><item objectid=\"2\"/>",
        "unit=\"centimeter\"");
    const GradingPtr density = model.property("density", "");
    CHECK(density->at({90, 3, 4}) == Approx(2));
    CHECK(density->at({9, 3, 4}) == -7);
    CHECK(model.property("n:density", "1")->at({90, 3, 4}) == Approx(2));
    CHECK(model.property("flow.y", "")->at({90, 3, 4}) == Approx(0.3));
    checks::check_ranges(*density, {dvec3(-50), dvec3(100)});
    CHECK_THROWS_WITH(model.property("flow", ""), Catch::Contains("is a vector; add .x, .y or .z"));
    CHECK_THROWS_WITH(
        model.property("modulus", ""),
        Catch::Contains("no object that is built has a property \"modulus\"; it has n:density, n:flow"));
    CHECK_THROWS_WITH(model.property("density", "3"),
                      Catch::Contains("there is no object \"3\"; it has 1, 2"));
    VolumetricModel twice = model_of(
        resources, "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 1 0 0\"/><item objectid=\"1\"/>");
    CHECK_THROWS_WITH(twice.property("density", ""), Catch::Contains("of object 1 and of object 1"));
}

TEST_CASE("meshes and level sets of one build section are united", "[volumetric]") {
    VolumetricModel model =
        model_of(box_object("1", 2) + box_object("2", 6) + sphere_function("5", 2.5) +
                     level_set_object("4", "functionid=\"5\" channel=\"shape\" meshid=\"2\""),
                 "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 10 0 0\"/>"
                 "<item objectid=\"4\"/>");
    const FieldPtr solid = model.built();
    CHECK(solid->value({10, 0, 0}) < 0);
    CHECK(solid->value({0, 0, 0}) < 0);
    CHECK(solid->value({5, 0, 0}) > 0);
    CHECK(model.object("1")->value({0, 0, 0}) > 0);
}

TEST_CASE("a file that builds nothing has functions all the same", "[volumetric]") {
    VolumetricModel model = model_of(sphere_function("5", 2.5), "");
    CHECK(grading_of(model, "5")->at(dvec3(0)) == -2.5);
    CHECK_THROWS_WITH(model.built(), Catch::Contains("its build section lists no items"));
}

TEST_CASE("a damaged package of sheets is refused, whatever is wrong with it", "[volumetric][image3d]") {
    const auto sheets = ramp_sheets(8, 6, 5, 0);
    const auto refusal = [&](const std::string& resources,
                             std::vector<std::pair<std::string, std::string>> parts) {
        try {
            VolumetricModel model =
                model_of(box_object("1", 6) + resources, "<item objectid=\"1\"/>", "", parts);
            grading_of(model, "3.red");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("nothing was refused");
    };
    CHECK_THAT(
        refusal(image_xml(8, 7, 5, ""), sheets),
        Catch::Contains("a.3mf: image3d 2: sheet \"3D/volumetric/0.png\" has 6 rows and 8 columns; the "
                        "imagestack says 7 and 8"));
    CHECK_THAT(refusal(image_xml(8, 6, 6, ""), sheets),
               Catch::Contains("has no part \"3D/volumetric/5.png\""));
    auto damaged = sheets;
    damaged[2].second = "not a picture";
    CHECK_THAT(refusal(image_xml(8, 6, 5, ""), damaged),
               Catch::Contains("sheet \"3D/volumetric/2.png\" is no PNG image"));
    damaged = sheets;
    damaged[2].second.resize(damaged[2].second.size() / 2);
    CHECK_THAT(refusal(image_xml(8, 6, 5, ""), damaged), Catch::Contains("sheet \"3D/volumetric/2.png\""));
    damaged = sheets;
    damaged[3] = {damaged[3].first, ramp_sheets(8, 6, 1, 0, 3)[0].second};
    CHECK_THAT(refusal(image_xml(8, 6, 5, ""), damaged), Catch::Contains("other channels or bits"));
    std::string large = image_xml(8, 6, 5, "");
    large.replace(large.find("sheetcount=\"5\""), 14, "sheetcount=\"2000000000\"");
    CHECK_THAT(refusal(large, sheets), Catch::Contains("sheetcount is 2000000000, and it has 5 sheets"));
    CHECK_THAT(refusal("<v:functionfromimage3d id=\"3\" image3did=\"2\"/>", sheets),
               Catch::Contains("a.3mf: function 3: it samples image3d 2, which does not exist"));
    CHECK_THAT(refusal(image_xml(8, 6, 5, "filter=\"cubic\""), sheets),
               Catch::Contains("filter=\"cubic\" is unknown; known: linear, nearest"));
    CHECK_THAT(refusal(image_xml(8, 6, 5, "valuescale=\"nan\""), sheets),
               Catch::Contains("valuescale=\"nan\" is no number"));
}

TEST_CASE("no cut of a volumetric file crashes its reader", "[volumetric]") {
    auto parts = ramp_sheets(8, 6, 2, 0);
    const std::string resources = box_object("1", 6) + image_xml(8, 6, 2, "") + gyroid_function("5") +
                                  level_set_object("4", "functionid=\"5\" channel=\"shape\" meshid=\"1\"");
    const std::string xml = volumetric_xml(resources, "<item objectid=\"4\"/>");
    int read = 0;
    const auto attempt = [&](const std::string& bytes) {
        try {
            VolumetricModel model("a.3mf", bytes);
            read += model.built()->value(dvec3(0)) < 100 ? 1 : 0;
            grading_of(model, "3.red");
        } catch (const InputError&) {
        }
    };
    parts.emplace_back("3D/3dmodel.model", xml);
    const std::string whole = zip_of(parts);
    attempt(whole);
    CHECK(read == 1);
    for (std::size_t cut = 0; cut < whole.size(); cut += 37) attempt(whole.substr(0, cut));
    std::mt19937 random(6);
    for (int round = 0; round < 300; ++round) {
        std::string mangled = xml;
        for (int change = 0; change < 3; ++change) {
            const std::size_t at = random() % mangled.size();
            if (round % 3 == 0) mangled[at] = static_cast<char>(random() & 127U);
            if (round % 3 == 1) mangled.erase(at, random() % 40);
            if (round % 3 == 2) mangled.insert(at, mangled.substr(random() % mangled.size(), random() % 60));
        }
        parts.back().second = mangled;
        attempt(zip_of(parts));
    }
}

}  // namespace volumetric_model_test
