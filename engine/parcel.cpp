// Bytes in, bytes out.
#include "engine/parcel.h"

#include <cstring>

namespace lamella {

void Parcel::raw(void* data, std::size_t size) {
    if (!unpacks_) {
        bytes_.append(static_cast<const char*>(data), size);
        return;
    }
    if (size > bytes_.size() - at_) throw too_short();
    std::memcpy(data, bytes_.data() + at_, size);
    at_ += size;
}

}  // namespace lamella
