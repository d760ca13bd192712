// The table of hosts, one row each.
#include <fmt/format.h>

#include "hosts/duet.h"
#include "hosts/moonraker.h"
#include "hosts/nanodlp.h"
#include "hosts/network_host.h"
#include "hosts/octoprint.h"
#include "hosts/prusalink.h"
#include "hosts/sdcp.h"

namespace lamella {

namespace {

constexpr HostKind kinds[] = {
    {"moonraker", "Moonraker: Klipper machines (Mainsail, Fluidd)", make_moonraker},
    {"octoprint", "OctoPrint, and what answers like it", make_octoprint, "local"},
    {"prusalink", "PrusaLink: Prusa's machines", make_prusalink, "usb", "maker"},
    {"sdcp", "SDCP 3: resin machines of Elegoo and others", make_sdcp, "local"},
    {"duet", "Duet and other boards of RepRapFirmware 3", make_duet, "0:/gcodes"},
    {"nanodlp", "NanoDLP: resin machines", make_nanodlp, "1"},
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
