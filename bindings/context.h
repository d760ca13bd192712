// Helpers at the border between C and C++: exceptions become statuses; structs are copied up to their size.
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

/// A wrong use of the interface: a null pointer, an invalid size or number.
class BadCall : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

/// Stores the message of the exception in flight in the context, and returns its status.
std::int32_t keep_failure(lamella_context& context) noexcept;

/// Runs the body of a call; turns exceptions into statuses.
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

/// Dereferences a pointer of the caller's. Throws BadCall for null.
template <typename T>
T& wanted(T* pointer, const char* what) {
    if (pointer == nullptr) throw BadCall(std::string(what) + " is a null pointer");
    return *pointer;
}

/// Copies the caller's struct; members that the caller's version of it lacks become zero. Throws BadCall for
/// a null pointer, a struct_size that is not set, and nonzero members that this version of the library does
/// not have.
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

/// As `taken`, but returns a struct with all defaults for null.
template <typename Struct>
Struct taken_or_usual(const Struct* given, const char* what) {
    if (given != nullptr) return taken(given, what);
    Struct usual{};
    usual.struct_size = sizeof(Struct);
    return usual;
}

/// Fills in the caller's struct up to its struct_size. Throws BadCall for a null pointer and a struct_size
/// that is not set.
template <typename Struct>
void hand_out(Struct* to, Struct value, const char* what) {
    const std::size_t size = wanted(to, what).struct_size;
    if (size < sizeof(to->struct_size)) throw BadCall(std::string(what) + ": struct_size is not set");
    value.struct_size = static_cast<std::uint32_t>(size);
    std::memcpy(to, &value, std::min(size, sizeof(Struct)));
}

/// Throws the exception that a callback's status stands for; returns if it is 0.
void check_callback(std::int32_t status, const std::string& what);

}  // namespace lamella
