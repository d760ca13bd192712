// Parts printed one by one: each whole before the next, past those that are done.
#include <catch2/catch.hpp>
#include <map>

#include "engine/layers/layer_stream.h"
#include "engine/layers/plate.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "printers/gcode/gcode.h"
#include "recipe/machine_profiles.h"
#include "tests/printers/common/plane_solids.h"
#include "tests/printers/gcode/gcode_lines.h"

namespace one_by_one_test {

using namespace lamella;
using namespace lamella::test;

namespace {

Job block(const std::string& name, dvec3 size, LayerPlan layers) {
    Job job;
    job.name = name;
    job.part = make_box({dvec3(0), size});
    job.bounds = job.part->bounds();
    job.layers = std::move(layers);
    return job;
}

PrinterProfile printer() {
    PrinterProfile profile = MachineProfiles().find("marlin")->printer;
    profile.toolpath.skirt = 1;
    return profile;
}

/// Two high blocks, and a low one in layers of another height.
Job three_blocks() {
    const std::vector<PlateItem> items{{block("high", {10, 10, 6}, {30, 0.2}), 2},
                                       {block("low", {14, 8, 3}, {12, 0.25}), 1}};
    PlateOptions options;
    options.gap = 35;
    options.machine = {200, 200};
    options.one_by_one = true;
    return arrange_plates(items, options).front();
}

std::string written(const Job& job, int threads = 1) {
    const TemporaryFolder folder;
    StreamOptions options;
    options.range = {0, job.layers.count()};
    options.threads = threads;
    stream_layers(job, *make_gcode(printer(), folder / "a.gcode", false), options);
    return read_text(folder / "a.gcode");
}

}  // namespace

TEST_CASE("a plan of stacks counts through them, and each begins at the bed", "[layers]") {
    const LayerPlan low(12, 0.25), high({{1, 0.3}, {20, 0.2}});
    const LayerPlan all = LayerPlan::stacked({low, high, low});
    CHECK(all.count() == 45);
    CHECK(all.stacks() == 3);
    CHECK(all.total() == Approx(4.3));
    CHECK(all.least_height() == 0.2);
    CHECK(all.greatest_height() == 0.3);
    CHECK_FALSE(all == LayerPlan({{12, 0.25}, {1, 0.3}, {20, 0.2}, {12, 0.25}}));
    for (int i = 0; i < all.count(); ++i) {
        const int stack = i < 12 ? 0 : i < 33 ? 1 : 2, first = stack == 0 ? 0 : stack == 1 ? 12 : 33;
        const LayerPlan& own = stack == 1 ? high : low;
        INFO(i);
        CHECK(all.stack_of(i) == stack);
        CHECK(all.first_of_stack(stack) == first);
        CHECK(all.bottom(i) == own.bottom(i - first));
        CHECK(all.top(i) == own.top(i - first));
        CHECK(all.height(i) == own.height(i - first));
    }
    CHECK(all.first_of_stack(3) == 45);
    CHECK(all.layer_at(2.9) == 11);
    CHECK(all.layer_at(100) == 11);
    CHECK(all.layer_at(-1) == 0);
    CHECK(LayerPlan::stacked({low}) == low);
}

TEST_CASE("each part is printed whole, the lowest first", "[gcode][plate]") {
    const Job job = three_blocks();
    REQUIRE(job.objects.size() == 3);
    CHECK(job.objects[0].name.starts_with("low"));
    CHECK(job.layers.count() == 72);
    const dvec2 shift =
        dvec2(printer().filament.bed_x, printer().filament.bed_y) * 0.5 - dvec2(job.bounds.center());
    std::map<std::size_t, std::pair<int, int>> layers;  // by part
    std::map<std::size_t, double> volumes;
    const double section = pi / 4 * printer().filament.filament * printer().filament.filament;
    for (const PlaneMove& move : plane_moves(written(job))) {
        if (move.filament <= 0 || move.layer < 0) continue;
        std::size_t part = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            const Rect around = grown(job.objects[k].covers, 8);
            const dvec2 p = move.to - shift;
            if (p.x > around.lo.x && p.y > around.lo.y && p.x < around.hi.x && p.y < around.hi.y) part = k;
        }
        REQUIRE(part < 3);
        layers.try_emplace(part, move.layer, move.layer);
        layers[part].second = move.layer;
        if (move.role != "Skirt/Brim") volumes[part] += move.filament * section;
        const LayerPlan& plan = job.layers;
        CHECK(move.z == Approx(plan.top(move.layer)));
    }
    CHECK(layers[0] == std::pair(0, 11));
    CHECK(layers[1] == std::pair(12, 41));
    CHECK(layers[2] == std::pair(42, 71));
    CHECK(volumes[0] == Approx(14 * 8 * 3).epsilon(0.002));
    CHECK(volumes[1] == Approx(10 * 10 * 6).epsilon(0.002));
    CHECK(volumes[2] == Approx(10 * 10 * 6).epsilon(0.002));
}

TEST_CASE("the nozzle passes parts that are done above them", "[gcode][plate]") {
    const Job job = three_blocks();
    const dvec2 shift =
        dvec2(printer().filament.bed_x, printer().filament.bed_y) * 0.5 - dvec2(job.bounds.center());
    for (const PlaneMove& move : plane_moves(written(job))) {
        for (std::size_t done = 0; done < 3; ++done) {
            if (move.layer < job.layers.first_of_stack(static_cast<int>(done) + 1)) continue;
            const double top = job.objects[done].part->bounds().hi.z;
            for (int i = 0; i <= 100; ++i) {
                const dvec2 p = move.from + (move.to - move.from) * (i / 100.0) - shift;
                const Rect covers = job.objects[done].covers;
                if (p.x < covers.lo.x || p.y < covers.lo.y || p.x > covers.hi.x || p.y > covers.hi.y)
                    continue;
                CHECK(move.z >= top - 1e-9);
            }
        }
    }
}

TEST_CASE("one by one gives the same bytes by any number of threads, and resumed", "[gcode][plate]") {
    const Job job = three_blocks();
    const std::string text = written(job);
    CHECK(written(job, 4) == text);
    const TemporaryFolder folder;
    const LayerRange all{0, job.layers.count()};
    for (const int stop : {5, 12, 50}) {
        const std::string path = folder / (std::to_string(stop) + ".gcode");
        run_layers(job, *make_gcode(printer(), path, false), all, false, stop);
        run_layers(job, *make_gcode(printer(), path, false), all, true);
        CHECK(read_text(path) == text);
    }
}

TEST_CASE("what cannot be printed one by one says so", "[gcode][plate]") {
    PrinterProfile low = printer();
    low.gcode.gantry_height = 5;
    const TemporaryFolder folder;
    const Job job = three_blocks();
    CHECK_THROWS_WITH(make_gcode(low, folder / "a.gcode", false)->open(job, {0, 72}, false),
                      Catch::Contains("6.00 mm high") && Catch::Contains("5.00 mm above the bed"));
    CHECK_THROWS_WITH(check_range(job, {0, 72}), Catch::Contains("takes layers of the whole plate"));
}

}  // namespace one_by_one_test
