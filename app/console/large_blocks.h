// Memory for large arrays, apart from the heap of small things.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <utility>

namespace lamella {

/// Arrays of a layer come and go; what a cache keeps among them is small and stays. In one heap the small
/// pins the holes that the large leave, and memory grows with the number of layers although what is in use
/// does not. Here large blocks stand in pages of their own: the best fitting hole serves a request,
/// neighbouring holes become one, and pages stay for the next layer. All functions may be called from any
/// thread.
class LargeBlocks {
  public:
    /// Bytes from which a block is large: a page.
    static constexpr std::size_t min_bytes = 4096;

    /// Takes addresses for `room` bytes, memory only as blocks need it.
    explicit LargeBlocks(std::size_t room);
    ~LargeBlocks();
    LargeBlocks(const LargeBlocks&) = delete;
    LargeBlocks& operator=(const LargeBlocks&) = delete;

    /// A block at the start of a page, or nullptr where neither room nor memory is left. Throws
    /// std::bad_alloc when there is no memory to note a block.
    void* allocate(std::size_t bytes);

    bool owns(const void* block) const noexcept {
        const auto* at = static_cast<const std::byte*>(block);
        return base_ != nullptr && at >= base_ && at < base_ + room_;
    }

    /// Of a block that `allocate` gave.
    void free(void* block) noexcept;

    /// Bytes from the first page to the end of the last block: what all blocks and holes take.
    std::size_t reach() const;

  private:
    using Sizes = std::set<std::pair<std::size_t, std::size_t>>;  ///< bytes and offset, both whole pages
    struct Extent {
        std::size_t bytes = 0;
        Sizes::node_type size{};  ///< of a block, to be its hole's
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
    std::size_t usable_ = 0;  ///< bytes from the base that may be read and written
    std::size_t reach_ = 0;
    Extents used_;
    Extents holes_;  ///< no two touch
    Sizes sizes_;    ///< of the holes
};

}  // namespace lamella
