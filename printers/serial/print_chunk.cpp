// Strips the text of layers and measures its rates.
#include "printers/serial/print_chunk.h"

#include <algorithm>

#include "engine/base/error.h"

namespace lamella {

namespace {

std::string clean_line(std::string_view line, Dialect dialect, std::int32_t number) {
    try {
        return clean_command(line, line_rules(dialect));
    } catch (const InputError& error) {
        throw InputError("line " + std::to_string(number) + ": " + error.what());
    }
}

}  // namespace

void ChunkMaker::skip(std::string_view text) {
    source_ += static_cast<std::int32_t>(std::count(text.begin(), text.end(), '\n'));
}

CleanText ChunkMaker::clean(std::string_view text) {
    constexpr std::int64_t frame = 11;  // number, checksum and line end of a typical line
    CleanText clean;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const std::string command = clean_line(line, dialect_, ++source_);
        if (command.empty()) continue;
        (clean.lines += command) += '\n';
        clean.facts.push_back({0, source_});
        const double time = is_grbl() ? modes_.apply(command) : machine_.apply(command);
        if (!(is_grbl() ? modes_.can_be_written() : machine_.can_be_written())) {
            throw InputError("line " + std::to_string(source_) + ": \"" + command +
                             "\" leads beyond 1,000,000,000 mm, mm/min or degrees, where no machine is");
        }
        is_grbl() ? timer_.add(command, modes_) : timer_.add(command, machine_);
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
    const std::vector<float> seconds = timer_.take();
    for (std::size_t i = 0; i < seconds.size(); ++i) clean.facts[i].seconds = seconds[i];
    return clean;
}

void ChunkMaker::restore_machine(const nlohmann::ordered_json& json) {
    if (is_grbl()) {
        modes_ = GrblModes::from_json(json);
    } else {
        machine_ = MachineState::from_json(json);
    }
}

}  // namespace lamella
