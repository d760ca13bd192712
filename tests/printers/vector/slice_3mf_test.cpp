// 3MF packages hold slices that close, add up to the part's areas, and survive being stopped.
#include "printers/vector/slice_3mf.h"

#include <catch2/catch.hpp>
#include <map>

#include "engine/base/error.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/toolpath/supported_table.h"

namespace slice_3mf_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

/// The value of the next attribute of that name behind `at`, which moves there.
double attribute(const std::string& text, const char* name, std::size_t& at) {
    const std::string start = std::string(" ") + name + "=\"";
    at = text.find(start, at);
    REQUIRE(at != std::string::npos);
    at += start.size();
    const std::string value = text.substr(at, text.find('"', at) - at);
    REQUIRE(value.find_first_not_of("0123456789.-") == std::string::npos);
    return std::stod(value);
}

int count_of(const std::string& text, const std::string& what) {
    int count = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
    return count;
}

struct Slice {
    double top = 0;
    double area = 0;
    int polygons = 0;
};

/// The slices of a stack's text, each polygon checked to close.
std::vector<Slice> slices_of(const std::string& text) {
    std::vector<Slice> slices;
    for (std::size_t at = text.find("<s:slice "); at != std::string::npos; at = text.find("<s:slice ", at)) {
        std::size_t cursor = at;
        Slice slice{attribute(text, "ztop", cursor)};
        const std::size_t next = text.find("<s:slice ", cursor);
        const std::string body = text.substr(cursor, next - cursor);
        std::vector<dvec2> vertices;
        for (std::size_t v = body.find("<s:vertex "); v != std::string::npos;
             v = body.find("<s:vertex ", v)) {
            const double x = attribute(body, "x", v);
            vertices.push_back({x, attribute(body, "y", v)});
        }
        for (std::size_t p = body.find("<s:polygon"); p != std::string::npos;
             p = body.find("<s:polygon", p + 1)) {
            const std::string polygon = body.substr(p, body.find("</s:polygon>", p) - p);
            std::size_t s = 0;
            const auto start = static_cast<std::size_t>(attribute(polygon, "startv", s));
            std::size_t from = start;
            while ((s = polygon.find("<s:segment", s)) != std::string::npos) {
                const auto to = static_cast<std::size_t>(attribute(polygon, "v2", s));
                const dvec2 a = vertices.at(from), b = vertices.at(to);
                slice.area += (a.x * b.y - b.x * a.y) / 2;
                CHECK(a != b);
                from = to;
            }
            CHECK(from == start);
            ++slice.polygons;
        }
        slices.push_back(slice);
        at = cursor;
    }
    return slices;
}

std::map<std::string, std::string> package(const std::string& path) {
    const auto entries = read_zip(path);
    return {entries.begin(), entries.end()};
}

/// A disc with a square hole, shrinking upwards, and gone at the top.
Job rings() {
    return make_job(
        {{-5, 5, 2}, {5, 15, 7}},
        [](double z) {
            return z > 6.5 ? std::vector<Figure>() : std::vector<Figure>{disc({0, 10}, 5.5 - z / 4)};
        },
        0.5,
        [](double) {
            return std::vector<Figure>{rectangle({-1, 9}, {1, 11})};
        });
}

PrinterProfile printer(int package_layers) {
    PrinterProfile profile;
    profile.exchange.package_layers = package_layers;
    return profile;
}

}  // namespace

TEST_CASE("slices of a 3MF package rise, close and have the part's areas", "[3mf]") {
    const TemporaryFolder folder;
    const Job job = rings();
    const int package_layers = GENERATE(1, 3, 5, 100);
    CAPTURE(package_layers);
    const double volume =
        run_layers(job, *make_slice_3mf(printer(package_layers), folder / "out.3mf", false), {0, 10});
    auto files = package(folder / "out.3mf");
    const int parts = (10 + package_layers - 1) / package_layers;
    CHECK(static_cast<int>(files.size()) == parts + 4);
    const std::string model = files.at("3D/3dmodel.model");
    CHECK(count_of(model, "<s:sliceref slicestackid=\"1\"") == parts);
    CHECK(count_of(files.at("3D/_rels/3dmodel.model.rels"), "Target=\"/2D/slices0000") == parts);
    CHECK(model.find("requiredextensions=\"s\"") != std::string::npos);
    CHECK(model.find("s:meshresolution=\"lowres\"") != std::string::npos);
    CHECK(model.find("transform=\"1 0 0 0 1 0 0 0 1 5 -5 0\"") != std::string::npos);
    std::vector<Slice> slices;
    for (int i = 0; i < parts; ++i) {
        const std::string& text = files.at("2D/slices0000" + std::to_string(i) + ".model");
        std::size_t at = 0;
        CHECK(attribute(text, "zbottom", at) == Approx(i * package_layers * 0.5));
        for (const Slice& slice : slices_of(text)) slices.push_back(slice);
    }
    REQUIRE(slices.size() == 10);
    double sum = 0;
    for (int i = 0; i < 10; ++i) {
        const Slice& slice = slices[static_cast<std::size_t>(i)];
        CHECK(slice.top == Approx((i + 1) * 0.5));
        CHECK(slice.polygons == (i < 9 ? 2 : 0));
        const double radius = 5.5 - job.plane(i) / 4;
        CHECK(slice.area == Approx(i < 9 ? pi * radius * radius - 4 : 0).epsilon(0.005).margin(1e-9));
        sum += slice.area * 0.5;
    }
    CHECK(volume == Approx(sum).epsilon(1e-4));
}

TEST_CASE("the mesh that stands in for slices is the closed box around the job", "[3mf]") {
    const TemporaryFolder folder;
    run_layers(rings(), *make_slice_3mf(printer(4), folder / "out.3mf", false), {2, 9});
    const std::string model = package(folder / "out.3mf").at("3D/3dmodel.model");
    std::vector<dvec3> corners;
    for (std::size_t at = 0; (at = model.find("<vertex ", at)) != std::string::npos;) {
        const double x = attribute(model, "x", at), y = attribute(model, "y", at);
        corners.push_back({x, y, attribute(model, "z", at)});
    }
    REQUIRE(corners.size() == 8);
    double volume = 0;
    std::map<std::pair<int, int>, int> edges;
    for (std::size_t at = 0; (at = model.find("<triangle ", at)) != std::string::npos;) {
        const int a = static_cast<int>(attribute(model, "v1", at));
        const int b = static_cast<int>(attribute(model, "v2", at));
        const int c = static_cast<int>(attribute(model, "v3", at));
        const auto corner = [&](int i) { return corners.at(static_cast<std::size_t>(i)); };
        volume += glm::dot(corner(a), glm::cross(corner(b), corner(c))) / 6;
        for (const auto& edge : {std::pair{a, b}, {b, c}, {c, a}}) ++edges[edge];
    }
    CHECK(volume == Approx(10 * 10 * 3.5));
    CHECK(edges.size() == 36);
    for (const auto& [edge, count] : edges) {
        CHECK(count == 1);
        CHECK(edges.contains({edge.second, edge.first}));
    }
}

TEST_CASE("supports in a 3MF package are an object of their own", "[3mf]") {
    const TemporaryFolder folder;
    const Job job = supported_table();
    run_layers(job, *make_slice_3mf(printer(8), folder / "out.3mf", false), {0, 20});
    auto files = package(folder / "out.3mf");
    const std::string model = files.at("3D/3dmodel.model");
    CHECK(count_of(model, "type=\"solidsupport\"") == 1);
    CHECK(count_of(model, "<item ") == 2);
    CHECK(count_of(model, "slicestackid=\"2\" slicepath") == 3);
    int layer = 0;
    for (int i = 0; i < 3; ++i) {
        const std::string& text = files.at("2D/slices0000" + std::to_string(i) + ".model");
        const std::size_t second = text.find("<s:slicestack id=\"2\"");
        REQUIRE(second != std::string::npos);
        const auto part = slices_of(text.substr(0, second));
        const auto supports = slices_of(text.substr(second));
        REQUIRE(part.size() == supports.size());
        for (std::size_t k = 0; k < part.size(); ++k, ++layer) {
            CHECK(part[k].area == Approx(layer < 15 ? 0 : table_area).epsilon(1e-3).margin(1e-9));
            CHECK(supports[k].area == Approx(scaffold_area(job.plane(layer))).epsilon(0.02).margin(1e-9));
        }
    }
    CHECK(layer == 20);
}

TEST_CASE("a 3MF package that was stopped is continued byte for byte from its last part", "[3mf]") {
    const TemporaryFolder folder;
    const Job job = GENERATE(true, false) ? rings() : supported_table();
    const int count = job.layers.count();
    run_layers(job, *make_slice_3mf(printer(3), folder / "whole.3mf", false), {0, count});
    const int stop = GENERATE(0, 2, 3, 8, 9);
    CAPTURE(stop, count);
    run_layers(job, *make_slice_3mf(printer(3), folder / "parts.3mf", false), {0, count}, false, stop);
    CHECK(!fs::exists(folder / "parts.3mf"));
    std::ofstream(folder / "parts.3mf.partial", std::ios::app) << "PK\x03\x04 torn";
    CHECK_THROWS_AS(make_slice_3mf(printer(4), folder / "parts.3mf", false)->open(job, {0, count}, true),
                    InputError);
    CHECK(make_slice_3mf(printer(3), folder / "parts.3mf", false)->open(job, {0, count}, true) ==
          stop / 3 * 3);
    run_layers(job, *make_slice_3mf(printer(3), folder / "parts.3mf", false), {0, count}, true);
    CHECK(read_text(folder / "parts.3mf") == read_text(folder / "whole.3mf"));
}

TEST_CASE("senseless settings of a 3MF package are refused, and names cannot break it", "[3mf]") {
    const TemporaryFolder folder;
    Job job = rings();
    CHECK_THROWS_AS(make_slice_3mf(printer(0), folder / "a.3mf", false)->open(job, {0, 10}, false),
                    InputError);
    PrinterProfile profile = printer(5);
    profile.vector.tolerance = 0;
    CHECK_THROWS_AS(make_slice_3mf(profile, folder / "a.3mf", false)->open(job, {0, 10}, false), InputError);
    job.name = "a \"<b>\" & c\x01";
    run_layers(job, *make_slice_3mf(printer(5), folder / "out.3mf", false), {0, 10});
    CHECK(count_of(package(folder / "out.3mf").at("3D/3dmodel.model"),
                   "name=\"a &quot;&lt;b>&quot; &amp; c\"") == 1);
}

}  // namespace slice_3mf_test
