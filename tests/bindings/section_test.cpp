// Sections through the C interface: against closed forms, and against the engine asked from inside.
#include <cmath>
#include <future>
#include <random>

#include "engine/contours/coverage.h"
#include "engine/field/slice_context.h"
#include "recipe/build/build_job.h"
#include "recipe/recipe_draft.h"
#include "tests/bindings/handles_by_call.h"

namespace section_test {

using namespace lamella;

namespace {

const std::string foam_ball =
    "[part]\nshape = \"sphere\"\nradius = 6\n[foam]\ncell = 2\nbeam = 0.25\n[skin]\nthickness = 0.5\n";

BuiltJob built_inside(const std::string& text) {
    RecipeDraft draft;
    draft.read_text(text, "test.toml");
    return build_job(draft.finish());
}

lamella_raster raster_about(double half, int pixels, int lines) {
    auto raster = sized<lamella_raster>();
    raster.columns = raster.rows = pixels;
    raster.lines = lines;
    raster.x = -half;
    raster.y = half;
    raster.pitch_x = 2 * half / pixels;
    raster.pitch_y = -2 * half / pixels;
    return raster;
}

ContoursHandle fill(const Caller& caller, lamella_section* section,
                    const std::vector<std::vector<double>>& polygons) {
    std::vector<double> points;
    std::vector<std::size_t> first{0};
    for (const auto& polygon : polygons) {
        points.insert(points.end(), polygon.begin(), polygon.end());
        first.push_back(points.size() / 2);
    }
    auto inside = sized<lamella_polygons>();
    inside.count = polygons.size();
    inside.first = first.data();
    inside.points = points.data();
    lamella_contours* contours = nullptr;
    caller.require(lamella_section_fill(caller, section, LAMELLA_PART, &inside, 0.005, &contours));
    return {contours, lamella_contours_destroy};
}

lamella_contours_view view_of(const Caller& caller, const lamella_contours* contours) {
    auto view = sized<lamella_contours_view>();
    caller.require(lamella_contours_view_get(caller, contours, &view));
    return view;
}

}  // namespace

TEST_CASE("contours and pixels of a ball are those of its circles", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, std::string("[part]\nshape = \"sphere\"\nradius = 5\n"));
    for (const double z : {-4.9, -2.0, 0.0, 3.25}) {
        const SectionHandle section = section_by_call(caller, job.get(), z);
        const double area = pi * (25 - z * z);
        CHECK(area_by_call(caller, section.get()) == Approx(area).epsilon(2e-3));
        const lamella_raster raster = raster_about(5.5, 440, 4);
        std::vector<std::uint8_t> pixels(440 * 440);
        caller.require(
            lamella_section_coverage(caller, section.get(), LAMELLA_PART, &raster, pixels.data(), 0));
        double sum = 0;
        for (const std::uint8_t pixel : pixels) sum += pixel / 255.0;
        CHECK(sum * 0.025 * 0.025 == Approx(area).epsilon(2e-3));
        auto info = sized<lamella_section_info>();
        caller.require(lamella_section_info_get(caller, section.get(), &info));
        CHECK(info.z == z);
        CHECK(info.layer == -1);
        CHECK(info.upper[0] >= std::sqrt(25 - z * z) - 1e-9);
    }
    lamella_section* opened = nullptr;
    caller.require(lamella_section_open_layer(caller, job.get(), 30, &opened));
    const SectionHandle layer(opened, lamella_section_destroy);
    auto info = sized<lamella_section_info>();
    caller.require(lamella_section_info_get(caller, opened, &info));
    CHECK(info.layer == 30);
    CHECK(info.z == Approx(-5 + 30.5 * 0.05));
    CHECK(lamella_section_open_layer(caller, job.get(), 200, &opened) == LAMELLA_BAD_CALL);
    const SectionHandle above = section_by_call(caller, job.get(), 5.5);
    CHECK(area_by_call(caller, above.get()) == 0);
    const double inside[6]{0, 0, 0, 0, 0, 7};
    double values[2];
    caller.require(lamella_job_values(caller, job.get(), inside, 2, values));
    CHECK(values[0] == Approx(-5));
    CHECK(values[1] == Approx(2));
}

TEST_CASE("pixels and runs are the engine's own, to the bit", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, foam_ball);
    const BuiltJob inside = built_inside(foam_ball);
    for (const double z : {-3.7, 0.4}) {
        const SectionHandle section = section_by_call(caller, job.get(), z);
        const lamella_raster raster = raster_about(6.2, 300, 4);
        RowBand band;
        band.along_origin = raster.x;
        band.along_pitch = raster.pitch_x;
        band.across_origin = raster.y;
        band.across_pitch = raster.pitch_y;
        band.count = band.hi = 300;
        band.sub = 4;
        SliceContext context;
        Scratch scratch;
        RunRows rows;
        context.slice(*inside.job.part, z).runs(band, scratch, rows);
        lamella_runs* runs = nullptr;
        caller.require(lamella_section_runs(caller, section.get(), LAMELLA_PART, &raster, &runs));
        auto view = sized<lamella_runs_view>();
        caller.require(lamella_runs_view_get(caller, runs, &view));
        REQUIRE(view.line_count == rows.lines());
        for (std::size_t l = 0; l < rows.lines(); ++l) {
            const auto line = rows.line(l);
            REQUIRE(view.first[l + 1] - view.first[l] == line.size());
            for (std::size_t k = 0; k < line.size(); ++k) {
                REQUIRE(view.ends[2 * (view.first[l] + k)] == line[k].begin);
                REQUIRE(view.ends[2 * (view.first[l] + k) + 1] == line[k].end);
            }
        }
        lamella_runs_destroy(runs);
        std::vector<GreyRun> greys;
        coverage(band, rows, greys);
        constexpr std::size_t stride = 317;
        std::vector<std::uint8_t> pixels(300 * stride, 7);
        caller.require(
            lamella_section_coverage(caller, section.get(), LAMELLA_PART, &raster, pixels.data(), stride));
        std::size_t at = 0;
        for (const GreyRun& grey : greys) {
            for (std::uint32_t k = 0; k < grey.length; ++k, ++at)
                REQUIRE(pixels[at / 300 * stride + at % 300] == grey.value);
        }
        for (std::size_t row = 0; row < 300; ++row)
            for (std::size_t k = 300; k < stride; ++k) REQUIRE(pixels[row * stride + k] == 7);
        lamella_contours* contours = nullptr;
        caller.require(lamella_section_contours(caller, section.get(), LAMELLA_PART, 0.02, &contours));
        const ContoursHandle handle(contours, lamella_contours_destroy);
        const auto traced = trace_contours(context.slice(*inside.job.part, z), 0.02, scratch);
        const lamella_contours_view flat = view_of(caller, contours);
        REQUIRE(flat.count == traced.size());
        for (std::size_t i = 0; i < traced.size(); ++i) {
            CHECK(flat.parent[i] == traced[i].parent);
            REQUIRE(flat.first[i + 1] - flat.first[i] == traced[i].points.size());
            for (std::size_t k = 0; k < traced[i].points.size(); ++k) {
                REQUIRE(flat.points[2 * (flat.first[i] + k)] == traced[i].points[k].x);
                REQUIRE(flat.points[2 * (flat.first[i] + k) + 1] == traced[i].points[k].y);
            }
        }
    }
}

TEST_CASE("polygons are filled with what the job has there", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, std::string("[part]\nshape = \"box\"\nsize = [20, 20, 4]\n"));
    const SectionHandle section = section_by_call(caller, job.get(), 0.3);
    // A square with a hole, a triangle that stands out of the box by half, and one wholly outside.
    const std::vector<std::vector<double>> polygons{{-6, -6, -1, -6, -1, -1, -6, -1},
                                                    {-5, -5, -5, -2, -2, -2, -2, -5},
                                                    {8, 0, 12, 0, 12, 4, 8, 4},
                                                    {30, 30, 40, 30, 35, 40}};
    const ContoursHandle filled = fill(caller, section.get(), polygons);
    const lamella_contours_view view = view_of(caller, filled.get());
    CHECK(view.area == Approx(25 - 9 + 8).epsilon(1e-3));
    CHECK(view.count == 3);
    const ContoursHandle none = fill(caller, section.get(), {});
    CHECK(view_of(caller, none.get()).count == 0);
}

TEST_CASE("foam in polygons is the foam of the section", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(
        caller, std::string("[part]\nshape = \"box\"\nsize = [20, 20, 4]\n[foam]\ncell = 2\nbeam = 0.3\n"));
    const SectionHandle section = section_by_call(caller, job.get(), 0.3);
    const std::vector<double> left{-9, -9, 1, -9, 1, 9, -9, 9}, right{1, -9, 9, -9, 9, 9, 1, 9},
        both{-9, -9, 9, -9, 9, 9, -9, 9};
    const auto area = [&](const std::vector<std::vector<double>>& polygons) {
        return view_of(caller, fill(caller, section.get(), polygons).get()).area;
    };
    CHECK(area({left}) + area({right}) == Approx(area({both})).epsilon(1e-3));
    CHECK(area({both}) < 0.6 * 18 * 18);
    CHECK(area({both}) > 0.02 * 18 * 18);
}

TEST_CASE("supports are a part of the section of their own", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(
        caller, std::string("[part]\nshape = \"torus\"\nradius = 8\ntube = 2\n[support]\nkind = \"pillars\"\n"
                            "[printer]\nprofile = \"marlin\"\n[layers]\nheight = 0.2\n"));
    auto info = sized<lamella_job_info>();
    caller.require(lamella_job_info_get(caller, job.get(), &info));
    REQUIRE(info.has_supports == 1);
    const SectionHandle section = section_by_call(caller, job.get(), info.lower[2] + 0.3);
    const double part = area_by_call(caller, section.get()),
                 supports = area_by_call(caller, section.get(), 0.01, LAMELLA_SUPPORTS),
                 both = area_by_call(caller, section.get(), 0.01, LAMELLA_PART | LAMELLA_SUPPORTS);
    CHECK(supports > 0);
    CHECK(both == Approx(part + supports).epsilon(0.02));
}

TEST_CASE("threads with contexts of their own cut one job", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, foam_ball);
    const auto areas = [&](unsigned seed) {
        const Caller own;
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> height(-5.5, 5.5);
        std::vector<double> list;
        for (int i = 0; i < 12; ++i)
            list.push_back(area_by_call(own, section_by_call(own, job.get(), height(random)).get(), 0.05));
        return list;
    };
    const std::vector<double> expected = areas(3);
    std::vector<std::future<std::vector<double>>> threads;
    for (int i = 0; i < 4; ++i) threads.push_back(std::async(std::launch::async, areas, 3));
    for (auto& thread : threads) CHECK(thread.get() == expected);
}

TEST_CASE("rasters that are none are refused", "[bindings]") {
    const Caller caller;
    const JobHandle job = job_by_call(caller, std::string("[part]\nshape = \"sphere\"\nradius = 5\n"));
    const SectionHandle section = section_by_call(caller, job.get(), 0);
    std::uint8_t pixel = 0;
    const auto status = [&](auto change) {
        lamella_raster raster = raster_about(1, 1, 1);
        change(raster);
        return lamella_section_coverage(caller, section.get(), LAMELLA_PART, &raster, &pixel, 0);
    };
    CHECK(status([](lamella_raster&) {}) == LAMELLA_OK);
    CHECK(status([](lamella_raster& r) { r.columns = 0; }) == LAMELLA_BAD_CALL);
    CHECK(status([](lamella_raster& r) { r.rows = -4; }) == LAMELLA_BAD_CALL);
    CHECK(status([](lamella_raster& r) { r.columns = 1 << 30; }) == LAMELLA_BAD_CALL);
    CHECK(status([](lamella_raster& r) { r.lines = 1000; }) == LAMELLA_BAD_CALL);
    CHECK(status([](lamella_raster& r) { r.pitch_x = 0; }) == LAMELLA_BAD_CALL);
    CHECK(status([](lamella_raster& r) { r.y = std::nan(""); }) == LAMELLA_BAD_CALL);
    lamella_contours* contours = nullptr;
    CHECK(lamella_section_contours(caller, section.get(), LAMELLA_PART, 0, &contours) == LAMELLA_BAD_CALL);
    CHECK(contours == nullptr);
}

}  // namespace section_test
