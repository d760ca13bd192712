// Bounds-checked copies between values and bytes.
#include "engine/base/archive.h"

#include <algorithm>
#include <cstring>

namespace lamella {

void Archive::raw(void* data, std::size_t size) {
    if (!unpacks_) {
        bytes_.append(static_cast<const char*>(data), size);
        return;
    }
    if (size > bytes_.size() - at_) throw too_short();
    std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
}

void check_row_starts(std::span<const std::uint32_t> starts, std::size_t items) {
    if (starts.empty() || starts.front() != 0 || starts.back() != items || !std::ranges::is_sorted(starts))
        throw FaultError("a layer's parcel has rows that begin nowhere");
}

}  // namespace lamella
