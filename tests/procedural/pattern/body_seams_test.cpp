// Patterns over the edges of a box: as like their pictures there as elsewhere.
#include <catch2/catch.hpp>

#include "engine/solids/primitives.h"
#include "procedural/pattern/surface_pattern.h"

namespace body_seams_test {

using namespace lamella;

namespace {

constexpr int patch = 11, radius = patch / 2;

/// Returns the least share of pixels in which a patch of sites differs from one of the picture: all are
/// tried.
double patch_difference(const SiteWindows& patches, std::size_t site, const std::vector<bool>& solid,
                        const Exemplar& picture) {
    const auto window = patches.of(site);
    int least = patch * patch;
    for (int y = radius; y < picture.solid.height - radius; ++y) {
        for (int x = radius; x < picture.solid.width - radius; ++x) {
            int difference = 0;
            for (int up = -radius; up <= radius && difference < least; ++up) {
                for (int across = -radius; across <= radius; ++across) {
                    const bool wanted = picture.solid.values[picture.solid.index(x + across, y + up)] >= 0.5;
                    difference += solid[window[patches.place(across, up)]] != wanted ? 1 : 0;
                }
            }
            least = std::min(least, difference);
        }
    }
    return static_cast<double>(least) / (patch * patch);
}

}  // namespace

TEST_CASE("a pattern has no seam along the edges of a body", "[pattern]") {
    struct Case {
        const char* file;
        double size;
        bool invert;
    };
    const auto body = make_box({dvec3(0), dvec3(24, 20, 16)});
    double at_edges = 0, elsewhere = 0;
    for (const Case& tried :
         {Case{"blobs.png", 24, false}, Case{"net.png", 30, true}, Case{"bricks.png", 30, false}}) {
        ExampleSettings settings;
        settings.size = tried.size;
        settings.invert = tried.invert;
        const Example example = make_example(
            read_picture(std::string(LAMELLA_SOURCE_DIR "/examples/inputs/") + tried.file), settings);
        const std::vector<PatternLevel> levels = levels_on(*body, example, {.example = settings});
        const auto exemplar = [&](const SurfaceSites& sites, int doublings) {
            return example.exemplar(sites, doublings, settings);
        };
        const SitePattern made = synthesise_levels(levels, exemplar, settings.synthesis).pattern;
        const SurfaceSites& sites = levels.back().sites;
        const Exemplar picture = exemplar(sites, 0);
        const float threshold = threshold_for_share(made, example.share(picture));
        std::vector<bool> solid;
        for (const float distance : made.distance) solid.push_back(distance > threshold);
        const SiteWindows patches = site_windows(sites, patch);
        double sums[2] = {0, 0}, counts[2] = {0, 0};
        for (std::size_t site = 0; site < sites.size(); site += 61) {
            const auto bends = [&](std::uint32_t other) {
                return glm::dot(sites.normals[site], sites.normals[other]) < 0.8;
            };
            const int kind = std::ranges::any_of(patches.of(site), bends) ? 1 : 0;
            sums[kind] += patch_difference(patches, site, solid, picture);
            ++counts[kind];
        }
        CAPTURE(tried.file, counts[0], counts[1], sums[0] / counts[0], sums[1] / counts[1]);
        CHECK(counts[1] > 100);
        elsewhere += sums[0] / counts[0];
        at_edges += sums[1] / counts[1];
    }
    CAPTURE(at_edges, elsewhere);
    CHECK(at_edges < 1.1 * elsewhere);
    CHECK(elsewhere > 0);
}

}  // namespace body_seams_test
