// Pieces of tape archives that join to one.
#include "printers/archive/tar_gzip.h"

#include <zlib.h>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/printers/common/plane_solids.h"

namespace tar_gzip_test {

using namespace lamella;
using namespace lamella::test;

TEST_CASE("gzip members one after another unpack to what they hold one after another", "[tar-gzip]") {
    const TemporaryFolder folder;
    const std::string large(3'000'000, 'x');
    write_text(folder / "a.gz",
               gzip_member("first ") + gzip_member("") + gzip_member(large) + gzip_member(" last"));
    gzFile file = gzopen((folder / "a.gz").c_str(), "rb");
    REQUIRE(file != nullptr);
    std::string all(large.size() + 100, '\0');
    const int got = gzread(file, all.data(), static_cast<unsigned>(all.size()));
    CHECK(gzclose(file) == Z_OK);
    REQUIRE(got > 0);
    all.resize(static_cast<std::size_t>(got));
    CHECK(all == "first " + large + " last");
}

TEST_CASE("members of a tape archive are whole blocks", "[tar-gzip]") {
    for (const std::size_t size : {0U, 1U, 511U, 512U, 513U}) {
        const std::string member = tar_member("name", std::string(size, 'x'));
        CHECK(member.size() == 512 + (size + 511) / 512 * 512);
        CHECK(member.substr(0, 5) == std::string("name\0", 5));
        CHECK(member.substr(257, 8) == std::string("ustar\00000", 8));
    }
    CHECK(tar_end() == std::string(1024, '\0'));
    CHECK(tar_member(std::string(99, 'n'), "").size() == 512);
    CHECK_THROWS_AS(tar_member(std::string(100, 'n'), ""), FaultError);
    CHECK_THROWS_AS(tar_member("", ""), FaultError);
}

}  // namespace tar_gzip_test
