// CLI files hold the same contours in ASCII and binary as an SVG does, as their readers expect them.
#include "printers/vector/cli.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <map>
#include <sstream>

#include "engine/base/error.h"
#include "printers/vector/svg.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/toolpath/supported_table.h"

namespace cli_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

struct Polyline {
    long id = 0;
    long direction = -1;
    std::vector<dvec2> points;  ///< mm
    /// Positive when counter-clockwise; the last point repeats the first.
    double area() const {
        double twice = 0;
        for (std::size_t i = 0; i + 1 < points.size(); ++i)
            twice += points[i].x * points[i + 1].y - points[i + 1].x * points[i].y;
        return twice / 2;
    }
};

struct CliLayer {
    double z = 0;  ///< mm
    std::vector<Polyline> lines;
    double area(long id) const {
        double sum = 0;
        for (const Polyline& line : lines) sum += line.id == id ? line.area() : 0;
        return sum;
    }
};

struct CliContent {
    std::map<std::string, std::string> header;  ///< by command; of several the last
    std::vector<std::string> labels;
    std::vector<CliLayer> layers;
};

std::vector<double> numbers(const std::string& text) {
    std::vector<double> out;
    std::istringstream in(text);
    for (std::string field; std::getline(in, field, ',');) {
        std::size_t used = 0;
        out.push_back(std::stod(field, &used));
        REQUIRE(used == field.size());
    }
    return out;
}

/// A file of either kind, by the format's description; anything unknown fails.
class CliReader {
  public:
    explicit CliReader(const std::string& path) : text_(read_text(path)) {
        REQUIRE(text_.starts_with("$$HEADERSTART\n"));
        const std::size_t end = text_.find("$$HEADEREND");
        REQUIRE(end != std::string::npos);
        std::istringstream header(text_.substr(0, end));
        for (std::string line; std::getline(header, line);) {
            REQUIRE(line.starts_with("$$"));
            const std::size_t slash = line.find('/');
            const std::string key = line.substr(2, slash - 2);
            const std::string value = slash == std::string::npos ? "" : line.substr(slash + 1);
            content_.header[key] = value;
            if (key == "LABEL") content_.labels.push_back(value);
        }
        units_ = std::stod(content_.header.at("UNITS"));
        at_ = end + std::strlen("$$HEADEREND");
        content_.header.contains("BINARY") ? binary() : ascii();
    }
    const CliContent& content() const { return content_; }

  private:
    void ascii() {
        REQUIRE(text_.substr(at_).starts_with("\n$$GEOMETRYSTART\n"));
        REQUIRE(text_.ends_with("\n$$GEOMETRYEND\n"));
        std::istringstream body(text_.substr(at_ + std::strlen("\n$$GEOMETRYSTART\n")));
        for (std::string line; std::getline(body, line) && line != "$$GEOMETRYEND";) {
            const std::vector<double> values = numbers(line.substr(line.find('/') + 1));
            if (line.starts_with("$$LAYER/")) {
                REQUIRE(values.size() == 1);
                content_.layers.push_back({values[0] * units_, {}});
                continue;
            }
            REQUIRE(line.starts_with("$$POLYLINE/"));
            REQUIRE(static_cast<double>(values.size()) == 3 + 2 * values.at(2));
            Polyline polyline{static_cast<long>(values[0]), static_cast<long>(values[1]), {}};
            for (std::size_t i = 3; i < values.size(); i += 2)
                polyline.points.push_back({values[i] * units_, values[i + 1] * units_});
            content_.layers.back().lines.push_back(std::move(polyline));
        }
    }

    template <typename T>
    T take() {
        T value{};
        REQUIRE(at_ + sizeof(T) <= text_.size());
        std::memcpy(&value, &text_[at_], sizeof(T));
        at_ += sizeof(T);
        return value;
    }

    void binary() {
        while (at_ < text_.size()) {
            const auto command = take<std::uint16_t>();
            if (command == 127) {
                content_.layers.push_back({static_cast<double>(take<float>()) * units_, {}});
                continue;
            }
            REQUIRE(command == 130);
            Polyline polyline{take<std::int32_t>(), take<std::int32_t>(), {}};
            const auto count = take<std::int32_t>();
            REQUIRE(count > 0);
            for (std::int32_t i = 0; i < count; ++i) {
                const double x = static_cast<double>(take<float>()) * units_;
                polyline.points.push_back({x, static_cast<double>(take<float>()) * units_});
            }
            REQUIRE(!content_.layers.empty());
            content_.layers.back().lines.push_back(std::move(polyline));
        }
    }

    std::string text_;
    std::size_t at_ = 0;
    double units_ = 1;
    CliContent content_;
};

/// Areas of the layers of an SVG's part.
std::vector<double> svg_areas(const std::string& path) {
    const std::string text = read_text(path);
    std::vector<double> areas;
    std::size_t at = 0;
    while ((at = text.find("<g ", at)) != std::string::npos) {
        const std::size_t end = text.find("</g>", at);
        const std::size_t data = text.find(" d=\"", at);
        areas.push_back(0);
        at = end;
        if (data > end) continue;
        std::istringstream rings(text.substr(data + 4, text.find('"', data + 4) - data - 4));
        for (std::string ring; std::getline(rings, ring, 'Z');) {
            Polyline line;
            for (char& c : ring) c = c == 'M' || c == 'L' ? ' ' : c;
            std::istringstream points(ring);
            for (dvec2 p{0}; points >> p.x >> p.y;) line.points.push_back(p);
            if (line.points.empty()) continue;
            line.points.push_back(line.points.front());
            areas.back() -= line.area();  // y runs down
        }
    }
    return areas;
}

/// A disc with a square hole, shrinking upwards, and gone at the top.
Job rings() {
    return make_job(
        {{-5, -15, 2}, {5, -5, 7}},
        [](double z) {
            return z > 6.5 ? std::vector<Figure>() : std::vector<Figure>{disc({0, -10}, 5.5 - z / 4)};
        },
        0.5,
        [](double) {
            return std::vector<Figure>{rectangle({-1, -11}, {1, -9})};
        });
}

double ring_layer_area(const Job& job, int i) {
    const double radius = 5.5 - job.plane(i) / 4;
    return job.plane(i) > 6.5 ? 0 : pi * radius * radius - 4;
}

PrinterProfile printer(CliFormat format, double units = 1) {
    PrinterProfile profile;
    profile.exchange.cli_format = format;
    profile.exchange.cli_units = units;
    return profile;
}

}  // namespace

TEST_CASE("a CLI file holds every layer by the height of its top, closed and in the right direction",
          "[cli]") {
    const TemporaryFolder folder;
    const Job job = rings();
    const auto format = GENERATE(CliFormat::ascii, CliFormat::binary);
    const double units = GENERATE(1.0, 0.001, 0.005, 25.4);
    CAPTURE(units, format == CliFormat::binary);
    const double volume =
        run_layers(job, *make_cli(printer(format, units), folder / "out.cli", false), {0, 10});
    const CliReader reader(folder / "out.cli");
    const CliContent& cli = reader.content();
    CHECK(cli.header.at("VERSION") == "200");
    CHECK(cli.header.at("LAYERS") == "11");
    CHECK(cli.labels == std::vector<std::string>{"1,figures"});
    CHECK(!cli.header.contains("DATE"));
    CHECK(cli.header.at("DIMENSION") == "-5,-15,0,5,-5,5");
    REQUIRE(cli.layers.size() == 11);
    CHECK(cli.layers[0].z == 0);
    CHECK(cli.layers[0].lines.empty());
    double sum = 0;
    for (int i = 0; i < 10; ++i) {
        CAPTURE(i);
        const CliLayer& layer = cli.layers[static_cast<std::size_t>(i) + 1];
        CHECK(layer.z == Approx((i + 1) * 0.5).epsilon(1e-6));
        REQUIRE(layer.lines.size() == (i < 9 ? 2U : 0U));
        for (const Polyline& line : layer.lines) {
            CHECK(line.id == 1);
            CHECK(line.points.front() == line.points.back());
            CHECK(line.direction == (line.area() > 0 ? 1 : 0));
            for (const dvec2 p : line.points) CHECK((-15.01 < p.y && p.y < -4.99));
        }
        CHECK(layer.area(1) == Approx(ring_layer_area(job, i)).epsilon(0.005).margin(1e-9));
        sum += layer.area(1) * 0.5;
    }
    CHECK(volume == Approx(sum).epsilon(1e-4));
}

TEST_CASE("ASCII, binary and SVG hold the same areas", "[cli]") {
    const TemporaryFolder folder;
    const Job job = rings();
    const LayerRange all{0, 10};
    run_layers(job, *make_cli(printer(CliFormat::ascii), folder / "a.cli", false), all);
    run_layers(job, *make_cli(printer(CliFormat::binary), folder / "b.cli", false), all);
    run_layers(job, *make_svg({}, folder / "c.svg", false), all);
    const CliReader ascii(folder / "a.cli"), binary(folder / "b.cli");
    const std::vector<double> svg = svg_areas(folder / "c.svg");
    REQUIRE(svg.size() == 10);
    REQUIRE(ascii.content().layers.size() == 11);
    REQUIRE(binary.content().layers.size() == 11);
    for (std::size_t i = 0; i < 10; ++i) {
        const CliLayer& a = ascii.content().layers[i + 1];
        const CliLayer& b = binary.content().layers[i + 1];
        CHECK(a.area(1) == Approx(svg[i]).epsilon(2e-5).margin(1e-9));
        REQUIRE(a.lines.size() == b.lines.size());
        for (std::size_t k = 0; k < a.lines.size(); ++k) {
            REQUIRE(a.lines[k].points.size() == b.lines[k].points.size());
            for (std::size_t p = 0; p < a.lines[k].points.size(); ++p) {
                // Binary numbers have 24 bits: half a step of a float between 8 and 16.
                CHECK(glm::distance(a.lines[k].points[p], b.lines[k].points[p]) < 1e-6);
            }
        }
    }
}

TEST_CASE("an empty layer below the first one is there unless it is not wanted", "[cli]") {
    const TemporaryFolder folder;
    PrinterProfile profile = printer(CliFormat::ascii);
    run_layers(rings(), *make_cli(profile, folder / "with.cli", false), {3, 6});
    const CliReader with(folder / "with.cli");
    REQUIRE(with.content().layers.size() == 4);
    CHECK(with.content().layers[0].z == Approx(1.5));
    CHECK(with.content().layers[1].z == Approx(2));
    profile.exchange.cli_empty_layer = false;
    run_layers(rings(), *make_cli(profile, folder / "without.cli", false), {3, 6});
    const CliReader without(folder / "without.cli");
    CHECK(without.content().header.at("LAYERS") == "3");
    REQUIRE(without.content().layers.size() == 3);
    CHECK(without.content().layers[0].z == Approx(2));
}

TEST_CASE("supports in a CLI file have a number and a label of their own", "[cli]") {
    const TemporaryFolder folder;
    const Job job = supported_table();
    run_layers(job, *make_cli(printer(CliFormat::binary), folder / "out.cli", false), {0, 20});
    const CliReader reader(folder / "out.cli");
    CHECK(reader.content().labels == std::vector<std::string>{"1,figures", "2,supports"});
    REQUIRE(reader.content().layers.size() == 21);
    for (int i = 0; i < 20; ++i) {
        const CliLayer& layer = reader.content().layers[static_cast<std::size_t>(i) + 1];
        CHECK(layer.area(1) == Approx(i < 15 ? 0 : table_area).epsilon(1e-3).margin(1e-9));
        CHECK(layer.area(2) == Approx(scaffold_area(job.plane(i))).epsilon(0.02).margin(1e-9));
    }
}

TEST_CASE("a CLI file that was stopped is continued byte for byte", "[cli]") {
    const TemporaryFolder folder;
    const Job job = rings();
    const PrinterProfile profile = printer(GENERATE(CliFormat::ascii, CliFormat::binary));
    run_layers(job, *make_cli(profile, folder / "whole.cli", false), {0, 10});
    const int stop = GENERATE(0, 1, 9);
    run_layers(job, *make_cli(profile, folder / "parts.cli", false), {0, 10}, false, stop);
    CHECK(!fs::exists(folder / "parts.cli"));
    std::ofstream(folder / "parts.cli.partial", std::ios::app) << "$$POLYLINE/1,1,4,0";
    CHECK(make_cli(profile, folder / "parts.cli", false)->open(job, {0, 10}, true) == stop);
    PrinterProfile other = profile;
    other.exchange.cli_units = 0.5;
    CHECK_THROWS_AS(make_cli(other, folder / "parts.cli", false)->open(job, {0, 10}, true), InputError);
    run_layers(job, *make_cli(profile, folder / "parts.cli", false), {0, 10}, true);
    CHECK(read_text(folder / "parts.cli") == read_text(folder / "whole.cli"));
}

TEST_CASE("names cannot break a CLI header, and units must fit the part", "[cli]") {
    const TemporaryFolder folder;
    Job job = rings();
    job.name = "a,b/c\n$$HEADEREND\xc3\xa4" + std::string(200, 'x');
    run_layers(job, *make_cli(printer(CliFormat::ascii), folder / "out.cli", false), {0, 10});
    const CliReader reader(folder / "out.cli");
    CHECK(reader.content().labels.at(0).starts_with("1,a_b_c___HEADEREND__xx"));
    CHECK(reader.content().labels.at(0).size() == 82);
    CHECK(reader.content().layers.size() == 11);
    for (const double units : {0.0, -1.0, 1e-9, 1e5, std::nan("")}) {
        CHECK_THROWS_AS(
            make_cli(printer(CliFormat::ascii, units), folder / "a.cli", false)->open(job, {0, 10}, false),
            InputError);
    }
    job.bounds.hi.x = 2e4;
    CHECK_THROWS_WITH(
        make_cli(printer(CliFormat::ascii, 1e-5), folder / "a.cli", false)->open(job, {0, 10}, false),
        Catch::Contains("cli_units"));
}

}  // namespace cli_test
