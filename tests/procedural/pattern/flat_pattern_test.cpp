// Sheets against rasters of their own: one piece, least widths, tiles, shares.
#include "procedural/pattern/flat_pattern.h"

#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "procedural/skin/raster.h"
#include "tests/app/commands/mentions.h"
#include "tests/procedural/texture/sheets.h"

namespace flat_pattern_test {

using namespace sheets;

namespace {

Volume picture(const std::string& name) {
    return read_picture(std::string(LAMELLA_SOURCE_DIR "/examples/inputs/") + name);
}

/// Returns what is solid of a sheet, or void, at `pixels` a mm.
TiledMask raster(const FlatPattern& sheet, double pixels, bool solid) {
    TiledMask mask(static_cast<int>(std::lround(sheet.size().x * pixels)),
                   static_cast<int>(std::lround(sheet.size().y * pixels)));
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x) {
            const dvec2 at = sheet.size() * dvec2(x + 0.5, y + 0.5) / dvec2(mask.width, mask.height);
            mask.marked[mask.index(x, y)] = (sheet.distance(at) > 0) == solid ? 1 : 0;
        }
    }
    return mask;
}

/// Returns the share of a mask that is more than a tenth of this diameter (px) away from all discs of the
/// diameter inside it.
double lost_by_opening(const TiledMask& mask, double diameter) {
    TiledMask outside = mask, deep = mask;
    for (std::uint8_t& marked : outside.marked) marked = marked == 0 ? 1 : 0;
    const std::vector<std::int64_t> depth = squared_distances(outside);
    const double radius = 0.5 * diameter;
    for (std::size_t i = 0; i < deep.marked.size(); ++i)
        deep.marked[i] = static_cast<double>(depth[i]) > radius * radius ? 1 : 0;
    const std::vector<std::int64_t> from_deep = squared_distances(deep);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < mask.marked.size(); ++i)
        lost += mask.marked[i] != 0 && std::sqrt(static_cast<double>(from_deep[i])) > radius + 0.1 * diameter
                    ? 1
                    : 0;
    return static_cast<double>(lost) / static_cast<double>(mask.count());
}

}  // namespace

TEST_CASE("sheets of all examples are one piece with struts as wide as asked", "[texture]") {
    struct Case {
        const char* file;
        double size;
        bool invert;
    };
    for (const Case& tried :
         {Case{"blobs.png", 24, false}, Case{"net.png", 30, false}, Case{"net.png", 36, true},
          Case{"waves.png", 20, false}, Case{"spots.png", 20, true}, Case{"bricks.png", 40, false}}) {
        CAPTURE(tried.file, tried.invert);
        ExampleSettings settings;
        settings.size = tried.size;
        settings.invert = tried.invert;
        const FlatPattern sheet(picture(tried.file), {30, 25}, settings);
        CHECK(sheet.size().x == Approx(30));
        CHECK(std::abs(sheet.size().y - 25) < 4 * sheet.spacing());
        const TiledMask solid = raster(sheet, 20, true);
        CHECK(components_of(solid).size() == 1);
        constexpr double slack = 0.9;
        CHECK(lost_by_opening(solid, slack * 0.8 * 20) == 0);
        const double share = static_cast<double>(solid.count()) / static_cast<double>(solid.marked.size());
        CHECK(share == Approx(sheet.pattern().printed.share).margin(0.01));
        // Struts that join pieces are added.
        CHECK(share > 0.95 * sheet.wanted_share());
        if (sheet.pattern().joins < 20) CHECK(share < 1.05 * sheet.wanted_share());
    }
}

TEST_CASE("gaps are as wide as asked, too", "[texture]") {
    ExampleSettings settings;
    settings.size = 40;
    settings.gap = 0.6;
    const FlatPattern sheet(picture("bricks.png"), {40, 30}, settings);
    // Struts have precedence: near bridges, gaps may be narrower.
    CHECK(lost_by_opening(raster(sheet, 20, false), 0.9 * 0.6 * 20) < 0.03);
}

TEST_CASE("a sheet's value is a bound of the distance", "[texture]") {
    ExampleSettings settings;
    settings.size = 20;
    const FlatPattern sheet(picture("blobs.png"), {20, 20}, settings);
    for (double x = -1; x < 21; x += 0.37) {
        for (double y = -1; y < 21; y += 0.05)
            CHECK(std::abs(sheet.value({x, y + 0.05, 0}) - sheet.value({x, y, 0})) <= 0.05 * (1 + 1e-9));
    }
    // It repeats beyond its borders.
    CHECK(sheet.distance({1.3, 2.4}) == Approx(sheet.distance({21.3, 2.4 - sheet.size().y})).margin(1e-6));
}

TEST_CASE("pictures that cannot be an example are refused", "[texture]") {
    const auto told = [](const std::string& file, dvec2 sheet,
                         const ExampleSettings& settings) -> std::string {
        try {
            const FlatPattern made(picture(file), sheet, settings);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(mentions(told("blobs.png", {20, 20}, {.threshold = 0}), "the picture is all void"));
    CHECK(mentions(told("blobs.png", {20, 20}, {.size = 4}), "and 27 along each side are needed"));
    CHECK(mentions(told("blobs.png", {4, 20}, {}), "accepted: at least 27 along each side"));
    CHECK(mentions(told("blobs.png", {4000, 4000}, {}), "accepted: at least 27 along each side"));
    CHECK(mentions(told("blobs.png", {20, 20}, {.strut = -1}), "expected positive"));
    CHECK(mentions(told("blobs.png", {20, 20}, {.threshold = 1.5}), "a threshold of 1.5"));
}

}  // namespace flat_pattern_test
