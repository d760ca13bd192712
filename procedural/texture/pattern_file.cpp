// Packs the bricks as they lie in memory.
#include "procedural/texture/pattern_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"
#include "procedural/volume/gzip_stream.h"
#include "procedural/volume/zlib_writer.h"

namespace lamella {

namespace {

constexpr std::array<char, 16> pattern_magic{"lamella pattern"};
constexpr std::int64_t farthest_corner = std::int64_t{1} << 40;

void take(GzipStream& in, void* out, std::size_t bytes, const std::string& name) {
    if (in.read(static_cast<char*>(out), bytes) < bytes)
        throw InputError(name + ": fewer bricks are there than the header announces");
}

void check_numbers(const SurfaceBricks& bricks, const std::string& name) {
    const auto is_length = [](double v) { return v > 1e-6 && v < 1e6; };
    const auto is_share = [](double v) { return v >= 0 && v <= 1; };
    if (!is_length(bricks.spacing) || !(bricks.unit > 1e-12 && bricks.unit < 1e6) ||
        !(bricks.slope >= 1 && bricks.slope < 1e12) || !is_share(bricks.share) ||
        !is_share(bricks.wanted_share))
        throw InputError(name + ": a number of the pattern is out of range");
}

void check_corners(std::span<const PatternBrick> bricks, const std::string& name) {
    std::unordered_set<glm::i64vec3, LatticeHash> corners;
    for (const PatternBrick& brick : bricks) {
        const glm::i64vec3 c = brick.corner;
        if (std::max({c.x, c.y, c.z}) > farthest_corner || std::min({c.x, c.y, c.z}) < -farthest_corner ||
            !corners.insert(c).second)
            throw InputError(name + ": a brick lies out of range, or is there twice");
    }
}

}  // namespace

void write_surface_bricks(const std::filesystem::path& file, const SurfaceBricks& bricks) {
    write_complete_file(file, [&](std::ostream& out) {
        out.write(pattern_magic.data(), pattern_magic.size());
        ZlibWriter packed(out);
        packed.write_number(
            std::array{bricks.spacing, bricks.unit, bricks.slope, bricks.share, bricks.wanted_share});
        packed.write_number(
            std::array{bricks.pieces, bricks.dropped, bricks.lines, std::uint64_t{bricks.bricks.size()}});
        for (const PatternBrick& brick : bricks.bricks)
            packed.write_number(std::array{brick.corner.x, brick.corner.y, brick.corner.z});
        for (const PatternBrick& brick : bricks.bricks) packed.write_number(brick.steps);
        packed.finish();
    });
}

SurfaceBricks read_surface_bricks(std::istream& in, const std::string& name) {
    std::array<char, pattern_magic.size()> begins{};
    if (!in.read(begins.data(), begins.size()) || begins != pattern_magic)
        throw InputError(name + ": this is no file of a pattern");
    const std::uint64_t most = bytes_left(in, name) * GzipStream::max_packing;
    GzipStream packed(in, name);
    std::array<double, 5> numbers{};
    std::array<std::uint64_t, 4> counts{};
    take(packed, numbers.data(), sizeof numbers, name);
    take(packed, counts.data(), sizeof counts, name);
    SurfaceBricks bricks{.spacing = numbers[0],
                         .unit = numbers[1],
                         .slope = numbers[2],
                         .share = numbers[3],
                         .wanted_share = numbers[4],
                         .pieces = counts[0],
                         .dropped = counts[1],
                         .lines = counts[2],
                         .bricks = {}};
    check_numbers(bricks, name);
    if (counts[3] > most / sizeof(PatternBrick::steps))
        throw InputError(name + ": it is too short for the bricks that it announces");
    bricks.bricks.resize(counts[3]);
    for (PatternBrick& brick : bricks.bricks) {
        std::array<std::int64_t, 3> corner{};
        take(packed, corner.data(), sizeof corner, name);
        brick.corner = {corner[0], corner[1], corner[2]};
    }
    check_corners(bricks.bricks, name);
    for (PatternBrick& brick : bricks.bricks) take(packed, brick.steps.data(), sizeof brick.steps, name);
    char beyond = 0;
    if (packed.read(&beyond, 1) > 0) throw InputError(name + ": more follows after the last brick");
    return bricks;
}

}  // namespace lamella
