// The table of hosts, one row each.
#include <fmt/format.h>

#include "hosts/moonraker.h"
#include "hosts/network_host.h"

namespace lamella {

namespace {

constexpr HostKind kinds[] = {
    {"moonraker", "Moonraker: Klipper machines (Mainsail, Fluidd)", make_moonraker},
};

}  // namespace

std::span<const HostKind> host_kinds() { return kinds; }

const HostKind& find_host_kind(std::string_view name, const std::string& where) {
    std::string known;
    for (const HostKind& kind : kinds) {
        if (name == kind.name) return kind;
        known += (known.empty() ? "" : ", ") + std::string(kind.name);
    }
    throw InputError(fmt::format("{}: \"{}\" is no kind of host; accepted: {}", where, name, known));
}

const char* state_word(PrintState state) {
    switch (state) {
        case PrintState::offline:
            return "offline";
        case PrintState::idle:
            return "idle";
        case PrintState::busy:
            return "busy";
        case PrintState::printing:
            return "printing";
        case PrintState::paused:
            return "paused";
        case PrintState::finished:
            return "finished";
        case PrintState::cancelled:
            return "cancelled";
        case PrintState::failed:
            return "failed";
    }
    return "";
}

bool is_active(PrintState state) { return state == PrintState::printing || state == PrintState::paused; }

}  // namespace lamella
