// A Marlin sender, a simulated printer and two wires between them, moved on by small steps of time.
#pragma once

#include <algorithm>

#include "printers/serial/marlin_sender.h"
#include "tests/printers/serial/faulty_wire.h"
#include "tests/printers/serial/simulated_firmware.h"

namespace lamella::test {

/// Moves that take `duration` seconds each, all different.
inline std::vector<std::string> moves(int count, double duration = 0) {
    std::vector<std::string> lines;
    for (int i = 0; i < count; ++i) {
        const double way = duration > 0 ? duration * 100 : 0;
        lines.push_back("G1 X" + std::to_string(i % 2 == 0 ? static_cast<int>(way) : 0) + " E" +
                        std::to_string(i) + " F6000");
    }
    return lines;
}

/// A sender, a printer whose replies take `latency` seconds, and two wires, moved on by small steps of time.
struct MarlinBench {
    explicit MarlinBench(FirmwareOptions options, SenderSettings settings = {}, WireFaults to = {},
                         WireFaults from = {}, unsigned seed = 1, double latency = 0.001)
        : sender(settings, {}),
          printer(options),
          out(to, 0.0005, 10.0 / 250000, seed),
          in(from, latency, 10.0 / 250000, seed + 1000) {
        printer.boot(0);
        sender.connect(0);
    }
    void step() {
        now += 0.00025;
        sender.tick(now);
        const std::string bytes(sender.output());
        sender.wrote(bytes.size());
        max_unanswered = std::max(max_unanswered, sender.unanswered());
        if (!unplugged) out.put(bytes, now);
        printer.receive(out.take(now), now);
        const std::string said = printer.run(now);
        if (!unplugged) in.put(said, now);
        sender.receive(in.take(now), now);
    }
    template <class Until>
    bool run(double seconds, Until until) {
        for (const double end = now + seconds; now < end;) {
            step();
            if (until()) return true;
        }
        return false;
    }
    bool print(const std::vector<std::string>& lines, double seconds) {
        for (const std::string& line : lines) sender.push(line);
        sender.finish();
        return run(seconds, [&] { return sender.finished() || sender.stopped(); });
    }

    MarlinSender sender;
    SimulatedMarlin printer;
    FaultyWire out, in;
    double now = 0;
    bool unplugged = false;
    std::size_t max_unanswered = 0;
};

}  // namespace lamella::test
