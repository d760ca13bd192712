// Windows of flat sheets against indices, and their frames.
#include "procedural/texture/site_windows.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

namespace site_windows_test {

using namespace lamella;

TEST_CASE("the windows of a flat sheet are its squares, across the borders", "[texture]") {
    constexpr int width = 14, height = 11;
    const SurfaceSites sites = flat_sites(width, height, 0.3);
    for (const int size : {3, 7, 9, 11}) {
        const SiteWindows windows = site_windows(sites, size);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto window = windows.of(static_cast<std::size_t>(y * width + x));
                for (int up = -size / 2; up <= size / 2; ++up) {
                    for (int across = -size / 2; across <= size / 2; ++across) {
                        const int column = (x + across + width) % width, row = (y + up + height) % height;
                        REQUIRE(window[windows.place(across, up)] ==
                                static_cast<std::uint32_t>(row * width + column));
                    }
                }
            }
        }
    }
}

TEST_CASE("windows follow the tangents of their sites", "[texture]") {
    constexpr int size = 12;
    SurfaceSites sites = flat_sites(size, size, 1);
    // A quarter turn: what was to the right is above.
    for (dvec3& tangent : sites.tangents) tangent = {0, 1, 0};
    const SiteWindows windows = site_windows(sites, 5);
    CHECK(windows.of(5 * size + 5)[windows.place(2, 0)] == 7 * size + 5);
    CHECK(windows.of(5 * size + 5)[windows.place(0, 1)] == 5 * size + 4);
    // One frame that is turned counts for its own window alone.
    sites.tangents.assign(sites.size(), dvec3(1, 0, 0));
    sites.tangents[5 * size + 6] = {0, -1, 0};
    const SiteWindows mixed = site_windows(sites, 7);
    CHECK(mixed.of(5 * size + 4)[mixed.place(3, 1)] == 6 * size + 7);
    CHECK(mixed.of(5 * size + 6)[mixed.place(1, 0)] == 4 * size + 6);
}

TEST_CASE("sheets and windows that make no sense are refused", "[texture]") {
    CHECK_THROWS_AS(flat_sites(2, 10, 1), InputError);
    const SurfaceSites sites = flat_sites(10, 10, 1);
    for (const int size : {1, 4, 13}) CHECK_THROWS_AS(site_windows(sites, size), InputError);
}

}  // namespace site_windows_test
