// PrintRequest: what a client says about a print that it starts.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "printers/common/profile.h"
#include "printers/serial/print_link.h"

namespace lamella {

struct PrintRequest {
    LinkSettings link;             ///< with port, speed and what the machine says; without a journal
    std::optional<double> z{};     ///< height of the nozzle when a print is resumed, mm
    bool resume = false;           ///< go on with the print that the journal knows
    bool discard_journal = false;  ///< begin anew in spite of a journal
};

/// Reads the body of a request for a printer of G-code:
///
///     {"to": {"serial": "/dev/ttyUSB0", "baud": 250000}, "park": [0, 200], "resume": true}
///
/// Throws HttpError 400 for unknown members, wrong values, and ports that are no serial line, 404 for ports
/// that do not exist.
PrintRequest read_print_request(const nlohmann::ordered_json& body, const PrinterProfile& printer);

}  // namespace lamella
