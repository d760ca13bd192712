// Sheets hold every layer once, in a format's own words, and a stopped run goes on to the same bytes.
#include "printers/vector/cut_sheets.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "engine/base/error.h"
#include "printers/registry.h"
#include "printers/vector/laser_strokes.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/toolpath/supported_table.h"

namespace cut_sheets_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

/// A cone of 24 layers with a square hole.
Job cone() {
    return make_job(
        {{-30, -30, 0}, {30, 30, 24}},
        [](double z) {
            return std::vector<Figure>{disc({0, 0}, 30 - z)};
        },
        1,
        [](double) {
            return std::vector<Figure>{rectangle({-2, -2}, {2, 2})};
        });
}

PrinterProfile cutter(const std::string& backend) {
    PrinterProfile profile;
    profile.backend = backend;
    profile.vector.one_file = false;
    profile.vector.margin = 2;
    profile.cutting.laser = Laser::generic;
    profile.cutting.kerf = 0.2;
    profile.cutting.numbers = true;
    profile.cutting.next_outline = true;
    return profile;
}

PrinterProfile nesting(const std::string& backend) {
    PrinterProfile profile = cutter(backend);
    profile.cutting.sheet = {{200, 150}};
    profile.cutting.sheet_margin = 3;
    return profile;
}

struct SvgElement {
    std::string id, stroke, width;
    std::vector<std::vector<dvec2>> lines;
};

std::vector<SvgElement> elements_of(const std::string& text) {
    std::vector<SvgElement> elements;
    const std::regex element(
        "<path id=\"([^\"]*)\" fill=\"none\" stroke=\"([^\"]*)\" stroke-width=\"([^\"]*)\" d=\"([^\"]*)\"/>");
    for (std::sregex_iterator it(text.begin(), text.end(), element), end; it != end; ++it) {
        SvgElement found{(*it)[1], (*it)[2], (*it)[3], {}};
        const std::string data = (*it)[4];
        const std::regex point("([ML])(-?[0-9.]+) (-?[0-9.]+)");
        for (std::sregex_iterator p(data.begin(), data.end(), point); p != end; ++p) {
            if ((*p)[1] == "M") found.lines.emplace_back();
            found.lines.back().push_back({std::stod((*p)[2]), std::stod((*p)[3])});
        }
        elements.push_back(found);
    }
    return elements;
}

Rect box_of_lines(const std::vector<std::vector<dvec2>>& lines) {
    Rect box;
    for (const auto& line : lines) {
        for (const dvec2& p : line) box = unite(box, Rect{p, p});
    }
    return box;
}

std::vector<std::string> files_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

void check_same_folder(const fs::path& a, const fs::path& b) {
    REQUIRE(files_in(a) == files_in(b));
    for (const std::string& file : files_in(a)) {
        INFO(file);
        CHECK(read_text(a / file) == read_text(b / file));
    }
}

}  // namespace

TEST_CASE("a layer's sheet engraves, scores, cuts inside and cuts out, in a laser's colours", "[sheets]") {
    const TemporaryFolder folder;
    PrinterProfile profile = cutter("svg");
    const auto [laser, colours] = GENERATE(table<Laser, std::vector<std::string>>({
        {Laser::none, {"#000000", "#0000ff", "#ff0000", "#ff0000"}},
        {Laser::generic, {"#000000", "#00ff00", "#0000ff", "#ff0000"}},
        {Laser::lightburn, {"#000000", "#00e000", "#0000ff", "#ff0000"}},
        {Laser::trotec, {"#000000", "#00ff00", "#0000ff", "#ff0000"}},
        {Laser::epilog, {"#000000", "#00ff00", "#0000ff", "#ff0000"}},
        {Laser::glowforge, {"#000000", "#0000ff", "#00ff00", "#ff0000"}},
        {Laser::xtool, {"#000000", "#00ff00", "#0000ff", "#ff0000"}},
    }));
    profile.cutting.laser = laser;
    run_layers(cone(), *make_backend(profile, folder / "out", false), {0, 24});
    const std::string text = read_text(folder / "out/00007.svg");
    CHECK(text.find("width=\"64.2mm\" height=\"64.2mm\" viewBox=\"0 0 64.2 64.2\"") != std::string::npos);
    CHECK(text.find("<g id=\"layer0007\" inkscape:groupmode=\"layer\" inkscape:label=\"0007 z=8\">") !=
          std::string::npos);
    const auto elements = elements_of(text);
    REQUIRE(elements.size() == 4);
    const char* names[] = {"engrave", "score", "cut-inner", "cut-outer"};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(elements[i].id == std::string("layer0007-") + names[i]);
        CHECK(elements[i].stroke == colours[i]);
        if (i > 0) CHECK(std::stod(elements[i].width) <= 0.0254);
    }
    const double radius = 30 - 7.5 + 0.1;
    const Rect outline = box_of_lines(elements[3].lines);
    CHECK(outline.size().x == Approx(2 * radius).epsilon(1e-3));
    CHECK(outline.center().x == Approx(32.1).margin(0.02));
    CHECK(outline.center().y == Approx(32.1).margin(0.02));
    CHECK(box_of_lines(elements[2].lines).size().x == Approx(4 - 0.2).margin(0.03));
    CHECK(box_of_lines(elements[1].lines).size().x == Approx(2 * 21.5).epsilon(1e-3));
}

TEST_CASE("nested sheets hold every layer once, apart from each other and within the edges", "[sheets]") {
    const TemporaryFolder folder;
    const PrinterProfile profile = nesting("svg");
    run_layers(cone(), *make_backend(profile, folder / "out", false), {0, 24});
    const auto json = nlohmann::json::parse(read_text(folder / "out/job.json"));
    CHECK(json["files"] == "sheet_%03d.svg");
    const std::size_t sheets = json["sheets"].size();
    CHECK(sheets > 1);
    REQUIRE(files_in(folder / "out").size() == sheets + 1);
    std::set<std::string> layers;
    int next = 0;
    for (std::size_t s = 0; s < sheets; ++s) {
        const auto& entry = json["sheets"][s];
        CHECK(entry["first_layer"] == next);
        next = entry["end_layer"];
        const std::string text = read_text(folder / ("out/" + entry["file"].get<std::string>()));
        CHECK(text.find("width=\"200mm\" height=\"150mm\"") != std::string::npos);
        char label[60];
        std::snprintf(label, sizeof label, "sheet %d: layers %04d to %04d", static_cast<int>(s) + 1,
                      entry["first_layer"].get<int>(), next - 1);
        CHECK(text.find(label) != std::string::npos);
        std::vector<Rect> boxes;
        std::size_t rank = 0;
        const std::vector<std::string> order{"engrave", "score", "cut-inner", "cut-outer"};
        for (const SvgElement& element : elements_of(text)) {
            const std::string purpose = element.id.substr(10);
            const auto place =
                static_cast<std::size_t>(std::find(order.begin(), order.end(), purpose) - order.begin());
            CHECK(place >= rank);
            rank = place;
            if (purpose != "cut-outer") continue;
            const std::string layer = element.id.substr(0, 9);
            CHECK(layers.insert(layer).second);
            const Rect box = box_of_lines(element.lines);
            const double radius = 30 - (std::stoi(layer.substr(5)) + 0.5) + 0.1;
            CHECK(box.size().x == Approx(2 * radius).epsilon(2e-3));
            CHECK(box.lo.x >= 3 - 1e-3);
            CHECK(box.lo.y >= 3 - 1e-3);
            CHECK(box.hi.x <= 197 + 1e-3);
            CHECK(box.hi.y <= 147 + 1e-3);
            for (const Rect& other : boxes) CHECK(intersect(grown(box, 3 - 1e-3), other).empty());
            boxes.push_back(box);
        }
    }
    CHECK(next == 24);
    CHECK(layers.size() == 24);
}

TEST_CASE("a run that was stopped goes on to the same sheets", "[sheets]") {
    const TemporaryFolder folder;
    const Job job = cone();
    const PrinterProfile profile = GENERATE(nesting("svg"), nesting("dxf"), cutter("svg"), cutter("dxf"));
    CAPTURE(profile.backend, profile.cutting.sheet.size());
    run_layers(job, *make_backend(profile, folder / "whole", false), {0, 24});
    const int stop = GENERATE(0, 3, 11, 20, 24);
    CAPTURE(stop);
    {
        const auto backend = make_backend(profile, folder / "parts", false);
        for (int i = backend->open(job, {0, 24}, false); i < stop; ++i) {
            const Layer layer(job, i);
            backend->write(layer, *backend->render(layer));
        }
        CHECK_THROWS_WITH(make_backend(profile, folder / "parts", false)->open(job, {0, 24}, true),
                          Catch::Contains("is being written by another run"));
    }
    CHECK(!fs::exists(folder / "parts"));
    CHECK(make_backend(profile, folder / "parts", false)->open(job, {0, 24}, true) <= stop);
    run_layers(job, *make_backend(profile, folder / "parts", false), {0, 24}, true);
    check_same_folder(folder / "whole", folder / "parts");
}

TEST_CASE("the sheets of two ranges are those of the whole", "[sheets]") {
    const TemporaryFolder folder;
    const Job job = cone();
    const PrinterProfile profile = cutter("svg");
    run_layers(job, *make_backend(profile, folder / "whole", false), {0, 24});
    run_layers(job, *make_backend(profile, folder / "low", false), {0, 9});
    run_layers(job, *make_backend(profile, folder / "high", false), {9, 24});
    // The last of the lower range has scored the first of the upper one.
    for (const std::string file : {"00000.svg", "00008.svg"})
        CHECK(read_text(fs::path(folder / "low") / file) == read_text(fs::path(folder / "whole") / file));
    for (const std::string file : {"00009.svg", "00023.svg"})
        CHECK(read_text(fs::path(folder / "high") / file) == read_text(fs::path(folder / "whole") / file));
}

TEST_CASE("one file holds a group a layer", "[sheets]") {
    const TemporaryFolder folder;
    PrinterProfile profile = cutter("svg");
    profile.vector.one_file = true;
    run_layers(cone(), *make_backend(profile, folder / "out.svg", false), {0, 24});
    const std::string text = read_text(folder / "out.svg");
    std::size_t groups = 0;
    for (std::size_t at = 0; (at = text.find("<g id=", at)) != std::string::npos; ++at) ++groups;
    CHECK(groups == 24);
    std::set<std::string> ids;
    for (const SvgElement& element : elements_of(text)) CHECK(ids.insert(element.id).second);
    run_layers(cone(), *make_backend(profile, folder / "parts.svg", false), {0, 24}, false, 7);
    run_layers(cone(), *make_backend(profile, folder / "parts.svg", false), {0, 24}, true);
    CHECK(read_text(folder / "parts.svg") == text);
}

TEST_CASE("a sheet folder is replaced by force, and only one of ours", "[sheets]") {
    const TemporaryFolder folder;
    const PrinterProfile profile = nesting("svg");
    const auto run = [&](bool force) {
        run_layers(cone(), *make_backend(profile, folder / "out", force), {0, 24});
    };
    run(false);
    CHECK_THROWS_AS(run(false), InputError);
    run(true);
    write_text(folder / "out/sheet_music.svg", "not ours");
    CHECK_THROWS_AS(run(true), InputError);
}

TEST_CASE("a layer that no sheet holds is refused before anything is written", "[sheets]") {
    const TemporaryFolder folder;
    PrinterProfile profile = nesting("svg");
    profile.cutting.sheet = {{65, 150}};
    const auto backend = make_backend(profile, folder / "out", false);
    CHECK_THROWS_WITH(backend->open(cone(), {0, 24}, false),
                      Catch::Contains("layer 0 is 59.2") && Catch::Contains("room for 59 x 144 mm"));
    CHECK(!fs::exists(folder / "out.partial"));
    // Where the layers asked for fit, the part's own size does not matter.
    CHECK_NOTHROW(run_layers(cone(), *make_backend(profile, folder / "upper", false), {4, 24}));
}

TEST_CASE("loose layers are refused, told or tied, as asked", "[sheets]") {
    const TemporaryFolder folder;
    const Job job = make_job(
        {{-20, -20, 0}, {20, 20, 6}},
        [](double z) {
            return z < 4 ? std::vector<Figure>{disc({0, 0}, 15)}
                         : std::vector<Figure>{disc({-9, 0}, 4), disc({9, 0}, 4), disc({0, 9}, 2)};
        },
        1);
    PrinterProfile profile;
    profile.backend = "svg";
    profile.vector.one_file = false;
    profile.cutting.laser = Laser::generic;
    auto backend = make_backend(profile, folder / "none", false);
    run_layers(job, *backend, {0, 6});
    REQUIRE(backend->notes().size() == 1);
    CHECK_THAT(backend->notes()[0],
               Catch::Contains("in 2 layers, first in layer 4") && Catch::Contains("falls into 3"));
    profile.cutting.ties = Ties::join;
    backend = make_backend(profile, folder / "join", false);
    run_layers(job, *backend, {0, 6});
    CHECK(backend->notes().empty());
    profile.cutting.ties = Ties::refuse;
    CHECK_THROWS_AS(run_layers(job, *make_backend(profile, folder / "refuse", false), {0, 6}),
                    ConstraintError);
    CHECK_THROWS_WITH(run_layers(job, *make_backend(profile, folder / "again", false), {0, 6}),
                      Catch::Contains("layer 4 falls into 3 loose pieces"));
}

TEST_CASE("senseless cutting settings and supports are refused", "[sheets]") {
    const TemporaryFolder folder;
    const auto refused = [&](auto change) {
        PrinterProfile profile = cutter("svg");
        change(profile);
        CHECK_THROWS_AS(make_backend(profile, folder / "x", false)->open(cone(), {0, 24}, false), InputError);
    };
    refused([](PrinterProfile& p) { p.cutting.kerf = -1; });
    refused([](PrinterProfile& p) { p.cutting.kerf = std::nan(""); });
    refused([](PrinterProfile& p) { p.cutting.tie_width = 0; });
    refused([](PrinterProfile& p) { p.cutting.sheet = {{100}}; });
    refused([](PrinterProfile& p) {
        p.cutting.sheet = {{100, 200}};
        p.cutting.sheet_margin = 50;
    });
    refused([](PrinterProfile& p) { p.cutting.sheet = {{100, infinity}}; });
    refused([](PrinterProfile& p) { p.vector.tolerance = 0; });
    refused([](PrinterProfile& p) { p.cutting.dialect = SvgDialect::slic3r; });
    CHECK_THROWS_WITH(
        make_backend(cutter("svg"), folder / "x", false)->open(supported_table(), {0, 20}, false),
        Catch::Contains("supports are not cut"));
}

TEST_CASE("DXF says the same lines as SVG, y upwards", "[sheets][dxf]") {
    const TemporaryFolder folder;
    PrinterProfile profile = cutter("svg");
    run_layers(cone(), *make_backend(profile, folder / "svg", false), {0, 24});
    profile.backend = "dxf";
    run_layers(cone(), *make_backend(profile, folder / "dxf", false), {0, 24});
    std::ifstream in(folder / "dxf/00003.dxf");
    std::string code, value, entity, layer, variable;
    struct Polyline {
        std::string layer;
        bool closed = false;
        std::vector<dvec2> points;
    };
    std::vector<Polyline> lines;
    bool units = false, release = false, ended = false;
    while (std::getline(in, code) && std::getline(in, value)) {
        REQUIRE(code.find_first_not_of("0123456789") == std::string::npos);
        const int group = std::stoi(code);
        if (group == 0) {
            entity = value;
            ended = value == "EOF";
            if (entity == "POLYLINE") lines.emplace_back();
            if (entity == "VERTEX") lines.back().points.emplace_back(0, 0);
        }
        if (group == 9) variable = value;
        units = units || (variable == "$INSUNITS" && group == 70 && value == "4");
        release = release || (variable == "$ACADVER" && value == "AC1009");
        if (entity == "POLYLINE" && group == 8) lines.back().layer = value;
        if (entity == "POLYLINE" && group == 70) lines.back().closed = value == "1";
        if (entity == "VERTEX" && group == 10) lines.back().points.back().x = std::stod(value);
        if (entity == "VERTEX" && group == 20) lines.back().points.back().y = std::stod(value);
    }
    CHECK(units);
    CHECK(release);
    CHECK(ended);
    std::size_t i = 0;
    const std::vector<std::string> layers{"ENGRAVE", "SCORE", "CUT_INNER", "CUT_OUTER"};
    const auto elements = elements_of(read_text(folder / "svg/00003.svg"));
    REQUIRE(elements.size() == 4);
    for (std::size_t e = 0; e < 4; ++e) {
        for (const auto& line : elements[e].lines) {
            REQUIRE(i < lines.size());
            CHECK(lines[i].layer == layers[e]);
            CHECK(lines[i].closed == (e > 0));
            REQUIRE(lines[i].points.size() == line.size());
            for (std::size_t p = 0; p < line.size(); ++p) {
                CHECK(lines[i].points[p].x == Approx(line[p].x).margin(1e-9));
                CHECK(lines[i].points[p].y == Approx(64.2 - line[p].y).margin(1.01e-4));
            }
            ++i;
        }
    }
    CHECK(i == lines.size());
}

TEST_CASE("Slic3r's dialect is a stack of white contours and black holes", "[sheets][slic3r]") {
    const TemporaryFolder folder;
    PrinterProfile profile;
    profile.backend = "svg";
    profile.vector.margin = 0;
    profile.cutting.dialect = SvgDialect::slic3r;
    run_layers(cone(), *make_backend(profile, folder / "out.svg", false), {0, 24});
    const std::string text = read_text(folder / "out.svg");
    CHECK(text.find("<svg width=\"60\" height=\"60\" xmlns") != std::string::npos);
    CHECK(text.find("metadata") == std::string::npos);
    const std::regex group(
        "<g id=\"layer([0-9]+)\" slic3r:z=\"([0-9.]+)\">\\s*"
        "<polygon slic3r:type=\"contour\" points=\"([^\"]*)\" style=\"fill: white\" />\\s*"
        "<polygon slic3r:type=\"hole\" points=\"([^\"]*)\" style=\"fill: black\" />\\s*</g>");
    int layers = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), group), end; it != end; ++it, ++layers) {
        CHECK(std::stoi((*it)[1]) == layers);
        CHECK(std::stod((*it)[2]) == Approx(layers + 0.5));
        std::vector<dvec2> points;
        const std::string data = (*it)[3];
        const std::regex point("([0-9.]+),([0-9.]+)");
        double twice = 0;
        for (std::sregex_iterator p(data.begin(), data.end(), point); p != end; ++p)
            points.push_back({std::stod((*p)[1]), std::stod((*p)[2])});
        for (std::size_t i = 0; i < points.size(); ++i) {
            const dvec2 a = points[i], b = points[(i + 1) % points.size()];
            twice += a.x * b.y - b.x * a.y;
        }
        const double radius = 30 - layers - 0.5;
        CHECK(twice / 2 == Approx(pi * radius * radius).epsilon(0.01));  // counter-clockwise: y is not turned
    }
    CHECK(layers == 24);
    run_layers(cone(), *make_backend(profile, folder / "parts.svg", false), {0, 24}, false, 5);
    run_layers(cone(), *make_backend(profile, folder / "parts.svg", false), {0, 24}, true);
    CHECK(read_text(folder / "parts.svg") == text);
}

}  // namespace cut_sheets_test
