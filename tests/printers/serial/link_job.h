// A small job for a PrintLink, and waiting for what becomes of it.
#pragma once

#include <algorithm>

#include "printers/serial/print_link.h"
#include "tests/printers/serial/pty_machine.h"
#include "tests/wait_for.h"

namespace lamella::test {

inline LinkSettings settings_of(const std::string& port) {
    LinkSettings settings;
    settings.port = port;
    settings.sender.greeting = 0.1;
    settings.park_x = 5;
    settings.park_y = 200;
    return settings;
}

inline PrintChunk chunk_of(const std::vector<std::string>& lines, int layer) {
    PrintChunk chunk;
    for (const std::string& line : lines) chunk.lines += line + "\n";
    chunk.count = static_cast<std::int64_t>(lines.size());
    chunk.layer = layer;
    return chunk;
}

inline std::vector<std::string> layer(int index, int count) {
    std::vector<std::string> lines{"G0 Z" + std::to_string(index + 1) + " F600"};
    for (int i = 0; i < count; ++i)
        lines.push_back("G1 X" + std::to_string(10 + i % 5) + " Y20 E" + std::to_string(i) + " F6000");
    return lines;
}

inline const std::vector<std::string> start{"G28", "G90", "M83", "M109 S200", "G1 X10 Y20 F6000"};

inline std::ptrdiff_t index_of(const std::vector<std::string>& lines, const std::string& line) {
    return std::find(lines.begin(), lines.end(), line) - lines.begin();
}

}  // namespace lamella::test
