// Fuzz target: any bytes, read as a shard, end in the products of its layers or in an InputError.
#include <algorithm>

#include "engine/base/error.h"
#include "printers/archive/shard_file.h"
#include "tests/fuzz/scratch_file.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const ShardFile shard(scratch_file("fuzz.shard", data, size));
        const LayerRange range = shard.stamp().range;
        for (int layer = range.first; layer < std::min(range.last, range.first + 4); ++layer)
            shard.layer(layer);
    } catch (const InputError&) {
    }
    return 0;
}
