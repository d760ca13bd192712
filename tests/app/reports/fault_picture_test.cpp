// Pictures of faults: pixels are covered as far as solids reach, and colours say what is where.
#include "app/reports/fault_picture.h"

#include <catch2/catch.hpp>

#include "app/reports/layer_block.h"
#include "engine/field/slice_context.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"

namespace fault_picture_test {

using namespace lamella;

namespace {

/// A block of 6 x 4 mm, 2 mm high, on a narrower one as high, in layers of half a millimetre.
Job step() {
    Job job;
    job.part = make_union({make_box({{-1, -1, 0}, {1, 1, 2}}), make_box({{-3, -2, 2}, {3, 2, 4}})});
    job.bounds = {{-3, -2, 0}, {3, 2, 4}};
    job.layers = {8, 0.5};
    return job;
}

/// Rows a tenth of a millimetre apart from (-3, -2) on.
RowBand tenths() {
    RowBand band;
    band.along_origin = -3;
    band.across_origin = -2;
    band.along_pitch = band.across_pitch = 0.1;
    return band;
}

/// Run units of so many tenths of a millimetre.
std::int32_t units(int tenths) { return tenths * run_unit; }

dvec3 colour(const SectionPicture& section, dvec2 place) {
    const dvec2 at = section.at(place);
    const auto pixel =
        static_cast<std::size_t>(static_cast<int>(at.y) * section.picture.width + static_cast<int>(at.x));
    const auto* rgb = section.picture.rgb.data() + 3 * pixel;
    return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

TEST_CASE("pixels are covered by the share of them that runs take", "[check]") {
    const FieldPtr box = make_box({{0.25, 0.5, 0}, {1.6, 1.75, 1}});
    SliceContext context;
    RunCoverage shares({{0, 0}, {3, 2}}, 3);
    REQUIRE(shares.height() == 2);
    shares.add(context.slice(*box, 0.5));
    CHECK(shares.at(0, 0) == Approx(0.75 * 0.5).epsilon(0.01));
    CHECK(shares.at(1, 0) == Approx(0.6 * 0.5).epsilon(0.01));
    CHECK(shares.at(1, 1) == Approx(0.6 * 0.75).epsilon(0.01));
    CHECK(shares.at(2, 1) == 0);
    RunCoverage runs({{-3, -2}, {3, 2}}, 6);
    const std::vector<PlacedRun> placed{{0, 3, units(5), units(25)}, {0, 4, units(5), units(12)}};
    runs.add(placed, tenths());
    CHECK(runs.at(0, 0) == Approx(0.5 * 0.1 + 0.5 * 0.1));
    CHECK(runs.at(1, 0) == Approx(0.1 + 0.2 * 0.1));
    CHECK(runs.at(2, 0) == Approx(0.5 * 0.1));
    CHECK(runs.at(2, 1) == 0);
    shares.subtract(shares);
    CHECK(shares.at(1, 1) == 0);
}

TEST_CASE("a block of layers is solid where they are, and nowhere else", "[check]") {
    const Rect rect{{0, 0}, {4, 3}};
    const FieldPtr low = make_box({{1, 1, -9}, {3, 2, 9}}), high = make_box({{1.5, 0, -9}, {4, 3, 9}});
    SliceContext context;
    std::vector<RunCoverage> layers;
    for (const FieldPtr& layer : {low, low, high})
        layers.emplace_back(rect, 80).add(context.slice(*layer, 0));
    const auto block = std::make_shared<const LayerBlock>(Box{{0, 0, 0}, {4, 3, 1.5}}, layers);
    std::size_t wrong = 0;
    double volume = 0;
    for (double z = 0.05; z < 1.5; z += 0.1) {
        for (double y = 0.105; y < 3; y += 0.11) {
            for (double x = 0.105; x < 4; x += 0.13) {
                const dvec3 p(x, y, z);
                const Field& layer = z < 1 ? *low : *high;
                if (std::abs(layer.value(p)) < 0.05) continue;
                wrong += (block->value(p) < 0) != (layer.value(p) < 0);
            }
        }
        RowBand band;
        band.along_pitch = band.across_pitch = 0.05;
        band.count = 60;
        band.hi = 80;
        RunRows rows;
        Scratch scratch;
        context.slice(*block, z).runs(band, scratch, rows);
        volume += static_cast<double>(rows.total_length()) / run_unit * 0.05 * 0.05 * 0.1;
    }
    CHECK(wrong == 0);
    CHECK(volume == Approx(2 * 1 * 1 + 2.5 * 3 * 0.5).epsilon(0.03));
    CHECK(block->value({2, 1.5, -0.1}) > 0);
    CHECK(block->value({2, 1.5, 1.6}) > 0);
}

TEST_CASE("a section shows the part, what lies below it, and the fault", "[check]") {
    const Job job = step();
    const std::vector<PlacedRun> fault{{4, 35, units(50), units(60)}, {4, 36, units(50), units(60)}};
    const Rect shown{{-4, -3}, {4, 3}};
    const SectionPicture section = draw_section(job, 4, shown, 160, fault, tenths());
    CHECK(section.picture.width == 160);
    CHECK(section.picture.height == 120);
    const dvec3 part = colour(section, {0, 0}), paper = colour(section, {3.5, 2.5});
    const dvec3 red = colour(section, {2.5, 1.6});
    CHECK(paper == dvec3(255));
    CHECK(part.x < 200);
    CHECK(red.x > 1.5 * red.y);
    CHECK(colour(section, {-2.5, 1.6}) == part);  // the other side is as it should be
    CHECK(colour(section, {2.5, -1.6}) == part);  // and pictures are not upside down
    // One layer down there is the narrow block alone.
    CHECK(colour(draw_section(job, 3, shown, 160, {}, {}), {2.5, 1.6}) == paper);
}

TEST_CASE("what is shown of a fault holds all of it, four wide to three high", "[check]") {
    const Job job = step();
    Fault fault;
    fault.layer = 4;
    fault.runs = {{4, 1, units(2), units(58)}, {4, 38, units(20), units(21)}};
    const Rect rect = about_fault(fault, tenths(), job);
    CHECK(rect.size().x == Approx(rect.size().y * 4 / 3));
    CHECK(rect.lo.x < -2.8);
    CHECK(rect.hi.x > 2.8);
    CHECK(rect.lo.y < -1.9);
    CHECK(rect.hi.y > 1.9);
}

TEST_CASE("from the side a fault is red, and nothing is where nothing is wrong", "[check]") {
    const Job job = step();
    const auto reds = [&](const std::vector<PlacedRun>& runs) {
        Fault fault;
        fault.layer = 7;
        fault.runs = runs;
        fault.box = {{-3, -2, 3.5}, {3, 2, 4}};
        const Picture picture = draw_fault(job, fault, tenths(), 128);
        std::size_t found = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
            found += picture.rgb[i] > 2 * picture.rgb[i + 1] + 20;
        return found;
    };
    std::vector<PlacedRun> quarter;
    for (int row = 0; row < 20; ++row) quarter.push_back({7, row, 0, units(30)});
    CHECK(reds({}) == 0);
    CHECK(reds(quarter) > 128 * 96 / 40);
    CHECK(reds(quarter) < 128 * 96 / 4);
}

}  // namespace fault_picture_test
