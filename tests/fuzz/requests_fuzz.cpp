// Fuzz target: lines of any bytes as requests to a server each get a reply, and the server goes on.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "app/reports/section_server.h"

using namespace lamella;

namespace {

/// Files are not to be looked for or written, nor large parts or pictures to be made.
bool asks_for_much(const std::string& text) {
    for (const char* word : {"/", "mesh", "support", "repair", "islands", "drain", "dowel", "size", "radius",
                             "output", "\\u", "scale", "copies", "file"}) {
        if (text.find(word) != std::string::npos) return true;
    }
    if (text.find("columns") == std::string::npos) return false;
    constexpr int most_digits = 3;
    int digits = 0;
    for (const char c : text) {
        digits = c >= '0' && c <= '9' ? digits + 1 : 0;
        if (digits > most_digits) return true;
    }
    return false;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    if (asks_for_much(text)) return 0;
    SectionServer server;
    // Requests need a job to be about: it has number 1.
    const ServerReply opened = server.answer(std::string(
        R"({"method": "open", "set": {"part.shape": "sphere", "part.radius": 2, "layers.height": 0.5}})"));
    if (opened.head.value("job", 0) != 1) std::abort();
    for (std::size_t begin = 0; begin < size && !server.has_ended();) {
        const std::size_t end = std::min(text.find('\n', begin), size);
        const ServerReply reply = server.answer(text.substr(begin, end - begin));
        if (!reply.head.is_object()) std::abort();
        begin = end + 1;
    }
    return 0;
}
