// Splits a G-code file into parts and sends them.
#include <fmt/format.h>

#include <fstream>
#include <numeric>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "printers/serial/serial_output.h"

namespace lamella {
namespace {

constexpr int lines_a_part = 500;  // if the file does not mark its layers

/// Calls take(part) for each part in order. Parts begin at the layer comments of slicers.
template <typename Take>
void for_each_part(const std::filesystem::path& path, const Take& take) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw InputError("cannot read " + path.string());
    std::string part, line;
    int lines = 0;
    for (bool first = true; std::getline(in, line); first = false) {
        if (first) line = std::string(without_byte_order_mark(line));
        const bool layer = line.starts_with(";LAYER_CHANGE") || line.starts_with(";LAYER:");
        if ((layer || lines >= lines_a_part) && !part.empty()) {
            take(part);
            part.clear();
            lines = 0;
        }
        (part += line) += '\n';
        ++lines;
    }
    if (in.bad()) throw FaultError("reading " + path.string() + " failed");
    take(part);
}

}  // namespace

int send_gcode_file(const std::filesystem::path& path, GcodeOutput& output, bool resume,
                    const LinkSettings& settings) {
    const CancelToken* cancel = settings.cancel;
    // An FNV-1a hash of the whole file shows whether it is unchanged when a print is resumed.
    std::uint64_t hash = 14695981039346656037ULL;
    std::vector<double> seconds;  // of each part
    ChunkMaker maker(settings.dialect, settings.motion);
    for_each_part(path, [&](const std::string& part) {
        if (cancel != nullptr && cancel->cancelled()) throw Interrupted("interrupted");
        for (const char c : part) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
        double all = 0;
        try {
            for (const LineFacts& line : maker.clean(part).facts) all += static_cast<double>(line.seconds);
        } catch (const InputError& error) {
            throw InputError(path.string() + ", " + error.what());
        }
        seconds.push_back(all);
    });
    if (maker.lines() == 0) {
        throw InputError(path.string() +
                         " holds no line to send, only comments or nothing; accepted: a file with G-code");
    }
    const int parts = static_cast<int>(seconds.size());
    const int first = output.begin({fmt::format("file-{:016x}", hash), "gcode file", {0, parts}}, resume);
    int index = 0;
    for_each_part(path, [&](const std::string& part) {
        if (index < first) output.skip(part, seconds[static_cast<std::size_t>(index)]);
        ++index;
    });
    output.expect(std::accumulate(seconds.begin() + first, seconds.end(), 0.0));
    index = 0;
    for_each_part(path, [&](const std::string& part) {
        if (cancel != nullptr && cancel->cancelled()) throw Interrupted("interrupted");
        if (index++ >= first) output.commit(part, index, nullptr);
    });
    output.end("");
    return parts;
}

}  // namespace lamella
