// Best-fit allocation of page extents in one address range.
#include "app/console/large_blocks.h"

#include <sys/mman.h>

#include <algorithm>
#include <iterator>

namespace lamella {

namespace {

constexpr std::size_t page_bytes = 4096;
constexpr std::size_t growth_bytes = std::size_t{1} << 20;
// Holes of this size return their memory to the system: they are left by reading a mesh, not by finishing a
// layer.
constexpr std::size_t given_back_bytes = std::size_t{16} << 20;

std::size_t rounded_up(std::size_t bytes, std::size_t step) { return (bytes + step - 1) / step * step; }

}  // namespace

LargeBlocks::LargeBlocks(std::size_t room) : room_(rounded_up(room, growth_bytes)) {
    void* range = mmap(nullptr, room_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (range != MAP_FAILED) base_ = static_cast<std::byte*>(range);
}

LargeBlocks::~LargeBlocks() {
    if (base_ != nullptr) munmap(base_, room_);
}

// Returns the lowest of the smallest holes that are large enough.
LargeBlocks::Extents::iterator LargeBlocks::best_hole(std::size_t bytes) {
    const auto best = sizes_.lower_bound({bytes, 0});
    return best == sizes_.end() ? holes_.end() : holes_.find(best->second);
}

// Extends the last hole, or adds a new one, to `bytes`. Returns false when there is no space or memory.
bool LargeBlocks::grow(std::size_t bytes) {
    const auto last = holes_.empty() ? holes_.end() : std::prev(holes_.end());
    const bool ends_in_hole = last != holes_.end() && last->first + last->second.bytes == reach_;
    const std::size_t start = ends_in_hole ? last->first : reach_;
    if (bytes > room_ - start) return false;
    const std::size_t end = start + bytes;
    if (end > usable_) {
        const std::size_t wanted = rounded_up(end, growth_bytes);
        if (mprotect(base_ + usable_, wanted - usable_, PROT_READ | PROT_WRITE) != 0) return false;
        usable_ = wanted;
    }
    if (ends_in_hole) {
        resize(last, bytes);
    } else {
        const auto size = sizes_.emplace(bytes, start).first;
        try {
            holes_[start].bytes = bytes;
        } catch (...) {
            sizes_.erase(size);
            throw;
        }
    }
    reach_ = end;
    return true;
}

void* LargeBlocks::allocate(std::size_t bytes) {
    if (base_ == nullptr || bytes > room_) return nullptr;
    const std::size_t taken = rounded_up(std::max<std::size_t>(bytes, 1), page_bytes);
    const std::lock_guard lock(mutex_);
    auto hole = best_hole(taken);
    if (hole == holes_.end()) {
        if (!grow(taken)) return nullptr;
        hole = std::prev(holes_.end());
    }
    if (hole->second.bytes > taken) shorten(hole, taken);
    hole->second.size = sizes_.extract({taken, hole->first});
    return base_ + used_.insert(holes_.extract(hole)).position->first;
}

// Shortens a hole to `bytes`; the rest becomes a hole of its own.
void LargeBlocks::shorten(Extents::iterator hole, std::size_t bytes) {
    const std::size_t offset = hole->first + bytes, rest = hole->second.bytes - bytes;
    const auto size = sizes_.emplace(rest, offset).first;
    try {
        holes_.emplace_hint(std::next(hole), offset, Extent{rest});
    } catch (...) {
        sizes_.erase(size);
        throw;
    }
    resize(hole, bytes);
}

void LargeBlocks::resize(Extents::iterator hole, std::size_t bytes) noexcept {
    auto size = sizes_.extract({hole->second.bytes, hole->first});
    hole->second.bytes = size.value().first = bytes;
    sizes_.insert(std::move(size));
}

// Moves nodes between the maps, so that freeing never allocates.
void LargeBlocks::free(void* block) noexcept {
    const std::lock_guard lock(mutex_);
    const auto offset = static_cast<std::size_t>(static_cast<std::byte*>(block) - base_);
    auto hole = holes_.insert(used_.extract(offset)).position;
    Sizes::node_type size = std::move(hole->second.size);
    sizes_.insert(std::move(size));
    join_next(hole);
    if (hole != holes_.begin()) hole = join_next(std::prev(hole));
    const std::size_t bytes = hole->second.bytes;
    if (bytes >= given_back_bytes) madvise(base_ + hole->first, bytes, MADV_DONTNEED);
}

// Merges a hole with the next one if they are adjacent. Returns the merged hole, or else the next one.
LargeBlocks::Extents::iterator LargeBlocks::join_next(Extents::iterator hole) noexcept {
    const auto next = std::next(hole);
    if (next == holes_.end() || hole->first + hole->second.bytes != next->first) return next;
    const std::size_t bytes = hole->second.bytes + next->second.bytes;
    sizes_.erase({next->second.bytes, next->first});
    holes_.erase(next);
    resize(hole, bytes);
    return hole;
}

std::size_t LargeBlocks::reach() const {
    const std::lock_guard lock(mutex_);
    return reach_;
}

}  // namespace lamella
