// The command's operator new: large blocks from LargeBlocks, the rest from the C library's heap.
#include <cstdlib>
#include <new>

#include "app/console/large_blocks.h"

namespace {

// Address space only, of 2^47 bytes or 2^32 that a process has. What does not fit comes from the heap.
// Emulators of processors keep a table of it: for 64 GiB it takes 400 MB.
constexpr std::size_t room = std::size_t{1} << (sizeof(std::size_t) == 8 ? 36 : 29);

// Never destroyed: blocks are freed until the process ends.
lamella::LargeBlocks& large_blocks() {
    alignas(lamella::LargeBlocks) static std::byte storage[sizeof(lamella::LargeBlocks)];
    static auto* const blocks = new (storage) lamella::LargeBlocks(room);
    return *blocks;
}

}  // namespace

void* operator new(std::size_t bytes) {
    if (bytes >= lamella::LargeBlocks::min_bytes) {
        if (void* block = large_blocks().allocate(bytes)) return block;
    }
    if (void* block = std::malloc(bytes == 0 ? 1 : bytes)) return block;
    throw std::bad_alloc();
}

void operator delete(void* block) noexcept {
    if (large_blocks().owns(block)) {
        large_blocks().free(block);
    } else {
        std::free(block);
    }
}

void operator delete(void* block, std::size_t) noexcept { operator delete(block); }
