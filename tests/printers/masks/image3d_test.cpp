// Image stacks in 3MF packages: what is written is read back as the solid it was made of.
#include "printers/masks/image3d.h"

#include <catch2/catch.hpp>
#include <map>

#include "engine/base/error.h"
#include "procedural/volume/volumetric_model.h"
#include "tests/engine/runs/plane_runs.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/toolpath/supported_table.h"

namespace image3d_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

/// A cone with a square hole, from radius 5 at the bed to 3.5, and a disc beside it.
Job cone() {
    return make_job(
        {{-5, 5, 2}, {9, 15, 8}},
        [](double z) {
            return std::vector<Figure>{disc({0, 10}, 5.5 - z / 4), disc({7, 7}, 1.5)};
        },
        0.25,
        [](double) {
            return std::vector<Figure>{rectangle({-1, 9}, {1, 11})};
        });
}

PrinterProfile printer(double pixel) {
    PrinterProfile profile;
    profile.backend = "image3d";
    profile.image.pixel_x = profile.image.pixel_y = pixel;
    return profile;
}

int count_of(const std::string& text, const std::string& what) {
    int count = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
    return count;
}

std::map<std::string, std::string> package(const std::string& path) {
    const auto entries = read_zip(path);
    return {entries.begin(), entries.end()};
}

}  // namespace

TEST_CASE("an image stack that is read back is the solid that was written", "[image3d]") {
    const TemporaryFolder folder;
    const Job job = cone();
    PrinterProfile profile = printer(0.1);
    profile.image.pixel_y = 0.08;
    profile.image.bits = GENERATE(8, 16);
    profile.image.antialiasing = GENERATE(Antialiasing::rows, Antialiasing::exact);
    const double volume = run_layers(job, *make_image3d(profile, folder / "out.3mf", false), {0, 24});
    VolumetricModel model(folder / "out.3mf");
    const FieldPtr solid = model.built();
    // The grid has a pixel more at each side; its corner lies at the origin.
    const Box box = solid->bounds();
    CHECK(box.lo.x == Approx(0).margin(1e-9));
    CHECK(box.size().x == Approx(14.2));
    CHECK(box.size().y == Approx(10.16));
    CHECK(box.lo.z == Approx(0).margin(1e-9));
    CHECK(box.hi.z == Approx(6));
    const dvec3 to_part(-5.1, 5 - 0.08, 2);
    CHECK(volume_in(*solid, box, 0.05) == Approx(volume).epsilon(2e-3));
    // Farther than a voxel from the surface each point is on its side.
    int compared = 0;
    for (int i = 0; i < 4000; ++i) {
        const dvec3 share(std::fmod(i * 0.7548776662, 1), std::fmod(i * 0.5698402910, 1),
                          std::fmod(i * 0.4301597090, 1));
        const dvec3 p = box.lo + box.size() * share;
        const double truth = job.part->value(p + to_part);
        if (std::abs(truth) < 0.15) continue;
        ++compared;
        CHECK((solid->value(p) < 0) == (truth < 0));
    }
    CHECK(compared > 3000);
}

TEST_CASE("a package of sheets names every part of it", "[image3d]") {
    const TemporaryFolder folder;
    run_layers(cone(), *make_image3d(printer(0.2), folder / "out.3mf", false), {4, 10});
    auto files = package(folder / "out.3mf");
    CHECK(files.size() == 10);
    const std::string model = files.at("3D/3dmodel.model"),
                      relations = files.at("3D/_rels/3dmodel.model.rels");
    CHECK(model.find("requiredextensions=\"v\"") != std::string::npos);
    CHECK(model.find("rowcount=\"52\" columncount=\"72\" sheetcount=\"6\"") != std::string::npos);
    CHECK(files.at("[Content_Types].xml").find("Extension=\"png\" ContentType=\"image/png\"") !=
          std::string::npos);
    for (int i = 0; i < 6; ++i) {
        const std::string path = "3D/volumetric/part/00000" + std::to_string(i) + ".png";
        CHECK(files.contains(path));
        CHECK(count_of(model, "path=\"/" + path + "\"") == 1);
        CHECK(count_of(relations, "Target=\"/" + path + "\"") == 1);
    }
    // Layers 4 to 10 lie 1 to 2.5 mm over the plate.
    const Box box = VolumetricModel(folder / "out.3mf").built()->bounds();
    CHECK(box.lo.z == Approx(1));
    CHECK(box.hi.z == Approx(2.5));
}

TEST_CASE("supports are an image and an object of their own", "[image3d]") {
    const TemporaryFolder folder;
    const Job job = supported_table();
    run_layers(job, *make_image3d(printer(0.1), folder / "out.3mf", false), {0, job.layers.count()});
    auto files = package(folder / "out.3mf");
    const std::string model = files.at("3D/3dmodel.model");
    CHECK(count_of(model, "type=\"solidsupport\"") == 1);
    CHECK(count_of(model, "<item ") == 2);
    CHECK(static_cast<int>(files.size()) == 2 * job.layers.count() + 4);
    // What is printed is the table; the scaffold is there by its name.
    VolumetricModel read(folder / "out.3mf");
    const FieldPtr table = read.built(), scaffold = read.object("figures supports");
    const dvec3 leg(-6 - job.bounds.lo.x + 0.1, 0 - job.bounds.lo.y + 0.1, 1);
    CHECK(table->value(leg) > 0);
    const Box box = table->bounds();
    CHECK(volume_in(*table, box, 0.05) == Approx(table_area).epsilon(0.01));
    double volume = 0;
    for (int i = 0; i < job.layers.count(); ++i) volume += scaffold_area(job.plane(i)) * job.layers.height(i);
    CHECK(volume_in(*scaffold, scaffold->bounds(), 0.05) == Approx(volume).epsilon(0.1));
}

TEST_CASE("a package of sheets that was stopped is continued byte for byte", "[image3d]") {
    const TemporaryFolder folder;
    const Job job = GENERATE(true, false) ? cone() : supported_table();
    const int count = job.layers.count();
    run_layers(job, *make_image3d(printer(0.2), folder / "whole.3mf", false), {0, count});
    const int stop = GENERATE(0, 1, 8);
    run_layers(job, *make_image3d(printer(0.2), folder / "parts.3mf", false), {0, count}, false, stop);
    CHECK(!fs::exists(folder / "parts.3mf"));
    std::ofstream(folder / "parts.3mf.partial", std::ios::app) << "PK\x03\x04 torn";
    CHECK_THROWS_AS(make_image3d(printer(0.1), folder / "parts.3mf", false)->open(job, {0, count}, true),
                    InputError);
    CHECK(make_image3d(printer(0.2), folder / "parts.3mf", false)->open(job, {0, count}, true) == stop);
    run_layers(job, *make_image3d(printer(0.2), folder / "parts.3mf", false), {0, count}, true);
    CHECK(read_text(folder / "parts.3mf") == read_text(folder / "whole.3mf"));
}

TEST_CASE("sheets that are too large, or whose greys are no shares, are refused", "[image3d]") {
    const TemporaryFolder folder;
    const Job job = cone();
    const auto refusal = [&](const PrinterProfile& profile) {
        try {
            make_image3d(profile, folder / "a.3mf", false)->open(job, {0, 24}, false);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("nothing was refused");
    };
    CHECK_THAT(refusal(printer(0.0001)), Catch::Contains("accepted: larger pixels"));
    PrinterProfile profile = printer(0.1);
    profile.image.gamma = 2;
    CHECK_THAT(refusal(profile), Catch::Contains("accepted: gamma = 1"));
    profile = printer(0.1);
    profile.image.format = ImageFormat::bmp;
    CHECK_THAT(refusal(profile), Catch::Contains("accepted: format = \"png\""));
    CHECK_THAT(refusal(printer(0)), Catch::Contains("pixel"));
}

}  // namespace image3d_test
