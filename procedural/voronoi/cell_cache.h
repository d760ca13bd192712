// CellCache: a bounded, thread-safe cache of values computed per octree node. Evicts by z distance, then by
// age.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "engine/base/geometry.h"

namespace lamella {

/// Identifies a node of an octree over a lattice of coarse cells, and a part of that node.
struct PlaceKey {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
    int level = 0;
    int part = 0;
    friend bool operator==(const PlaceKey&, const PlaceKey&) = default;
};

/// Returns a hash of the key, the same in every process.
std::uint64_t hash_value(const PlaceKey& key);

/// A lossy set of recent keys: a table of hashes without collision resolution, where a newer key replaces an
/// older one in its slot.
class RecentPlaces {
  public:
    /// Grows the table to at least so many slots.
    void make_room(std::size_t slots);
    /// Adds a key. The table must have at least one slot.
    void add(const PlaceKey& key);
    /// Removes a key and returns whether it was there.
    bool take(const PlaceKey& key);

  private:
    std::uint64_t& slot(std::uint64_t hash) {
        return slots_[static_cast<std::size_t>(hash) & (slots_.size() - 1)];
    }

    std::vector<std::uint64_t> slots_;  ///< their number is 0 or a power of two; 0 marks a free slot
};

/// A cache of values by key, shared by all threads. A value is a pure function of its key, so results never
/// depend on the state of the cache: two threads that miss the same key at once compute it twice and keep one
/// copy. No lock is held while a value is computed.
///
/// Value must have `std::size_t bytes() const` (its memory) and `Interval z_extent() const` (the heights that
/// it serves, mm).
///
/// Memory bound: the sum of bytes() never exceeds `capacity` by more than the values being inserted. Below
/// `capacity` a soft limit holds, at least `idle` bytes. Each eviction sets it to twice the memory of the
/// values near the requested height, but no lower than half the limit before, so that a job that proceeds
/// upwards needs no more memory the higher it gets. If most of the values inserted since the last eviction
/// had recently been evicted, as with rays that cross the part in any order, the limit doubles. When the
/// limit is exceeded, the values farthest in z from the last request are evicted first, among those the least
/// recently used, until three quarters of the limit are left. Values still held by callers live on until
/// released.
template <typename Value>
class CellCache {
  public:
    using Pointer = std::shared_ptr<const Value>;

    explicit CellCache(std::size_t capacity) : CellCache(capacity, capacity) {}
    CellCache(std::size_t capacity, std::size_t idle)
        : shard_capacity_(capacity / shard_count), shard_idle_(std::min(idle, capacity) / shard_count) {
        for (Shard& shard : shards_) shard.limit = shard_idle_;
    }

    /// Returns the value at the key, null if it is not cached. `z` is the height for which it is wanted, mm.
    Pointer find(const PlaceKey& key, double z) {
        Shard& shard = shard_of(key);
        const std::lock_guard lock(shard.mutex);
        const auto found = shard.entries.find(key);
        if (found == shard.entries.end()) return nullptr;
        shard.wanted_z = z;
        found->second.used = ++shard.clock;
        return found->second.value;
    }

    /// Inserts a value and returns the cached one (an equal one if another thread was faster).
    Pointer insert(const PlaceKey& key, double z, Pointer value) {
        Shard& shard = shard_of(key);
        const std::lock_guard lock(shard.mutex);
        const auto [entry, fresh] = shard.entries.try_emplace(key);
        shard.wanted_z = z;
        entry->second.used = ++shard.clock;
        if (!fresh) return entry->second.value;
        entry->second.value = value;
        shard.bytes += cost(*value);
        shard.came_back += shard.gone.take(key) ? 1U : 0U;
        ++shard.made;
        if (shard.bytes > shard.limit) evict(shard);
        return value;
    }

    /// Returns the value at the key. If it is not cached, computes it with `make()`, which returns a Value.
    template <typename Make>
    Pointer find_or_make(const PlaceKey& key, double z, const Make& make) {
        if (Pointer held = find(key, z)) return held;
        return insert(key, z, std::make_shared<const Value>(make()));
    }

    /// Returns the memory of all cached values, bytes.
    std::size_t bytes() const {
        std::size_t sum = 0;
        for (Shard& shard : shards_) {
            const std::lock_guard lock(shard.mutex);
            sum += shard.bytes;
        }
        return sum;
    }

  private:
    struct KeyHash {
        std::size_t operator()(const PlaceKey& key) const {
            return static_cast<std::size_t>(hash_value(key));
        }
    };
    struct Entry {
        Pointer value;
        std::uint64_t used = 0;
    };
    // Entries get memory blocks of their own. Scattered between a layer's buffers they would pin the holes
    // that these leave, and memory would grow with the number of layers.
    struct Shard {
        std::mutex mutex;
        std::pmr::unsynchronized_pool_resource nodes{
            {.max_blocks_per_chunk = 64, .largest_required_pool_block = 128}};
        std::pmr::unordered_map<PlaceKey, Entry, KeyHash> entries{&nodes};
        std::size_t bytes = 0;
        std::uint64_t clock = 0;
        double wanted_z = 0;
        std::size_t limit = 0;      ///< bytes
        RecentPlaces gone;          ///< recently evicted and not requested since
        std::size_t made = 0;       ///< inserted since the last eviction
        std::size_t came_back = 0;  ///< how many of `made` had recently been evicted
    };
    static constexpr std::size_t shard_count = 16;
    static constexpr std::size_t remembered = 8;  ///< size of `gone`, per cached value
    // including the map node
    static constexpr std::size_t entry_bytes = sizeof(std::pair<const PlaceKey, Entry>) + 48;

    static std::size_t cost(const Value& value) { return value.bytes() + entry_bytes; }

    Shard& shard_of(const PlaceKey& key) const { return shards_[(hash_value(key) >> 32) % shard_count]; }

    void evict(Shard& shard) {
        struct Candidate {
            double z_distance;
            std::uint64_t used;
            PlaceKey key;
        };
        std::vector<Candidate> candidates;
        candidates.reserve(shard.entries.size());
        std::size_t near = 0;
        for (const auto& [key, entry] : shard.entries) {
            const Interval z = entry.value->z_extent();
            const double distance = std::max({z.lo - shard.wanted_z, shard.wanted_z - z.hi, 0.0});
            if (distance <= z.width()) near += cost(*entry.value);
            candidates.push_back({distance, entry.used, key});
        }
        const bool missed = shard.came_back > shard.made / 2;
        const std::size_t kept = missed ? 2 * shard.limit : shard.limit / 2;
        shard.limit = std::min(shard_capacity_, std::max({shard_idle_, 2 * near, kept}));
        if (shard.bytes <= shard.limit) return;
        std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
            return a.z_distance != b.z_distance ? a.z_distance > b.z_distance : a.used < b.used;
        });
        shard.gone.make_room(remembered * shard.entries.size());
        shard.made = shard.came_back = 0;
        for (const Candidate& candidate : candidates) {
            if (shard.bytes <= shard.limit / 4 * 3) break;
            const auto entry = shard.entries.find(candidate.key);
            shard.bytes -= cost(*entry->second.value);
            shard.entries.erase(entry);
            shard.gone.add(candidate.key);
        }
    }

    std::size_t shard_capacity_, shard_idle_;
    mutable std::array<Shard, shard_count> shards_;
};

}  // namespace lamella
