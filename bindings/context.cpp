// Exceptions become statuses; the place in a recipe is read from the beginning of a message.
#include "bindings/context.h"

#include <fmt/format.h>
#include <cctype>

namespace lamella {
namespace {

/// Finds "path:line: " at the beginning of a message.
void find_place(lamella_context& context) {
    context.path.clear();
    context.line = 0;
    const std::string first = context.message.substr(0, context.message.find('\n'));
    for (std::size_t colon = first.find(':'); colon != std::string::npos;
         colon = first.find(':', colon + 1)) {
        const std::size_t begin = colon + 1, end = first.find_first_not_of("0123456789", begin);
        constexpr std::size_t max_digits = 9;
        if (end == std::string::npos || end == begin || end - begin > max_digits || first[end] != ':')
            continue;
        context.path = first.substr(0, colon);
        context.line = std::stoi(first.substr(begin, end - begin));
        return;
    }
}

void keep(lamella_context& context, std::int32_t status, const char* message) noexcept {
    context.status = status;
    try {
        context.message = message;
        find_place(context);
    } catch (...) {
        context.message.clear();
        context.path.clear();
        context.line = 0;
    }
}

}  // namespace

std::int32_t keep_failure(lamella_context& context) noexcept {
    try {
        throw;
    } catch (const BadCall& error) {
        keep(context, LAMELLA_BAD_CALL, error.what());
    } catch (const Error& error) {
        keep(context, error.exit_code(), error.what());
    } catch (const std::bad_alloc&) {
        keep(context, LAMELLA_OUT_OF_MEMORY, "there is not enough memory");
    } catch (const std::exception& error) {
        keep(context, LAMELLA_FAULT, error.what());
    } catch (...) {
        keep(context, LAMELLA_FAULT, "something of no known kind was thrown");
    }
    return context.status;
}

void check_callback(std::int32_t status, const std::string& what) {
    if (status == LAMELLA_STOPPED) throw Interrupted(what + " asked to stop");
    if (status == LAMELLA_BAD_INPUT) throw InputError(what + " refused its input");
    if (status != LAMELLA_OK) throw FaultError(fmt::format("{} failed with status {}", what, status));
}

}  // namespace lamella

using namespace lamella;

std::uint32_t lamella_abi_version() { return LAMELLA_ABI_VERSION; }

const char* lamella_version() { return LAMELLA_VERSION; }

const char* lamella_status_name(std::int32_t status) {
    switch (status) {
        case LAMELLA_OK:
            return "ok";
        case LAMELLA_VIOLATED:
            return "constraint violated";
        case LAMELLA_BAD_INPUT:
            return "bad input";
        case LAMELLA_FAULT:
            return "fault";
        case LAMELLA_BAD_CALL:
            return "bad call";
        case LAMELLA_OUT_OF_MEMORY:
            return "out of memory";
        case LAMELLA_STOPPED:
            return "stopped";
        default:
            return "unknown";
    }
}

std::int32_t lamella_context_create(std::uint32_t abi_version, lamella_context** context) {
    if (context == nullptr || abi_version != LAMELLA_ABI_VERSION) return LAMELLA_BAD_CALL;
    auto* made = new (std::nothrow) lamella_context;
    if (made == nullptr) return LAMELLA_OUT_OF_MEMORY;
    *context = made;
    return LAMELLA_OK;
}

void lamella_context_destroy(lamella_context* context) { delete context; }

std::int32_t lamella_last_error(const lamella_context* context, lamella_error* error) {
    if (context == nullptr || error == nullptr) return LAMELLA_BAD_CALL;
    lamella_error found{};
    found.status = context->status;
    found.message = context->message.c_str();
    found.path = context->path.c_str();
    found.line = context->line;
    try {
        hand_out(error, found, "error");
    } catch (...) {
        return LAMELLA_BAD_CALL;
    }
    return LAMELLA_OK;
}
