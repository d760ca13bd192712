// Strips the text of layers and measures its rates.
#include "printers/serial/print_chunk.h"

#include <algorithm>

namespace lamella {

std::string ChunkMaker::clean(std::string_view text) {
    constexpr std::int64_t frame = 11;  // number, checksum and line end of a typical line
    std::string clean_lines;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::string command = clean_command(line, grbl_ ? longest_grbl_line : longest_command);
        if (command.empty()) continue;
        (clean_lines += command) += '\n';
        const double time = grbl_ ? modes_.apply(command) : machine_.apply(command);
        const auto size = static_cast<std::int64_t>(command.size()) + frame;
        ++lines_;
        bytes_ += size;
        seconds_ += time;
        stretch_ += time;
        ++stretch_lines_;
        stretch_bytes_ += size;
        if (stretch_ < 1) continue;
        need_.lines = std::max(need_.lines, static_cast<double>(stretch_lines_) / stretch_);
        need_.bytes = std::max(need_.bytes, static_cast<double>(stretch_bytes_) / stretch_);
        stretch_ = 0;
        stretch_lines_ = stretch_bytes_ = 0;
    }
    return clean_lines;
}

void ChunkMaker::restore_machine(const nlohmann::ordered_json& json) {
    if (grbl_) {
        modes_ = GrblModes::from_json(json);
    } else {
        machine_ = MachineState::from_json(json);
    }
}

}  // namespace lamella
