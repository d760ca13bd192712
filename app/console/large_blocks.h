// LargeBlocks: an allocator for large arrays, separate from the heap of small objects.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace lamella {

/// Arrays of a layer are short-lived; small objects that a cache allocates between them live long. In a
/// single heap the small objects fragment the space that freed arrays leave, and memory grows with the number
/// of layers although the memory in use does not. Here large blocks have their own pages: best fit,
/// neighbouring holes are merged, and pages are kept for the next layer. All functions may be called from any
/// thread.
class LargeBlocks {
  public:
    /// Bytes from which a block is large: a page.
    static constexpr std::size_t min_bytes = 4096;

    /// Reserves addresses for `room` bytes; memory is committed as blocks need it.
    explicit LargeBlocks(std::size_t room);
    ~LargeBlocks();
    LargeBlocks(const LargeBlocks&) = delete;
    LargeBlocks& operator=(const LargeBlocks&) = delete;

    /// Returns a block that starts at a page, or nullptr when neither space nor memory is left. Throws
    /// std::bad_alloc when there is no memory for the bookkeeping.
    void* allocate(std::size_t bytes);

    bool owns(const void* block) const noexcept {
        const auto* at = static_cast<const std::byte*>(block);
        return base_ != nullptr && at >= base_ && at < base_ + room_;
    }

    /// Frees a block that `allocate` returned.
    void free(void* block) noexcept;

    /// Returns the bytes from the first page to the end of the last block: the total of all blocks and holes.
    std::size_t reach() const;

  private:
    using Sizes = std::set<std::pair<std::size_t, std::size_t>>;  ///< bytes and offset, both whole pages
    struct Extent {
        std::size_t bytes = 0;
        Sizes::node_type size{};  ///< a block's node, kept for the hole that it becomes
    };
    using Extents = std::map<std::size_t, Extent>;  ///< by offset

    Extents::iterator best_hole(std::size_t bytes);
    bool grow(std::size_t bytes);
    void shorten(Extents::iterator hole, std::size_t bytes);
    void resize(Extents::iterator hole, std::size_t bytes) noexcept;
    Extents::iterator join_next(Extents::iterator hole) noexcept;

    mutable std::mutex mutex_;
    std::byte* base_ = nullptr;
    std::size_t room_ = 0;
    std::size_t usable_ = 0;  ///< committed bytes from the base
    std::size_t reach_ = 0;
    Extents used_;
    Extents holes_;  ///< no two are adjacent
    Sizes sizes_;    ///< of the holes
};

}  // namespace lamella
