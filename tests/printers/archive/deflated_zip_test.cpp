// Archives of pieces compressed one by one are read by others, and go on where they stopped.
#include "printers/archive/deflated_zip.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "engine/base/error.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"

namespace deflated_zip_test {

using namespace lamella;
using namespace lamella::test;

namespace {

std::string lines(int from, int to) {
    std::string text;
    for (int i = from; i < to; ++i) text += "line " + std::to_string(i * i % 977) + "\n";
    return text;
}

std::string pieces_entry(DeflatedZip& zip, const std::string& name, const std::vector<std::string>& texts) {
    std::vector<DeflatedPiece> pieces;
    for (const std::string& text : texts) pieces.push_back(deflate_piece(text));
    return zip.entry(name, pieces);
}

}  // namespace

TEST_CASE("pieces that were compressed apart are one file in the archive", "[zip]") {
    const TemporaryFolder folder;
    DeflatedZip zip;
    std::string noise;
    for (std::uint32_t i = 0, x = 1; i < 300'000; ++i) {
        x = x * 1664525U + 1013904223U;
        noise.push_back(static_cast<char>(x >> 24U));
    }
    std::string bytes =
        pieces_entry(zip, "a/many.txt", {lines(0, 5000), "", lines(5000, 5001), lines(5001, 9000)});
    bytes += pieces_entry(zip, "noise", {noise, noise});
    bytes += pieces_entry(zip, "empty", {});
    bytes += zip.entry("one", "short");
    CHECK(zip.size() == bytes.size());
    CHECK(bytes.size() < lines(0, 9000).size() / 2 + 2 * noise.size() + 2000);
    std::ofstream(folder / "out.zip", std::ios::binary) << bytes << zip.directory();
    const auto entries = read_zip(folder / "out.zip");
    REQUIRE(entries.size() == 4);
    CHECK(entries[0] == std::pair{std::string("a/many.txt"), lines(0, 9000)});
    CHECK(entries[1].second == noise + noise);
    CHECK(entries[2].second.empty());
    CHECK(entries[3].second == "short");
}

TEST_CASE("an archive of pieces is taken up from its bytes", "[zip]") {
    const TemporaryFolder folder;
    DeflatedZip whole;
    std::string bytes = pieces_entry(whole, "first", {lines(0, 300), lines(300, 400)});
    std::ofstream(folder / "out.zip", std::ios::binary) << bytes;
    DeflatedZip again;
    again.take_up(folder / "out.zip", bytes.size());
    CHECK(again.entry("second", "text") == whole.entry("second", "text"));
    CHECK(again.directory() == whole.directory());
    CHECK_THROWS_AS(again.take_up(folder / "out.zip", bytes.size() - 1), InputError);
    CHECK_THROWS_AS(again.take_up(folder / "out.zip", bytes.size() + 40), InputError);
    CHECK_THROWS_AS(again.take_up(folder / "absent.zip", 10), InputError);
    CHECK_THROWS_AS(again.entry("", "text"), FaultError);
    CHECK_THROWS_AS(again.entry(std::string(2000, 'n'), "text"), FaultError);
}

}  // namespace deflated_zip_test
