// Samples are packed as planes of bytes, 64 KiB at a time.
#include "procedural/volume/brick_file.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/base/complete_file.h"
#include "engine/base/error.h"
#include "procedural/volume/packed_reader.h"
#include "procedural/volume/volume.h"
#include "procedural/volume/zlib_writer.h"

namespace lamella {

namespace {

constexpr PackedMagic brick_magic{"lamella bricks1"};
constexpr std::size_t block = std::size_t{1} << 16U;

/// What the packed part begins with.
struct BrickHeader {
    std::array<std::uint32_t, 3> size{};
    std::array<double, 6> corners{};
};

/// Calls visit(begin, end) for the samples of one block after the other.
template <class Visit>
void for_each_block(std::size_t count, const Visit& visit) {
    for (std::size_t begin = 0; begin < count; begin += block) visit(begin, std::min(begin + block, count));
}

void write_samples(ZlibWriter& out, std::span<const float> samples) {
    std::vector<std::uint8_t> bytes;
    for (unsigned shift = 0; shift < 32; shift += 8) {
        for_each_block(samples.size(), [&](std::size_t begin, std::size_t end) {
            bytes.clear();
            for (std::size_t i = begin; i < end; ++i) {
                const auto bits = std::bit_cast<std::uint32_t>(samples[i]);
                bytes.push_back(static_cast<std::uint8_t>(bits >> shift & 255U));
            }
            out.write(bytes);
        });
    }
}

std::vector<float> read_samples(PackedReader& in, std::size_t count) {
    std::vector<float> samples(count);
    std::vector<std::uint8_t> bytes(std::min(count, block));
    for (unsigned shift = 0; shift < 32; shift += 8) {
        for_each_block(count, [&](std::size_t begin, std::size_t end) {
            in.take(bytes.data(), end - begin);
            for (std::size_t i = begin; i < end; ++i) {
                const auto bits = std::bit_cast<std::uint32_t>(samples[i]);
                samples[i] = std::bit_cast<float>(bits | std::uint32_t{bytes[i - begin]} << shift);
            }
        });
    }
    return samples;
}

}  // namespace

void write_bricks(const std::filesystem::path& file, const DensityBricks& bricks) {
    write_complete_file(file, [&](std::ostream& out) {
        BrickHeader header;
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            header.size[axis] = static_cast<std::uint32_t>(bricks.size()[axis]);
            header.corners[axis] = bricks.box().lo[i];
            header.corners[axis + 3] = bricks.box().hi[i];
        }
        out.write(brick_magic.data(), brick_magic.size());
        ZlibWriter packed(out);
        packed.write_number(header.size);
        packed.write_number(header.corners);
        packed.write(bricks.whole());
        write_samples(packed, bricks.samples());
        packed.finish();
    });
}

DensityBricks read_bricks(std::istream& in, const std::string& name) {
    PackedReader packed(in, name, brick_magic, "density bricks");
    BrickHeader header;
    packed.take(&header.size, 1);
    packed.take(&header.corners, 1);
    const VoxelIndex size{header.size[0], header.size[1], header.size[2]};
    if (std::ranges::count(size, 0U) > 0) throw InputError(name + ": a side of the volume has no voxels");
    check_volume_size(size, sizeof(float), name);
    const VoxelIndex counts = DensityBricks::brick_counts(size);
    packed.check_length(counts[0] * counts[1] * counts[2]);
    std::vector<std::uint8_t> whole(counts[0] * counts[1] * counts[2]);
    packed.take(whole.data(), whole.size());
    if (std::ranges::any_of(whole, [](std::uint8_t is_whole) { return is_whole > 1; }))
        throw InputError(name + ": a brick has neither one sample nor all of them");
    const std::size_t kept = DensityBricks::kept_samples(size, whole);
    packed.check_length(kept * sizeof(float));
    std::vector<float> samples = read_samples(packed, kept);
    packed.finish();
    const auto& c = header.corners;
    const Box box{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}};
    try {
        return {size, box, whole, std::move(samples)};
    } catch (const InputError& error) {
        throw InputError(name + ": " + error.what());
    }
}

}  // namespace lamella
