// Archives of stored files are whole for another reader, however they came about.
#include "printers/archive/stored_zip.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "engine/base/error.h"
#include "tests/printers/archive/read_zip.h"
#include "tests/printers/common/plane_solids.h"

namespace stored_zip_test {

using namespace lamella;
using namespace lamella::test;
namespace fs = std::filesystem;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

Files random_files(int count) {
    std::mt19937 random(7);
    Files files;
    for (int k = 0; k < count; ++k) {
        std::string bytes(random() % 3000, '\0');
        for (char& c : bytes) c = static_cast<char>(random());
        files.emplace_back("file" + std::to_string(k) + ".bin", bytes);
    }
    return files;
}

std::string archive_of(const Files& files) {
    StoredZip zip;
    std::string bytes;
    for (const auto& [name, file] : files) bytes += zip.entry(name, file);
    CHECK(zip.size() == bytes.size());
    return bytes + zip.directory();
}

}  // namespace

TEST_CASE("another program reads stored files back", "[stored_zip]") {
    const TemporaryFolder folder;
    const Files files = random_files(40);
    write_text(folder / "a.zip", archive_of(files));
    CHECK(read_zip(folder / "a.zip") == files);
}

TEST_CASE("an archive that was taken up ends like one made in one go", "[stored_zip]") {
    const TemporaryFolder folder;
    const Files files = random_files(20);
    StoredZip first;
    std::string begun;
    for (std::size_t k = 0; k < 9; ++k) begun += first.entry(files[k].first, files[k].second);
    // What was written of the tenth file when the run was stopped is cut off by whoever takes it up.
    write_text(folder / "begun", begun + first.entry(files[9].first, files[9].second).substr(0, 50));
    StoredZip second;
    second.take_up(folder / "begun", begun.size());
    std::string rest;
    for (std::size_t k = 9; k < files.size(); ++k) rest += second.entry(files[k].first, files[k].second);
    CHECK(begun + rest + second.directory() == archive_of(files));
}

TEST_CASE("what is no archive begun here is not taken up", "[stored_zip]") {
    const TemporaryFolder folder;
    StoredZip zip;
    const std::string good = zip.entry("a", "hello") + zip.entry("b", "world");
    const auto taken = [&](const std::string& bytes, std::uint64_t size) {
        write_text(folder / "x", bytes);
        StoredZip other;
        other.take_up(folder / "x", size);
    };
    CHECK_NOTHROW(taken(good, good.size()));
    CHECK_NOTHROW(taken("", 0));
    CHECK_THROWS_AS(taken(good, good.size() - 1), InputError);
    CHECK_THROWS_AS(taken(good, good.size() + 1), InputError);
    CHECK_THROWS_AS(taken("nonsense that goes on for longer than a header", 40), InputError);
    std::string bad = good;
    bad[26] = '\xff';  // a name of 255 bytes
    CHECK_THROWS_AS(taken(bad, bad.size()), InputError);
    StoredZip none;
    CHECK_THROWS_AS(none.take_up(folder / "missing", 10), InputError);
}

TEST_CASE("more files than the plain format counts are all found", "[stored_zip]") {
    const TemporaryFolder folder;
    StoredZip zip;
    std::string bytes;
    constexpr int count = 66000;
    for (int k = 0; k < count; ++k) bytes += zip.entry(std::to_string(k), "x");
    write_text(folder / "many.zip", bytes + zip.directory());
    const auto entries = read_zip(folder / "many.zip");
    REQUIRE(entries.size() == count);
    CHECK(entries.back() == std::pair<std::string, std::string>("65999", "x"));
}

TEST_CASE("files beyond 4 GiB are found", "[stored_zip]") {
    const TemporaryFolder folder;
    const std::string path = folder / "large.zip";
    constexpr std::uint64_t hole = std::uint64_t{5} << 30U;
    // The archive's beginning is a hole of the file: the directory does not mention it.
    const ZipEntry entry{"far", hole, 5, 5, 0x3610a686U};  // CRC-32 of "hello"
    std::string bytes;
    put_local_header(bytes, entry, ZipMethod::stored);
    bytes += "hello";
    put_directory(bytes, {&entry, 1}, hole + bytes.size(), ZipMethod::stored);
    write_text(path, "");
    fs::resize_file(path, hole);
    std::ofstream(path, std::ios::binary | std::ios::app) << bytes;
    CHECK(read_zip(path) == Files{{"far", "hello"}});
}

}  // namespace stored_zip_test
