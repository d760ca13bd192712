// The hash of a key, and the set of recent keys.
#include "procedural/voronoi/cell_cache.h"

#include <bit>
#include <utility>

#include "procedural/voronoi/counter_hash.h"

namespace lamella {

std::uint64_t hash_value(const PlaceKey& key) {
    const auto part = static_cast<std::uint64_t>(key.part);
    return CounterHash(part, key.level, key.x, key.y, key.z).bits(0);
}

void RecentPlaces::make_room(std::size_t slots) {
    if (slots <= slots_.size()) return;
    const auto before = std::exchange(slots_, std::vector<std::uint64_t>(std::bit_ceil(slots)));
    for (const std::uint64_t hash : before) {
        if (hash != 0) slot(hash) = hash;
    }
}

void RecentPlaces::add(const PlaceKey& key) {
    const std::uint64_t hash = hash_value(key);
    slot(hash) = hash;
}

bool RecentPlaces::take(const PlaceKey& key) {
    if (slots_.empty()) return false;
    const std::uint64_t hash = hash_value(key);
    std::uint64_t& here = slot(hash);
    if (hash != here) return false;
    here = 0;
    return true;
}

}  // namespace lamella
