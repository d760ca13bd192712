// Fuzz target: lines of any bytes as requests to a server each get a reply, and the server goes on.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "app/reports/section_server.h"

using namespace lamella;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    // Files are not to be looked for, nor large parts to be built.
    for (const char* word :
         {"/", "mesh", "support", "repair", "islands", "drain", "dowel", "size", "radius"}) {
        if (text.find(word) != std::string::npos) return 0;
    }
    SectionServer server;
    for (std::size_t begin = 0; begin < size && !server.has_ended();) {
        const std::size_t end = std::min(text.find('\n', begin), size);
        const ServerReply reply = server.answer(text.substr(begin, end - begin));
        if (!reply.head.is_object()) std::abort();
        begin = end + 1;
    }
    return 0;
}
