// The texts that tell the state of a print over a serial line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "printers/serial/print_link.h"

namespace lamella {

constexpr std::size_t any_width = static_cast<std::size_t>(-1);

/// Returns what keeps the print from going on, such as "heating"; empty if nothing does.
std::string hindrance_text(const LinkStatus& status);

/// Returns " 42 %  1:10:05 left  layer 12/80  nozzle 210/210  bed 60/60  Z 2.40  4711 lines  8 layers ready",
/// the most important first. What does not fit into `columns` is left out whole. `last_layer` is 0 for a
/// ready file.
std::string status_text(const LinkStatus& status, int last_layer, std::size_t columns = any_width);

/// Returns what the printer waits for and how it is answered: by keys, or, without any, by signals to
/// `process`. Empty while it does not wait.
std::string wait_text(const LinkStatus& status, std::optional<int> process = std::nullopt);

/// Returns the printer's name, how many bytes are sent ahead, and what Ctrl-C does.
std::string greeting_text(const LinkStatus& status, bool keys);

/// Returns the statistics of a print: lines/s, longest gap, resends, timeouts, losses of the port,
/// starvation.
std::string summary_text(const LinkStatus& status);

}  // namespace lamella
