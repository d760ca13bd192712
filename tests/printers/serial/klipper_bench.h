// A KlipperSender against a simulated klippy, over a connection that breaks up all bytes, in a time of its
// own.
#pragma once

#include <algorithm>
#include <deque>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "printers/serial/klipper_sender.h"
#include "tests/printers/serial/simulated_klipper.h"

namespace lamella::test {

class KlipperBench {
  public:
    explicit KlipperBench(KlipperOptions options = {}, double latency = 0.0005, unsigned seed = 1)
        : klippy(std::move(options)), sender(SenderSettings{}, listener()), latency_(latency), random_(seed) {
        klippy.boot(0);
        sender.connect(0);
    }

    /// Works until something is true, at most that long. Returns whether it is.
    template <class Done>
    bool run_until(double seconds, Done done) {
        const double end = now + seconds;
        while (!done()) {
            if (now > end) return false;
            step();
        }
        return true;
    }
    void run(double seconds) {
        run_until(seconds, [] { return false; });
    }
    bool connect() {
        return run_until(10, [&] { return sender.connected() || sender.stopped(); }) && sender.connected();
    }
    void push(const std::vector<std::string>& lines) {
        for (const std::string& line : lines) sender.push(line);
    }
    /// Sends all, to the end of the motion.
    bool finish(double seconds) {
        sender.finish();
        return run_until(seconds, [&] { return sender.finished() || sender.stopped() || sender.refused(); });
    }

    /// Cuts the connection with all that is under way.
    void cut() {
        there_.clear();
        back_.clear();
        klippy.disconnect();
        sender.disconnect();
    }

    SimulatedKlipper klippy;
    std::vector<std::string> actions, messages;
    KlipperSender sender;
    double now = 0;
    int overdue = 0;    ///< times that the sender was due right after it had worked: a loop would spin
    bool deaf = false;  ///< klippy hears and says nothing

  private:
    using Pieces = std::deque<std::pair<double, std::string>>;
    SenderListener listener() {
        SenderListener listener;
        // As PrintLink does: whoever asks for a pause gets it before anything else is sent.
        listener.on_action = [this](const std::string& action) {
            actions.push_back(action);
            if (action == "paused") sender.hold(true);
        };
        listener.on_message = [this](const std::string& text) { messages.push_back(text); };
        return listener;
    }
    /// Sends bytes in pieces of any size, each of which arrives after the one before.
    void send(Pieces& pieces, std::string_view bytes) {
        while (!bytes.empty()) {
            const std::size_t size = std::min<std::size_t>(bytes.size(), 1 + random_() % 700);
            const double at = std::max(now + latency_, pieces.empty() ? 0 : pieces.back().first);
            pieces.emplace_back(at, bytes.substr(0, size));
            bytes.remove_prefix(size);
        }
    }
    std::string arrived(Pieces& pieces) const {
        std::string bytes;
        while (!pieces.empty() && pieces.front().first <= now) {
            bytes += pieces.front().second;
            pieces.pop_front();
        }
        return bytes;
    }
    void step() {
        now += 0.0005;
        sender.tick(now);
        overdue += sender.wake_at() <= now ? 1 : 0;
        const std::string out(sender.output());
        const std::size_t taken = out.empty() ? 0 : 1 + random_() % out.size();
        send(there_, out.substr(0, taken));
        sender.wrote(taken);
        if (deaf) return;
        for (const char c : arrived(there_)) klippy.receive({&c, 1}, now);
        send(back_, klippy.run(now));
        const std::string came = arrived(back_);
        if (!came.empty()) sender.receive(came, now);
    }

    double latency_;
    std::mt19937 random_;
    Pieces there_, back_;
};

/// Heats, homes, and goes to where the first layer begins.
inline const std::vector<std::string> klipper_start{"G90", "M83", "M109 S200", "G28", "G1 X10 Y20 Z1 F6000"};

/// Moves of half a millimetre, each of which can be told from all others.
inline std::vector<std::string> short_moves(int count, int first = 0) {
    std::vector<std::string> lines;
    for (int i = first; i < first + count; ++i)
        lines.push_back(std::string(i % 2 == 0 ? "G1 X10" : "G1 X10.5") + " E0.0" +
                        std::to_string(10000 + i) + "1");
    return lines;
}

/// The moves of a job among executed lines.
inline std::vector<std::string> moves_of(const std::vector<std::string>& executed) {
    std::vector<std::string> moves;
    std::copy_if(executed.begin(), executed.end(), std::back_inserter(moves),
                 [](const std::string& line) { return line.find(" E0.0") != std::string::npos; });
    return moves;
}

}  // namespace lamella::test
