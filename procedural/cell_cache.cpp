// The hash of a place.
#include "procedural/cell_cache.h"

#include "procedural/counter_hash.h"

namespace lamella {

std::size_t hash_value(const PlaceKey& key) {
    const auto part = static_cast<std::uint64_t>(key.part);
    return static_cast<std::size_t>(CounterHash(part, key.level, key.x, key.y, key.z).bits(0));
}

}  // namespace lamella
