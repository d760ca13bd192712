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

/// Packs values into bytes or unpacks them, so that one list of members serves both directions. Numbers keep
/// this machine's byte order and size: exchange archives only between machines of one kind.
class Archive {
  public:
    /// Makes an empty archive, to pack into.
    Archive() = default;
    /// Makes an archive that unpacks these bytes.
    explicit Archive(std::string bytes) : bytes_(std::move(bytes)), unpacks_(true) {}

    bool unpacks() const { return unpacks_; }
    const std::string& bytes() const { return bytes_; }

    /// Packs the members, or sets them to the packed values, in the same order. A member is trivially
    /// copyable, a string, a vector, or has a `serialize` of its own. Throws FaultError when the bytes end
    /// too early.
    template <typename... Members>
    void operator()(Members&... members) {
        (member(members), ...);
    }

    /// Checks that all bytes were unpacked. Throws FaultError otherwise.
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
            // Each item takes at least one byte, which bounds what a damaged count can allocate.
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

/// Checks that `starts` says where rows of `items` items begin: from 0, never falling, ending with `items`.
/// Throws FaultError otherwise.
void check_row_starts(std::span<const std::uint32_t> starts, std::size_t items);

/// Returns the bytes of a message of any type that Archive can pack.
template <typename Message>
std::string packed(Message message) {
    Archive parcel;
    parcel(message);
    return parcel.bytes();
}

/// Returns the message that these bytes hold. Throws FaultError when they do not hold exactly one.
template <typename Message>
Message unpacked(std::string bytes) {
    Archive parcel(std::move(bytes));
    Message message;
    parcel(message);
    parcel.finish();
    return message;
}

}  // namespace lamella
