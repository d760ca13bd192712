// SVG output has true millimetres, the right areas, and nothing that cutters stumble over.
#include "printers/vector/svg.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/toolpath/supported_table.h"

namespace svg_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

/// Path data back to rings; anything but M, L, Z and plain numbers fails.
std::vector<std::vector<dvec2>> parse_path(const std::string& data) {
    std::vector<std::vector<dvec2>> rings;
    const char* at = data.c_str();
    bool open = false;
    while (*at != 0) {
        const char command = *at++;
        if (command == '\n') continue;
        if (command == 'Z') {
            REQUIRE(open);
            open = false;
            continue;
        }
        REQUIRE((command == 'M' || command == 'L'));
        REQUIRE(open == (command == 'L'));
        if (command == 'M') rings.emplace_back();
        open = true;
        char* end = nullptr;
        const double x = std::strtod(at, &end);
        REQUIRE(*end == ' ');
        const double y = std::strtod(end + 1, &end);
        REQUIRE(std::string(at, static_cast<const char*>(end)).find_first_not_of("0123456789. -") ==
                std::string::npos);
        at = end;
        rings.back().push_back({x, y});
    }
    REQUIRE(!open);
    return rings;
}

double ring_area(const std::vector<dvec2>& ring) {
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i];
        const dvec2 b = ring[(i + 1) % ring.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return twice / 2;
}

struct SvgLayer {
    std::string id;
    double z = 0;
    std::vector<std::vector<dvec2>> rings;
    /// y runs down, so outer rings come out negative.
    double area() const {
        double sum = 0;
        for (const auto& ring : rings) sum -= ring_area(ring);
        return sum;
    }
};

std::vector<SvgLayer> parse_layers(const std::string& text) {
    std::vector<SvgLayer> layers;
    std::size_t at = 0;
    while ((at = text.find("<g ", at)) != std::string::npos) {
        const std::size_t head = text.find('>', at);
        const std::size_t end = text.find("</g>", head);
        const std::string start = text.substr(at, head - at);
        SvgLayer layer;
        layer.id = start.substr(start.find("id=\"") + 4, 9);
        layer.z = std::stod(start.substr(start.find("slic3r:z=\"") + 10));
        const std::size_t data = text.find(" d=\"", head);
        if (data < end) layer.rings = parse_path(text.substr(data + 4, text.find('"', data + 4) - data - 4));
        layers.push_back(layer);
        at = end;
    }
    return layers;
}

/// A disc with a square hole, shrinking upwards, and gone at the top.
Job rings() {
    const Box bounds{{-5, 5, 2}, {5, 15, 7}};
    return make_job(
        bounds,
        [](double z) {
            return z > 6.5 ? std::vector<Figure>() : std::vector<Figure>{disc({0, 10}, 5.5 - z / 4)};
        },
        0.5,
        [](double) {
            return std::vector<Figure>{rectangle({-1, 9}, {1, 11})};
        });
}

double ring_layer_area(const Job& job, int i) {
    const double radius = 5.5 - job.plane(i) / 4;
    return job.plane(i) > 6.5 ? 0 : pi * radius * radius - 4;
}

PrinterProfile vector_printer(bool one_file) {
    PrinterProfile profile;
    profile.vector.one_file = one_file;
    profile.vector.margin = 2;
    return profile;
}

}  // namespace

TEST_CASE("one SVG holds every layer with its height and area", "[svg]") {
    const TemporaryFolder folder;
    const Job job = rings();
    const double volume =
        run_layers(job, *make_svg(vector_printer(true), folder / "out.svg", false), {0, 10});
    const std::string text = read_text(folder / "out.svg");
    CHECK(text.find("width=\"14mm\" height=\"14mm\" viewBox=\"0 0 14 14\"") != std::string::npos);
    for (const char* unwanted : {"<text", "<metadata", "transform", "-0 ", "e-"}) {
        CHECK(text.find(unwanted) == std::string::npos);
    }
    const std::vector<SvgLayer> layers = parse_layers(text);
    REQUIRE(layers.size() == 10);
    double sum = 0;
    for (int i = 0; i < 10; ++i) {
        const SvgLayer& layer = layers[static_cast<std::size_t>(i)];
        CHECK(layer.id == "layer000" + std::to_string(i));
        CHECK(layer.z == Approx((i + 1) * 0.5));
        CHECK(layer.area() == Approx(ring_layer_area(job, i)).epsilon(0.005).margin(1e-9));
        CHECK(layer.rings.size() == (i < 9 ? 2U : 0U));
        sum += layer.area() * 0.5;
    }
    CHECK(volume == Approx(sum).epsilon(1e-5));
}

TEST_CASE("the drawing is the part seen from above, holes first", "[svg]") {
    const TemporaryFolder folder;
    const Box bounds{{10, 20, 0}, {18, 24, 1}};
    const Job job = make_job(
        bounds,
        [](double) {
            return std::vector<Figure>{rectangle({10, 20}, {18, 21}), rectangle({10, 20}, {11, 24})};
        },
        0.5,
        [](double) {
            return std::vector<Figure>{rectangle({16, 20.25}, {17, 20.75})};
        });
    run_layers(job, *make_svg(vector_printer(false), folder / "out", false), {0, 2});
    const std::string text = read_text(folder / "out/00001.svg");
    CHECK(text.find("stroke=\"#ff0000\" stroke-width=\"0.01\"") != std::string::npos);
    CHECK(text.find("fill=\"none\"") != std::string::npos);
    const auto layers = parse_layers(text);
    REQUIRE(layers.size() == 1);
    REQUIRE(layers[0].rings.size() == 2);
    CHECK(ring_area(layers[0].rings[0]) == Approx(0.5).epsilon(0.1));   // the hole
    CHECK(ring_area(layers[0].rings[1]) == Approx(-11).epsilon(0.01));  // the outline
    // The corners of the outline in page coordinates: the long leg lies at the bottom, the short one left.
    Rect box;
    for (const dvec2 p : layers[0].rings[1]) box = unite(box, Rect{p, p});
    CHECK(box.lo.x == Approx(2).margin(0.03));
    CHECK(box.hi.x == Approx(10).margin(0.03));
    CHECK(box.lo.y == Approx(2).margin(0.03));
    CHECK(box.hi.y == Approx(6).margin(0.03));
    for (const dvec2 p : layers[0].rings[1]) CHECK((p.x < 3.05 || p.y > 4.95));
    const auto json = nlohmann::json::parse(read_text(folder / "out/job.json"));
    CHECK(json["files"] == "%05d.svg");
    CHECK(json["placement"]["left"] == 8);
    CHECK(json["placement"]["top"] == 26);
}

TEST_CASE("an SVG that was stopped is continued byte for byte", "[svg]") {
    const TemporaryFolder folder;
    const Job job = rings();
    run_layers(job, *make_svg(vector_printer(true), folder / "whole.svg", false), {0, 10});
    const int stop = GENERATE(0, 1, 4, 9);
    CAPTURE(stop);
    run_layers(job, *make_svg(vector_printer(true), folder / "parts.svg", false), {0, 10}, false, stop);
    CHECK(!fs::exists(folder / "parts.svg"));
    {
        // The run was killed while it wrote the next layer, and while it noted it down.
        std::ofstream(folder / "parts.svg.partial", std::ios::app) << "<g id=\"layer00";
        std::ofstream(folder / "parts.svg.partial.journal", std::ios::app) << "{\"next\":";
    }
    CHECK(make_svg(vector_printer(true), folder / "parts.svg", false)->open(job, {0, 10}, true) == stop);
    // Continuing can itself be stopped at once.
    run_layers(job, *make_svg(vector_printer(true), folder / "parts.svg", false), {0, 10}, true);
    CHECK(read_text(folder / "parts.svg") == read_text(folder / "whole.svg"));
    CHECK(!fs::exists(folder / "parts.svg.partial"));
    CHECK(!fs::exists(folder / "parts.svg.partial.journal"));
}

TEST_CASE("senseless vector settings are refused", "[svg]") {
    const TemporaryFolder folder;
    PrinterProfile profile = vector_printer(true);
    profile.vector.tolerance = 0;
    CHECK_THROWS_AS(make_svg(profile, folder / "a.svg", false)->open(rings(), {0, 10}, false), InputError);
    profile = vector_printer(true);
    profile.vector.margin = -1;
    CHECK_THROWS_AS(make_svg(profile, folder / "a.svg", false)->open(rings(), {0, 10}, false), InputError);
    CHECK_THROWS_AS(make_svg(vector_printer(true), folder / "", false), InputError);
}

TEST_CASE("supports are a path of their own colour", "[svg]") {
    const TemporaryFolder folder;
    const Job job = supported_table();
    const auto backend = make_svg(vector_printer(true), folder / "out.svg", false);
    CHECK(run_layers(job, *backend, {0, 20}) == Approx(table_area).epsilon(1e-3));
    const std::string text = read_text(folder / "out.svg");
    std::size_t at = 0;
    for (int i = 0; i < 20; ++i) {
        CAPTURE(i);
        at = text.find("<g ", at + 1);
        REQUIRE(at != std::string::npos);
        const std::string layer = text.substr(at, text.find("</g>", at) - at);
        const std::size_t supports = layer.find("<path class=\"support\" fill=\"#0080ff\" stroke=\"none\"");
        CHECK((supports != std::string::npos) == (i < 15));
        CHECK((layer.find("<path fill=\"#000000\"") != std::string::npos) == (i >= 15));
        if (supports == std::string::npos) continue;
        const std::size_t data = layer.find(" d=\"", supports) + 4;
        double area = 0;
        for (const auto& ring : parse_path(layer.substr(data, layer.find('"', data) - data)))
            area -= ring_area(ring);
        CHECK(area == Approx(scaffold_area(job.plane(i))).epsilon(0.02));
    }
    run_layers(job, *make_svg(vector_printer(false), folder / "cut", false), {0, 20});
    const std::string cut = read_text(folder / "cut/00007.svg");
    CHECK(cut.find("class=\"support\" fill=\"none\" stroke=\"#0000ff\" stroke-width=\"0.01\"") !=
          std::string::npos);
    CHECK(cut.find("#ff0000") == std::string::npos);
    // Where part and supports share a layer, the part comes first.
    run_layers(block_beside_support(), *make_svg(vector_printer(false), folder / "both", false), {0, 4});
    const std::string both = read_text(folder / "both/00001.svg");
    CHECK(both.find("#ff0000") < both.find("#0000ff"));
    CHECK(both.find("#0000ff") != std::string::npos);
}

TEST_CASE("the areas of part and supports are told apart", "[svg]") {
    const TemporaryFolder folder;
    const Job job = block_beside_support();
    const auto backend = make_svg(vector_printer(true), folder / "out.svg", false);
    backend->open(job, {0, 4}, false);
    const auto product = backend->render(Layer(job, 1));
    CHECK(product->area == Approx(4.03 * 6).epsilon(1e-3));
    CHECK(product->support_area == Approx(3 * 2).epsilon(5e-3));
}

}  // namespace svg_test
