// Binary archive for sending a rendered layer to another process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/error.h"

namespace lamella {

/// Packs or unpacks, so that one list of members serves for both. Bytes are those of this machine's numbers:
/// parcels are for machines of one kind.
class Archive {
  public:
    /// An empty one, to pack into.
    Archive() = default;
    /// One that was packed, to unpack.
    explicit Archive(std::string bytes) : bytes_(std::move(bytes)), unpacks_(true) {}

    bool unpacks() const { return unpacks_; }
    const std::string& bytes() const { return bytes_; }

    /// Packs the members, or sets them to what was packed, in the same order. A member is plain numbers, a
    /// text, a list, or has a `serialize` of its own. Throws FaultError where the bytes end too early.
    template <typename... Members>
    void operator()(Members&... members) {
        (member(members), ...);
    }

    /// Whether all was unpacked. Throws FaultError where something is left.
    void finish() const {
        if (at_ != bytes_.size()) throw FaultError("a layer's parcel has more in it than was packed");
    }

  private:
    template <typename T>
    void member(T& value) {
        if constexpr (requires { value.serialize(*this); }) {
            value.serialize(*this);
        } else {
            static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
            raw(&value, sizeof value);
        }
    }
    void member(std::string& text) { sequence(text); }
    template <typename T>
    void member(std::vector<T>& list) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            sequence(list);
        } else {
            // Each takes at least a byte, which bounds what a damaged count can ask for.
            resize(list, 1);
            for (T& item : list) item.serialize(*this);
        }
    }

    template <typename Sequence>
    void sequence(Sequence& items) {
        resize(items, sizeof items[0]);
        if (!items.empty()) raw(items.data(), items.size() * sizeof items[0]);
    }
    template <typename Sequence>
    void resize(Sequence& items, std::size_t min_bytes) {
        std::uint64_t count = items.size();
        member(count);
        if (!unpacks_) return;
        if (count > (bytes_.size() - at_) / min_bytes) throw too_short();
        items.resize(static_cast<std::size_t>(count));
    }
    void raw(void* data, std::size_t size);
    static FaultError too_short() { return FaultError("a layer's parcel ends too early"); }

    std::string bytes_;
    std::size_t at_ = 0;
    bool unpacks_ = false;
};

/// Throws FaultError unless `starts` tells where rows of so many items begin: from 0, never falling, to their
/// number.
void check_row_starts(std::span<const std::uint32_t> starts, std::size_t items);

/// Returns the bytes of a message, any type that a parcel takes.
template <typename Message>
std::string packed(Message message) {
    Archive parcel;
    parcel(message);
    return parcel.bytes();
}

/// Returns the message of these bytes. Throws FaultError where they are not of such a message.
template <typename Message>
Message unpacked(std::string bytes) {
    Archive parcel(std::move(bytes));
    Message message;
    parcel(message);
    parcel.finish();
    return message;
}

}  // namespace lamella
