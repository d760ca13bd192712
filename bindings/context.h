// The border between C and C++: exceptions become statuses, structs are taken by their sizes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "bindings/lamella.h"
#include "engine/base/error.h"

struct lamella_context {
    std::int32_t status = LAMELLA_OK;
    std::string message, path;
    std::int32_t line = 0;
};

namespace lamella {

/// A call that no program should make.
class BadCall : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

/// Keeps what the exception in flight says, and returns its status.
std::int32_t keep_failure(lamella_context& context) noexcept;

/// Runs what a call does.
template <typename Work>
std::int32_t guarded(lamella_context* context, const Work& work) noexcept {
    if (context == nullptr) return LAMELLA_BAD_CALL;
    try {
        work();
        return LAMELLA_OK;
    } catch (...) {
        return keep_failure(*context);
    }
}

/// What a pointer of the caller's points at. Throws BadCall for null.
template <typename T>
T& wanted(T* pointer, const char* what) {
    if (pointer == nullptr) throw BadCall(std::string(what) + " is a null pointer");
    return *pointer;
}

/// The caller's struct as the library knows it: what the caller does not have is zero. Throws BadCall for a
/// null pointer, a size that is none, and members set that the library does not have.
template <typename Struct>
Struct taken(const Struct* given, const char* what) {
    const std::size_t size = wanted(given, what).struct_size;
    if (size < sizeof(given->struct_size)) throw BadCall(std::string(what) + ": struct_size is not set");
    const auto* bytes = reinterpret_cast<const unsigned char*>(given);  // NOLINT: as C has it
    for (std::size_t i = sizeof(Struct); i < size; ++i) {
        if (bytes[i] != 0)
            throw BadCall(std::string(what) + " asks for more than version " LAMELLA_VERSION
                                              " of the library has; accepted: a newer one");
    }
    Struct result{};
    std::memcpy(&result, given, std::min(size, sizeof(Struct)));
    result.struct_size = sizeof(Struct);
    return result;
}

/// The same where null stands for what is usual.
template <typename Struct>
Struct taken_or_usual(const Struct* given, const char* what) {
    if (given != nullptr) return taken(given, what);
    Struct usual{};
    usual.struct_size = sizeof(Struct);
    return usual;
}

/// Fills in as much of the caller's struct as the caller has. Throws BadCall as `taken` does.
template <typename Struct>
void hand_out(Struct* to, Struct value, const char* what) {
    const std::size_t size = wanted(to, what).struct_size;
    if (size < sizeof(to->struct_size)) throw BadCall(std::string(what) + ": struct_size is not set");
    value.struct_size = static_cast<std::uint32_t>(size);
    std::memcpy(to, &value, std::min(size, sizeof(Struct)));
}

/// Throws what a callback's status stands for; nothing for 0.
void check_callback(std::int32_t status, const std::string& what);

}  // namespace lamella
