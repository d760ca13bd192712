// Packs the bricks as they lie in memory.
#include "procedural/pattern/pattern_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"
#include "procedural/volume/packed_reader.h"
#include "procedural/volume/zlib_writer.h"

namespace lamella {

namespace {

constexpr PackedMagic pattern_magic{"lamella pattern"};
constexpr std::int64_t farthest_corner = std::int64_t{1} << 40;

void check_numbers(const SurfaceBricks& bricks, const std::string& name) {
    const auto is_length = [](double v) { return v > 1e-6 && v < 1e6; };
    const auto is_share = [](double v) { return v >= 0 && v <= 1; };
    if (!is_length(bricks.spacing) || !(bricks.unit > 1e-12 && bricks.unit < 1e6) ||
        !(bricks.slope >= 1 && bricks.slope < 1e12) || !is_share(bricks.share) ||
        !is_share(bricks.wanted_share) || !(bricks.softness_before >= 0 && bricks.softness_before < 1e12) ||
        !(bricks.softness >= 0 && bricks.softness < 1e12))
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
        packed.write_number(std::array{bricks.spacing, bricks.unit, bricks.slope, bricks.share,
                                       bricks.wanted_share, bricks.softness_before, bricks.softness});
        packed.write_number(std::array{bricks.pieces, bricks.joins, bricks.bridges, bricks.cut_struts,
                                       bricks.detours, bricks.hanging, bricks.dropped,
                                       std::uint64_t{bricks.bricks.size()}});
        for (const PatternBrick& brick : bricks.bricks)
            packed.write_number(std::array{brick.corner.x, brick.corner.y, brick.corner.z});
        for (const PatternBrick& brick : bricks.bricks) packed.write_number(brick.steps);
        packed.finish();
    });
}

SurfaceBricks read_surface_bricks(std::istream& in, const std::string& name) {
    PackedReader packed(in, name, pattern_magic, "a pattern");
    std::array<double, 7> numbers{};
    std::array<std::uint64_t, 8> counts{};
    packed.take(&numbers, 1);
    packed.take(&counts, 1);
    SurfaceBricks bricks{.spacing = numbers[0],
                         .unit = numbers[1],
                         .slope = numbers[2],
                         .share = numbers[3],
                         .wanted_share = numbers[4],
                         .pieces = counts[0],
                         .joins = counts[1],
                         .bridges = counts[2],
                         .cut_struts = counts[3],
                         .detours = counts[4],
                         .hanging = counts[5],
                         .dropped = counts[6],
                         .softness_before = numbers[5],
                         .softness = numbers[6]};
    check_numbers(bricks, name);
    constexpr std::uint64_t most_bricks = std::uint64_t{1} << 40;
    packed.check_length(std::min(counts[7], most_bricks) * sizeof(PatternBrick::steps));
    // More than memory can hold ends in std::bad_alloc, also where sizes have 32 bits.
    bricks.bricks.resize(
        static_cast<std::size_t>(std::min<std::uint64_t>(counts[7], bricks.bricks.max_size())));
    for (PatternBrick& brick : bricks.bricks) {
        std::array<std::int64_t, 3> corner{};
        packed.take(&corner, 1);
        brick.corner = {corner[0], corner[1], corner[2]};
    }
    check_corners(bricks.bricks, name);
    for (PatternBrick& brick : bricks.bricks) packed.take(&brick.steps, 1);
    packed.finish();
    return bricks;
}

}  // namespace lamella
