// Best fit over extents of pages in one range of addresses.
#include "app/large_blocks.h"

#include <sys/mman.h>

#include <algorithm>
#include <iterator>

namespace lamella {

namespace {

constexpr std::size_t page_bytes = 4096;
constexpr std::size_t growth_bytes = std::size_t{1} << 20;
// The memory of a hole of this size is given back: a mesh has been read, not a layer finished.
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

LargeBlocks::Extents::iterator LargeBlocks::best_hole(std::size_t bytes) {
    auto best = holes_.end();
    for (auto hole = holes_.begin(); hole != holes_.end(); ++hole) {
        if (hole->second >= bytes && (best == holes_.end() || hole->second < best->second)) best = hole;
    }
    return best;
}

// Makes the last hole, or a new one, as long as `bytes`.
bool LargeBlocks::grow(std::size_t bytes) {
    const bool ends_in_hole = !holes_.empty() && holes_.rbegin()->first + holes_.rbegin()->second == reach_;
    const std::size_t start = ends_in_hole ? holes_.rbegin()->first : reach_;
    if (bytes > room_ - start) return false;
    const std::size_t end = start + bytes;
    if (end > usable_) {
        const std::size_t wanted = rounded_up(end, growth_bytes);
        if (mprotect(base_ + usable_, wanted - usable_, PROT_READ | PROT_WRITE) != 0) return false;
        usable_ = wanted;
    }
    holes_[start] = bytes;
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
    if (hole->second > taken) holes_.emplace_hint(std::next(hole), hole->first + taken, hole->second - taken);
    hole->second = taken;
    return base_ + used_.insert(holes_.extract(hole)).position->first;
}

// Moves a node between the maps, so that it needs no memory of its own.
void LargeBlocks::free(void* block) noexcept {
    const std::lock_guard lock(mutex_);
    const auto offset = static_cast<std::size_t>(static_cast<std::byte*>(block) - base_);
    auto hole = holes_.insert(used_.extract(offset)).position;
    if (const auto next = std::next(hole);
        next != holes_.end() && hole->first + hole->second == next->first) {
        hole->second += next->second;
        holes_.erase(next);
    }
    if (hole != holes_.begin()) {
        const auto before = std::prev(hole);
        if (before->first + before->second == hole->first) {
            before->second += hole->second;
            holes_.erase(hole);
            hole = before;
        }
    }
    if (hole->second >= given_back_bytes) madvise(base_ + hole->first, hole->second, MADV_DONTNEED);
}

std::size_t LargeBlocks::reach() const {
    const std::lock_guard lock(mutex_);
    return reach_;
}

}  // namespace lamella
