// The lines that masks are made of: which they are, and what is kept of them for others.
#include <catch2/catch.hpp>

#include "engine/layers/layer.h"
#include "engine/layers/survey_rows.h"
#include "engine/solids/csg.h"
#include "engine/solids/primitives.h"
#include "printers/masks/mask.h"
#include "procedural/foam/voronoi_foam.h"

namespace mask_lines_test {

using namespace lamella;

namespace {

Job foam_on_posts() {
    FoamSettings settings;
    settings.cell = 2;
    settings.beam_radius = 0.3;
    settings.region = {{0, 0, 2}, {9, 7, 6}};
    Job job;
    job.part = make_intersection({make_box(settings.region), make_voronoi_foam(settings)});
    job.supports =
        make_union({make_cylinder({2, 2, 0}, {2, 2, 3}, 0.4), make_cylinder({7, 5, 0}, {7, 5, 3}, 0.4)});
    job.bounds = {{0, 0, 0}, {9, 7, 6}};
    job.layers = {60, 0.1};
    return job;
}

ImageProfile display() {
    ImageProfile profile;
    profile.width = 500;
    profile.height = 420;
    profile.pixel_x = profile.pixel_y = 0.025;
    return profile;
}

void draw(const Layer& layer, const ImageProfile& profile) {
    mask_layer(layer, MaskLayout(profile, foam_on_posts().bounds), profile, 1,
               [](std::span<const GreyRun>, int) {});
}

}  // namespace

TEST_CASE("what masks keep of their lines is what those lines give when they are asked for alone", "[mask]") {
    const Job job = foam_on_posts();
    Scratch scratch;
    for (int turn = 0; turn < 8; ++turn) {
        ImageProfile profile = display();
        profile.portrait = turn & 1;
        profile.mirror_x = turn & 2;
        profile.mirror_y = turn & 4;
        for (const auto& [antialiasing, sub_rows] :
             {std::pair{Antialiasing::rows, 4}, {Antialiasing::off, 1}}) {
            profile.antialiasing = antialiasing;
            std::optional<RowBand> lines = mask_lines(profile, job.bounds);
            REQUIRE(lines.has_value());
            CHECK(lines->sub == sub_rows);
            CHECK(lines->lines() == (profile.portrait ? profile.width : profile.height) * sub_rows);
            lines->step = 3;
            for (const int index : {5, 25, 45}) {
                const Layer layer(job, index);
                layer.cache_lines(*lines);
                CHECK(layer.kept_lines(layer.part(), *lines) == nullptr);
                draw(layer, profile);
                for (const SliceField* slice : {&layer.part(), layer.supports()}) {
                    const RunRows* kept = layer.kept_lines(*slice, *lines);
                    REQUIRE(kept != nullptr);
                    CHECK(*kept == all_rows(*slice, *lines, scratch));
                }
                CHECK(layer.kept_lines(layer.part(), *lines)->runs().empty() == (index == 5));
                CHECK(layer.kept_lines(*layer.supports(), *lines)->runs().empty() == (index == 45));
                RowBand others = *lines;
                others.step = 4;
                CHECK(layer.kept_lines(layer.part(), others) == nullptr);
            }
        }
    }
}

TEST_CASE("masks that are made of more than lines keep none", "[mask]") {
    const Job job = foam_on_posts();
    const RowBand lines = *mask_lines(display(), job.bounds);
    for (const bool exact : {true, false}) {
        ImageProfile profile = display();
        profile.antialiasing = exact ? Antialiasing::exact : Antialiasing::rows;
        profile.sub_layers = exact ? 1 : 2;
        CHECK_FALSE(mask_lines(profile, job.bounds).has_value());
        const Layer layer(job, 25);
        layer.cache_lines(lines);
        draw(layer, profile);
        CHECK(layer.kept_lines(layer.part(), lines) == nullptr);
    }
    ImageProfile small = display();
    small.width = 300;
    CHECK_FALSE(mask_lines(small, job.bounds).has_value());
}

}  // namespace mask_lines_test
