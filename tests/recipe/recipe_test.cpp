// What a recipe may say, and what it is told when it says something else.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <sstream>

#include "engine/base/error.h"
#include "procedural/lattice/tpms.h"
#include "recipe/identity.h"
#include "recipe/recipe_draft.h"
#include "recipe/settings.h"
#include "tests/recipe/another_value.h"

namespace recipe_test {

using namespace lamella;

namespace {

Recipe read(const std::string& text) {
    RecipeDraft draft;
    draft.read_text(text, "folder/test.toml");
    return draft.finish();
}

/// The lines of the complaint about a recipe.
std::vector<std::string> complaints(const std::string& text) {
    std::vector<std::string> lines;
    try {
        read(text);
    } catch (const InputError& error) {
        std::istringstream stream(error.what());
        for (std::string line; std::getline(stream, line);) lines.push_back(line);
    }
    return lines;
}

/// The one complaint about a recipe.
std::string complaint(const std::string& text) {
    const auto lines = complaints(text);
    INFO(text);
    for (const auto& line : lines) UNSCOPED_INFO(line);
    REQUIRE(lines.size() == 1);
    return lines.front();
}

bool mentions(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string message(RecipeDraft& draft) {
    try {
        draft.finish();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

const std::string sphere = "[part]\nshape = \"sphere\"\nradius = 10\n";

std::string toml_text(const Setting& setting, const Value& value) {
    const std::string text = format_value(value);
    if (setting.type == ValueType::triple) return "[" + text + "]";
    if (setting.type == ValueType::graded_triple) {
        std::string parts;
        for (const GradedNumber& part : std::get<GradedTriple>(value)) {
            const std::string quote = part.is_formula() ? "\"" : "";
            parts += (parts.empty() ? "" : ", ") + quote + format_value(part) + quote;
        }
        return "[" + parts + "]";
    }
    if (setting.type == ValueType::rows) {
        std::string rows;
        for (const auto& row : std::get<NumberRows>(value)) {
            std::string numbers;
            for (const double v : row) numbers += (numbers.empty() ? "" : ", ") + format_value(v);
            rows += (rows.empty() ? "[" : ", [") + numbers + "]";
        }
        return "[" + rows + "]";
    }
    const bool plain = setting.type == ValueType::boolean || setting.type == ValueType::integer ||
                       setting.type == ValueType::number;
    if (setting.type == ValueType::lines) return "\"\"\"\n" + text + "\n\"\"\"";
    return plain ? text : "\"" + text + "\"";
}

}  // namespace

TEST_CASE("a recipe's values arrive in the recipe") {
    const Recipe recipe = read(
        "[part]\nshape = \"torus\"\nradius = 10\ntube = 2.5\nscale = 2\nname = \"ring\"\n"
        "[foam]\ncell = 3\nbeam = 0.4\nseed = 9223372036854775807\n"
        "[skin]\nthickness = 0.8\n[layers]\nheight = 0.1\n"
        "[printer]\nkind = \"svg\"\npixel = 0.04\nmirror_x = true\nantialiasing = \"exact\"\nsub_rows = 8\n"
        "tolerance = 0.01\n");
    CHECK(recipe.part.shape == Shape::torus);
    CHECK(recipe.part.radius == 10);
    CHECK(recipe.part.tube == 2.5);
    CHECK(recipe.part.scale == 2);
    CHECK(recipe.part.name == "ring");
    REQUIRE(recipe.foam);
    CHECK(recipe.foam->cell.number() == 3);
    CHECK(recipe.foam->beam.number() == 0.4);
    CHECK(recipe.foam->seed == 9223372036854775807);
    REQUIRE(recipe.skin);
    CHECK(recipe.skin->thickness.number() == 0.8);
    CHECK(recipe.layers.height == 0.1);
    CHECK(recipe.printer.backend == "svg");
    CHECK(recipe.printer.image.pixel_x == 0.04);
    CHECK(recipe.printer.image.pixel_y == 0.04);
    CHECK(recipe.printer.image.mirror_x);
    CHECK(recipe.printer.image.antialiasing == Antialiasing::exact);
    CHECK(recipe.printer.image.sub_rows == 8);
    CHECK(recipe.printer.vector.tolerance == 0.01);
    CHECK(recipe.printer.filament.tolerance == 0.01);
}

TEST_CASE("what a recipe leaves out has its default") {
    const Recipe recipe = read(sphere);
    CHECK_FALSE(recipe.foam);
    CHECK_FALSE(recipe.skin);
    CHECK(recipe.layers.height == 0.05);
    CHECK(recipe.part.scale == 1);
    CHECK(recipe.part.name == "sphere");
    CHECK(recipe.printer.image.sub_rows == PrinterProfile{}.image.sub_rows);
    CHECK(read(sphere + "[foam]\ncell = 3\nbeam = 0.2\n").foam->seed == 1);
    CHECK_FALSE(read(sphere + "[skin]\nthickness = 0\n").skin);
}

TEST_CASE("a mesh path in a recipe starts at the recipe's folder, and names the part") {
    const Recipe recipe = read("[part]\nmesh = \"models/../heel.stl\"\n");
    CHECK(recipe.part.mesh == "folder/heel.stl");
    CHECK(recipe.part.name == "heel");
    CHECK(read("[part]\nmesh = \"/srv/heel.stl\"\n").part.mesh == "/srv/heel.stl");
}

TEST_CASE("every row of the table has a flag of its own, a key of its own and a help sentence") {
    std::set<std::string> flags;
    std::set<std::string> names;
    for (const Setting& setting : settings()) {
        INFO(setting.name());
        CHECK(names.insert(setting.name()).second);
        CHECK(setting.flag.empty() == find_section(setting.section)->is_list());
        CHECK((setting.flag.empty() || flags.insert(setting.flag).second));
        CHECK((setting.flag.empty() || setting.flag.starts_with("--")));
        CHECK(setting.help.ends_with("."));
        CHECK_FALSE(setting.fallback.empty());
        CHECK((setting.type == ValueType::choice) == !setting.choices.empty());
        CHECK(find_setting(setting.section, setting.key) == &setting);
        CHECK(mentions(settings_reference(), setting.flag));
    }
}

TEST_CASE("a flag and its recipe key set the same value") {
    for (const Setting& setting : settings()) {
        // The profile's name is looked up, not stored; the command's tests cover it.
        if (setting.name() == "printer.profile") continue;
        INFO(setting.name());
        const Value value = another_value(setting);
        std::string wrong;
        const auto parsed = parse_value(setting, format_value(value), wrong);
        REQUIRE(parsed);
        CHECK(*parsed == value);

        // Each key alone may break rules that join keys; its value must arrive all the same.
        Recipe stored;
        setting.store(stored, 0, value);
        CHECK(setting.load(stored, 0) == value);
        CHECK(setting.load(Recipe{}, 0) != value);

        RecipeDraft from_file;
        RecipeDraft from_flag;
        const std::string text =
            find_section(setting.section)->title() + "\n" + setting.key + " = " + toml_text(setting, value);
        from_file.read_text(text, "test.toml");
        bool wrong_in_file = false;
        std::istringstream lines(message(from_file));
        for (std::string line; std::getline(lines, line);) {
            wrong_in_file = wrong_in_file || (line.starts_with("test.toml:2: " + setting.name() + ":") &&
                                              line.ends_with("accepted: " + accepted(setting)));
        }
        CHECK_FALSE(wrong_in_file);
        if (setting.flag.empty()) continue;
        from_flag.assign_flag(setting, format_value(value));
        CHECK_FALSE(mentions(message(from_flag), setting.flag + ": \""));
    }
}

TEST_CASE("a flag overrides the recipe's key") {
    RecipeDraft draft;
    draft.read_text(sphere + "[layers]\nheight = 0.1\n[printer]\npixel_x = 0.03\n", "test.toml");
    draft.assign_flag(*find_setting("layers", "height"), "0.025");
    draft.assign_flag(*find_setting("printer", "pixel"), "0.07");
    const Recipe recipe = draft.finish();
    CHECK(recipe.layers.height == 0.025);
    CHECK(recipe.printer.image.pixel_x == 0.07);
}

TEST_CASE("a body given by a flag takes the place of the recipe's") {
    RecipeDraft mesh_over_shape;
    mesh_over_shape.read_text(sphere, "test.toml");
    mesh_over_shape.assign_flag(*find_setting("part", "mesh"), "a.stl");
    CHECK(mesh_over_shape.finish().part.shape == Shape::none);
    RecipeDraft shape_over_mesh;
    shape_over_mesh.read_text("[part]\nmesh = \"a.stl\"\n", "test.toml");
    shape_over_mesh.assign_flag(*find_setting("part", "shape"), "sphere");
    shape_over_mesh.assign_flag(*find_setting("part", "radius"), "3");
    CHECK(shape_over_mesh.finish().part.mesh.empty());
}

TEST_CASE("a wrong value is told with file, line, key and what is accepted") {
    CHECK(complaint(sphere + "[layers]\nheight = -0.1\n") ==
          "folder/test.toml:5: layers.height: -0.1 is too small; accepted: a number from 0.001 to 10 mm");
    CHECK(complaint(sphere + "[layers]\nheight = \"thin\"\n") ==
          "folder/test.toml:5: layers.height: a text was found; accepted: a number from 0.001 to 10 mm");
    CHECK(complaint(sphere + "[printer]\n\n\nsub_rows = 2.5\n") ==
          "folder/test.toml:7: printer.sub_rows: a number with a fraction was found; accepted: a whole "
          "number from 1 to 64");
    CHECK(complaint(sphere + "[printer]\nmirror_x = 1\n") ==
          "folder/test.toml:5: printer.mirror_x: a whole number was found; accepted: true or false");
}

TEST_CASE("numbers that are none are refused") {
    for (const std::string bad : {"inf", "-inf", "nan", "1e400"}) {
        CAPTURE(bad);
        const auto lines = complaints(sphere + "[layers]\nheight = " + bad + "\n");
        REQUIRE(lines.size() == 1);
        CHECK(mentions(lines[0], "folder/test.toml:5:"));
    }
    CHECK(mentions(complaint("[part]\nshape = \"box\"\nsize = [1, nan, 3]\n"),
                   "test.toml:3: part.size: nan is not"));
    for (const std::string bad : {"inf", "nan", "", "1,5", "0x10", "1mm", " 1", "--1"}) {
        CAPTURE(bad);
        std::string wrong;
        CHECK_FALSE(parse_value(*find_setting("layers", "height"), bad, wrong));
        CHECK_FALSE(wrong.empty());
    }
}

TEST_CASE("a triple is exactly three numbers") {
    const Setting& size = *find_setting("part", "size");
    std::string wrong;
    CHECK(*parse_value(size, "1,2.5,3", wrong) == Value(dvec3(1, 2.5, 3)));
    for (const std::string bad : {"1,2", "1,2,3,4", "1,,3", "1,2,", "1;2;3", ""}) {
        CAPTURE(bad);
        CHECK_FALSE(parse_value(size, bad, wrong));
    }
    CHECK(mentions(complaint("[part]\nshape = \"box\"\nsize = [1, 2]\n"),
                   "test.toml:3: part.size: an array of 2 was found"));
    CHECK(mentions(complaint("[part]\nshape = \"box\"\nsize = 4\n"), "three numbers"));
}

TEST_CASE("unknown keys and sections are refused, with the near one named") {
    const std::string key = complaint(sphere + "[skin]\nthicknes = 1\n");
    CHECK(mentions(key, "folder/test.toml:5: skin.thicknes: unknown key, did you mean `thickness`?"));
    CHECK(mentions(complaint(sphere + "[fom]\ncell = 1\n"),
                   "test.toml:4: [fom]: unknown section, did you mean `[foam]`?"));
    CHECK(mentions(complaint(sphere + "[layers]\nbeam = 1\n"), "`beam` belongs to [foam]"));
    CHECK(mentions(complaint(sphere + "[printer]\nlayer_height = 0.1\n"),
                   "printer.layer_height: unknown key, it is `height` of [layers]"));
    CHECK(mentions(complaint("cell = 3\n" + sphere),
                   "test.toml:1: cell: stands outside a section, `cell` belongs to [foam]"));
    CHECK(mentions(complaint(sphere + "[printer]\nantialiasing = \"row\"\n"), "did you mean `rows`?"));
    // The nearest key does not apply to this kind of foam, which is no second mistake.
    CHECK(complaints(sphere + "[foam]\ncell = 3\nbeam = 0.3\nwal = 1\n").size() == 1);
    CHECK(mentions(complaint("foam = 3\n" + sphere), "test.toml:1: foam: a whole number was found"));
    CHECK(mentions(complaint("[[foam]]\ncell = 3\n" + sphere), "foam: an array of 1 was found"));
}

TEST_CASE("keys that belong together must stand together") {
    CHECK(complaint(sphere + "[foam]\ncell = 3\n") ==
          "folder/test.toml:4: foam.beam: missing, required by kind voronoi; accepted: a number from 0.005 "
          "to 500 mm or a formula");
    CHECK(mentions(complaint(sphere + "[skin]\n"), "test.toml:4: skin.thickness: missing"));
    CHECK(mentions(complaint("[part]\nshape = \"sphere\"\n"),
                   "test.toml:1: part.radius: missing, required by shape sphere"));
    CHECK(mentions(complaint("[layers]\nheight = 0.1\n"), "no body is given"));
    CHECK(mentions(complaint(""), "no body is given"));
}

TEST_CASE("contradictions are refused") {
    CHECK(complaint("[part]\nmesh = \"a.stl\"\nshape = \"sphere\"\n") ==
          "folder/test.toml:3: part.shape: conflicts with folder/test.toml:2: part.mesh; accepted: only one "
          "of a mesh, a shape and a field");
    CHECK(mentions(complaint("[part]\nmesh = \"a.stl\"\nradius = 3\n"),
                   "test.toml:3: part.radius: applies only to a shape"));
    CHECK(mentions(complaint(sphere + "tube = 2\n"),
                   "test.toml:4: part.tube: does not apply to shape sphere; accepted: radius"));
    CHECK(mentions(complaint(sphere + "[printer]\npixel = 0.05\npixel_x = 0.04\n"),
                   "test.toml:6: printer.pixel_x: conflicts with"));
    CHECK(mentions(complaint(sphere + "[foam]\ncell = 1\nbeam = 0.5\n"),
                   "test.toml:6: foam.beam: 0.5 mm fills cells of 1 mm"));
    CHECK(mentions(complaint("[part]\nshape = \"torus\"\nradius = 2\ntube = 2\n"), "closes the hole"));
    CHECK(mentions(complaint("[part]\nshape = \"capsule\"\nradius = 2\nheight = 3\n"),
                   "test.toml:4: part.height: 3 mm is too short"));
    CHECK(mentions(complaint(sphere + "name = \"../up\"\n"), "test.toml:4: part.name"));
}

TEST_CASE("a gyroid may be as thick as leaves something open") {
    const std::string gyroid = "[part]\nshape = \"gyroid\"\nsize = [20, 20, 20]\nperiod = 5\nthickness = ";
    const double most = 5 * greatest_tpms_thickness(TpmsKind::gyroid, false);
    CHECK(complaints(gyroid + std::to_string(0.99 * most) + "\n").empty());
    const std::string wrong = complaint(gyroid + std::to_string(1.01 * most) + "\n");
    CHECK(mentions(wrong, "test.toml:5: part.thickness: "));
    CHECK(mentions(wrong, "fills a gyroid of period 5 mm; accepted: less than "));
}

TEST_CASE("all mistakes of a file are told at once, in the order of its lines") {
    const auto lines = complaints(
        "[part]\nshape = \"spere\"\nradius = 1e9\n[skin]\nthickness = true\n[layer]\nheight = 1\n"
        "[printer]\nwidth = 0\nnozzel = 0.4\n");
    REQUIRE(lines.size() == 6);
    const std::vector<std::string> starts{"2: part.shape: \"spere\" is unknown, did you mean `sphere`?",
                                          "3: part.radius: 1000000000 is too large",
                                          "5: skin.thickness: true or false was found",
                                          "6: [layer]: unknown section, did you mean `[layers]`?",
                                          "9: printer.width: 0 is too small",
                                          "10: printer.nozzel: unknown key, did you mean `nozzle`?"};
    for (std::size_t i = 0; i < starts.size(); ++i) {
        CAPTURE(lines[i]);
        CHECK(lines[i].starts_with("folder/test.toml:" + starts[i]));
    }
}

TEST_CASE("a syntax error is told with line and column") {
    const std::string text = complaint("[part]\nshape = \"sphere\nradius = 10\n");
    CHECK(mentions(text, "folder/test.toml:2:"));
    CHECK(mentions(text, "not valid TOML"));
    CHECK(mentions(complaint(sphere + "radius = 11\n"), "folder/test.toml:4:"));
    CHECK(complaints("[part]\nname = \"\xff\xfe\"\n").size() == 1);
}

TEST_CASE("hostile recipes end in a message") {
    CHECK_FALSE(complaints("a = " + std::string(100000, '[')).empty());
    CHECK_FALSE(complaints(std::string(1000, '\0')).empty());
    CHECK_FALSE(complaints("[part]\nmesh = \"" + std::string(5000, 'x') + "\"\n").empty());
    CHECK_FALSE(complaints("[part]\n\"" + std::string(100000, 'k') + "\" = 1\n").empty());
    CHECK_FALSE(complaints("[part]\nmesh = \"a\\u0007.stl\"\n").empty());
}

TEST_CASE("wrong flags are told by their names, all at once") {
    RecipeDraft draft;
    draft.assign_flag(*find_setting("foam", "cell"), "three");
    draft.assign_flag(*find_setting("foam", "seed"), "-1");
    const std::string text = message(draft);
    CHECK(mentions(text, "--cell: "));
    CHECK(mentions(text, "--seed: -1 is too small"));
    CHECK(mentions(text, "--beam: missing, required by kind voronoi"));
    CHECK(mentions(text, "no body is given"));
}

TEST_CASE("FNV-1a with 128 bits agrees with its published values") {
    CHECK(Fnv128().hex() == "6c62272e07bb014262b821756295c58d");
    Fnv128 a;
    a.add("a");
    CHECK(a.hex() == "d228cb696f1a8caf78912b704e4a8964");
    Fnv128 foobar;
    foobar.add("foo");
    foobar.add("bar");
    CHECK(foobar.hex() == "343e1662793c64bf6f0d3597ba446f18");
}

TEST_CASE("every setting that holds decides the identity") {
    const Recipe plain = read(
        "[[field]]\nname = \"f\"\nformula = \"x\"\n[[grading]]\nname = \"g\"\nkind = \"constant\"\nvalue = "
        "1\n" +
        sphere + "[foam]\ncell = 3\nbeam = 0.2\n[skin]\nthickness = 1\n");
    CHECK(job_identity(plain) == job_identity(plain));
    for (const Setting& setting : settings()) {
        if (setting.type == ValueType::path) continue;  // counts by its bytes; the command's tests cover it
        INFO(setting.name());
        Recipe changed = plain;
        const Value value = another_value(setting);
        if (setting.load(changed, 0) == value) continue;
        setting.store(changed, 0, value);
        const bool decides = find_section(setting.section)->decides_layers;
        CHECK((job_identity(changed) != job_identity(plain)) == decides);
    }
}

TEST_CASE("scripts are lists of lines or texts of several lines") {
    const std::string printer = sphere + "[printer]\nkind = \"gcode\"\n";
    const std::string listed = printer + "start_script = [\"G28\", \"M117 {layers}\"]\n";
    CHECK(read(listed).printer.gcode.start_script == "G28\nM117 {layers}");
    const std::string whole = printer + "start_script = \"\"\"\nG28\r\nM117 {layers}\n\"\"\"\n";
    CHECK(read(whole).printer.gcode.start_script == "G28\nM117 {layers}");
    CHECK(job_identity(read(whole)) == job_identity(read(listed)));

    CHECK_THAT(complaint(printer + "end_script = [\"M84\", 5]\n"),
               Catch::StartsWith("folder/test.toml:6: printer.end_script: an array of 2 was found") &&
                   Catch::Contains("a list of lines"));
    CHECK_THAT(complaint(printer + "end_script = []\n"), Catch::Contains("it has no line"));
    CHECK_THAT(complaint(printer + "end_script = [\"M84\", \"M117 \u00e9\"]\n"),
               Catch::StartsWith("folder/test.toml:6: printer.end_script: line 2 holds a character"));
    CHECK_THAT(complaint(printer + "layer_script = [\"M400\", \"\", \"M117 {Layer}\"]\n"),
               Catch::StartsWith("folder/test.toml:6: printer.layer_script: line 3: there is no variable"));
    const std::string wide = "layer_script = \"M117 " + std::string(80, 'x') + "\"\n";
    CHECK(read(printer + wide).printer.gcode.layer_script.size() == 85);
    CHECK_THAT(complaint(printer + "flavour = \"grbl\"\n" + wide),
               Catch::StartsWith("folder/test.toml:7: printer.layer_script: line 1: it has up to 85 bytes"));
}

}  // namespace recipe_test
