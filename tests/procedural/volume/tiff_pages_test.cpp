// Chains of TIFF directories written by hand.
#include "procedural/volume/tiff_pages.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "engine/base/error.h"

namespace tiff_pages_test {

using namespace lamella;

namespace {

void put(std::string& out, std::uint64_t value, std::size_t bytes, bool big_endian) {
    for (std::size_t i = 0; i < bytes; ++i) {
        out += static_cast<char>(value >> (8 * (big_endian ? bytes - 1 - i : i)) & 0xffU);
    }
}

/// Directories of two empty entries each, one behind the other; the last one leads to `end`.
std::string chain(std::size_t pages, bool wide, bool big_endian, std::uint64_t end = 0) {
    const std::size_t offset = wide ? 8 : 4, count = wide ? 8 : 2, entry = wide ? 20 : 12;
    const std::size_t length = count + 2 * entry + offset, start = wide ? 16 : 8;
    std::string out = big_endian ? "MM" : "II";
    put(out, wide ? 43 : 42, 2, big_endian);
    if (wide) put(out, 8, 2, big_endian);
    if (wide) put(out, 0, 2, big_endian);
    put(out, pages > 0 ? start : 0, offset, big_endian);
    for (std::size_t i = 0; i < pages; ++i) {
        put(out, 2, count, big_endian);
        out.append(2 * entry, '\0');
        put(out, i + 1 < pages ? start + (i + 1) * length : end, offset, big_endian);
    }
    return out;
}

std::optional<std::size_t> count(const std::string& bytes) {
    std::istringstream in(bytes);
    return count_tiff_pages(in, "a.tif");
}

}  // namespace

TEST_CASE("pages are counted along the chain, in both widths and byte orders") {
    for (const bool wide : {false, true}) {
        for (const bool big_endian : {false, true}) {
            for (const std::size_t pages : {0U, 1U, 7U}) {
                CHECK(count(chain(pages, wide, big_endian)) == pages);
            }
        }
    }
    CHECK(!count(""));
    CHECK(!count("MZ header"));
    CHECK(!count("II\x2b"));
    CHECK(!count("IIabcdefgh"));
}

TEST_CASE("a chain cut off anywhere, or without an end, is refused") {
    for (const bool wide : {false, true}) {
        const std::string whole = chain(3, wide, false);
        for (std::size_t length = 4; length < whole.size(); ++length) {
            CHECK_THROWS_AS(count(whole.substr(0, length)), InputError);
        }
        CHECK_THROWS_AS(count(chain(3, wide, false, wide ? 16 : 8)), InputError);
        CHECK_THROWS_AS(count(chain(3, wide, false, 0xfffffff0U)), InputError);
    }
}

TEST_CASE("pages that together list more strips than the file has bytes are refused") {
    // Each page lists the same empty strips: their offsets and sizes are all zeros.
    const auto shared = [](std::size_t pages, std::uint32_t strips) {
        constexpr std::size_t length = 2 + 2 * 12 + 4, start = 8;
        std::string out = "II";
        put(out, 42, 2, false);
        put(out, start, 4, false);
        for (std::size_t i = 0; i < pages; ++i) {
            put(out, 2, 2, false);
            for (const std::uint64_t tag : {273U, 279U}) {
                put(out, tag, 2, false);
                put(out, 4, 2, false);
                put(out, strips, 4, false);
                put(out, start + pages * length, 4, false);
            }
            put(out, i + 1 < pages ? start + (i + 1) * length : 0, 4, false);
        }
        return out + std::string(4 * strips, '\0');
    };
    CHECK(count(shared(2, 50)) == 2U);
    CHECK_THROWS_WITH(count(shared(1000, 50000)),
                      Catch::Contains("more strips of samples than it has bytes"));
}

TEST_CASE("a long circular chain is refused after one round") {
    // Were it followed for a million pages, this would take minutes.
    constexpr std::uint64_t entries = 60000;
    std::string out = "II";
    put(out, 42, 2, false);
    put(out, 8, 4, false);
    put(out, entries, 2, false);
    out.append(12 * entries, '\0');
    put(out, 8, 4, false);
    CHECK_THROWS_WITH(count(out), Catch::Contains("has no end"));
}

}  // namespace tiff_pages_test
