// Files of bricks: read back, small, and refused when damaged.
#include "procedural/volume/brick_file.h"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"
#include "tests/procedural/volume/clumped_densities.h"
#include "tests/procedural/volume/scratch_folder.h"

namespace brick_file_test {

using namespace lamella;

namespace {

const Box box{{-3, 2, 0.1}, {7, 8, 40}};

std::string bytes_of(const DensityBricks& bricks) {
    const ScratchFolder folder("brick_file");
    write_bricks(folder / "a.bricks", bricks);
    std::ostringstream bytes;
    bytes << std::ifstream(folder / "a.bricks", std::ios::binary).rdbuf();
    return bytes.str();
}

DensityBricks read(const std::string& bytes) {
    std::istringstream in(bytes);
    return read_bricks(in, "a.bricks");
}

std::string complaint(const std::string& bytes) {
    try {
        read(bytes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool same(const DensityBricks& a, const DensityBricks& b) {
    return a.size() == b.size() && a.box().lo == b.box().lo && a.box().hi == b.box().hi &&
           a.whole() == b.whole() && a.samples().size() == b.samples().size() &&
           std::memcmp(a.samples().data(), b.samples().data(), a.samples().size_bytes()) == 0;
}

/// A file written down anew: the magic, and numbers behind it, packed.
class BrickBytes {
  public:
    template <class Number>
    BrickBytes& operator<<(Number number) {
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
        return *this;
    }
    BrickBytes& header(std::uint32_t x, std::uint32_t y, std::uint32_t z, double upper = 1) {
        *this << x << y << z << 0.0 << 0.0 << 0.0;
        return *this << 1.0 << 1.0 << upper;
    }
    std::string file() const {
        uLongf size = compressBound(bytes_.size());
        std::string packed(size, '\0');
        REQUIRE(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                         reinterpret_cast<const Bytef*>(bytes_.data()), bytes_.size()) == Z_OK);
        packed.resize(size);
        return std::string("lamella bricks1\0", 16) + packed;
    }

  private:
    std::string bytes_;
};

}  // namespace

TEST_CASE("bricks that are read are those that were written, to the last bit") {
    unsigned seed = 0;
    for (const VoxelIndex size : {VoxelIndex{1, 1, 1}, {70, 33, 50}, {128, 128, 9}, {9, 17, 1}}) {
        const DensityBricks bricks(size, box, clumped_densities(size, ++seed));
        CHECK(same(read(bytes_of(bricks)), bricks));
    }
    const std::vector<double> odd{0.0,  -0.0, infinity, -infinity, std::numeric_limits<double>::quiet_NaN(),
                                  1e-42};
    const DensityBricks bricks({3, 2, 1}, box, odd);
    CHECK(same(read(bytes_of(bricks)), bricks));
}

TEST_CASE("the bytes of a file are those that its description says") {
    const std::string file =
        (BrickBytes().header(9, 1, 1)
         << std::uint8_t{1} << std::uint8_t{0}  // The lowest bytes of nine samples, then the next ones.
         << std::uint64_t{0} << std::uint8_t{0} << std::uint64_t{0} << std::uint8_t{0}
         << std::uint64_t{0x8000000000000000} << std::uint8_t{0} << std::uint64_t{0x3f00000000000000}
         << std::uint8_t{0x40})
            .file();
    const DensityBricks bricks = read(file);
    CHECK(bricks.size() == VoxelIndex{9, 1, 1});
    CHECK(bricks.box().hi == dvec3(1));
    CHECK(bricks.dense() == std::vector<float>{0, 0, 0, 0, 0, 0, 0, 1, 2});
}

TEST_CASE("a file of mostly full and empty bricks is a small part of its samples") {
    const VoxelIndex size{128, 64, 64};
    const DensityBricks bricks(size, box, clumped_densities(size, 7));
    const std::size_t dense = size[0] * size[1] * size[2] * sizeof(float);
    CHECK(bricks.samples().size_bytes() < dense / 2);
    CHECK(bytes_of(bricks).size() < dense / 8);
}

TEST_CASE("a file that is cut off, goes on or is damaged is refused") {
    const VoxelIndex size{20, 9, 10};
    const DensityBricks bricks(size, box, clumped_densities(size, 8));
    const std::string file = bytes_of(bricks);
    REQUIRE(same(read(file), bricks));
    for (std::size_t length = 0; length < file.size(); ++length) {
        if (complaint(file.substr(0, length)).empty())
            FAIL(length << " bytes of " << file.size() << " are enough");
    }
    CHECK(complaint(file + "x").starts_with("a.bricks: "));
    for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
        std::string damaged = file;
        damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ 1 << bit % 8);
        // Up to seven bits between the last number and the checksum mean nothing.
        if (complaint(damaged).empty() && !same(read(damaged), bricks))
            FAIL("bit " << bit << " does not matter");
    }
}

TEST_CASE("a file that announces what it cannot hold is refused before memory is taken for it") {
    CHECK(complaint("NRRD0004\nand so on") == "a.bricks: this is no file of density bricks");
    CHECK(complaint("") == "a.bricks: this is no file of density bricks");
    const std::string large =
        "a.bricks: the volume is larger than 2,147,483,648 voxels; reduce its resolution";
    CHECK(complaint(BrickBytes().header(~0U, ~0U, ~0U).file()) == large);
    CHECK(complaint(BrickBytes().header(1U << 31U, 2, 1).file()) == large);
    const std::string brief = "a.bricks: it is too short for the bricks that it announces";
    CHECK(complaint(BrickBytes().header(1U << 30U, 1, 1).file()) == brief);
    CHECK(complaint((BrickBytes().header(64, 64, 1) << std::uint64_t{0x0101010101010101}).file()) ==
          "a.bricks: fewer bricks are there than the header announces");
    BrickBytes all;
    all.header(512, 512, 512);
    for (int i = 0; i < 64 * 64 * 64 / 8; ++i) all << std::uint64_t{0x0101010101010101};
    CHECK(complaint(all.file()) == brief);
    CHECK(complaint(BrickBytes().header(0, 1, 1).file()) == "a.bricks: a side of the volume has no voxels");
    CHECK(complaint((BrickBytes().header(1, 1, 1) << std::uint8_t{2} << 1.0F).file()) ==
          "a.bricks: a brick has neither one sample nor all of them");
    CHECK(complaint((BrickBytes().header(1, 1, 1) << std::uint8_t{0} << 1.0F << 'x').file()) ==
          "a.bricks: more follows after the last brick");
    CHECK(complaint((BrickBytes().header(1, 1, 1, 0) << std::uint8_t{0} << 1.0F).file()) ==
          "a.bricks: the box of a volume must have three positive sides, within 1e9 mm of the origin");
    CHECK(complaint((BrickBytes().header(1, 1, 1) << std::uint8_t{0} << 1.0F).file()).empty());
}

}  // namespace brick_file_test
