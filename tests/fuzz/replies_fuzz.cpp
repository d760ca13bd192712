// Fuzz target: any bytes from a printer leave a sender sane: it answers no line that it has not sent, and
// says only so much.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "printers/serial/grbl_sender.h"
#include "printers/serial/marlin_sender.h"

using namespace lamella;

namespace {

constexpr int lines = 50;

void listen(LineSender& sender, std::string_view bytes) {
    sender.connect(0);
    for (int i = 0; i < lines; ++i) sender.push("G1 X1");
    sender.finish();
    double now = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 16) {
        sender.receive(bytes.substr(at, 16), now += 0.1);
        sender.tick(now);
        if (sender.answered() < 0 || sender.answered() > lines || sender.output().size() > 65536)
            std::abort();
        sender.wrote(sender.output().size());
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    MarlinSender marlin({}, {});
    listen(marlin, bytes);
    GrblSender grbl({}, {});
    listen(grbl, bytes);
    return 0;
}
