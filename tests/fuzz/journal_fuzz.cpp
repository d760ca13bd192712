// Fuzz target: any bytes as the journal of an unfinished output end in a resumed run, at a layer of its
// range, or in an InputError. The text before the first zero byte is the output, the rest its journal.
#include <algorithm>

#include "engine/base/error.h"
#include "printers/archive/unfinished_file.h"
#include "tests/fuzz/scratch_file.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::size_t split = static_cast<std::size_t>(std::find(data, data + size, 0) - data);
    const std::size_t rest = std::min(split + 1, size);
    scratch_file("out.gcode.partial", data, split);
    scratch_file("out.gcode.partial.journal", data + rest, size - rest);
    const JobStamp stamp{"identity", "settings", {2, 9}};
    try {
        UnfinishedFile file(scratch_folder() / "out.gcode", false);
        const int next = file.begin(stamp, true);
        if (next < 2 || next > 9) std::abort();
        file.restore([](const nlohmann::ordered_json& state) {
            if (!state.is_null()) state.at("seconds").get<double>();
        });
    } catch (const InputError&) {
    }
    return 0;
}
