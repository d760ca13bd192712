// A GRBL 1.1 as it behaves on the wire: a receive buffer of 128 bytes that must not overflow, real-time
// bytes, one answer a line. It records what it executes.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lamella::test {

struct GrblOptions {
    double line_time = 0.002;  ///< s that a line takes
    bool locked = false;       ///< in alarm until $X or $H, as after a reset in motion
};

class SimulatedGrbl {
  public:
    using Options = GrblOptions;
    explicit SimulatedGrbl(GrblOptions options) : options_(options) {}

    void boot() {
        ring_.clear();
        held_ = paused_ = false;
        said_ += "\r\nGrbl 1.1h ['$' for help]\r\n";
    }
    void receive(std::string_view bytes, double = 0) {
        for (const char c : bytes) {
            if (c == '?') {
                said_ += held_           ? "<Hold:0|MPos:0,0,0>\r\n"
                         : ring_.empty() ? "<Idle|MPos:0,0,0>\r\n"
                                         : "<Run|MPos:0,0,0>\r\n";
            } else if (c == '!') {
                held_ = true;
                ++holds;
            } else if (c == '~') {
                ++cycle_starts;
                cycle_start();
            } else if (c == 0x18) {
                reset_while_held = held_;
                ++resets;
                boot();
            } else {
                overflowed = overflowed || ring_.size() >= 128;
                ring_ += c;
                fullest = std::max(fullest, ring_.size());
            }
        }
    }
    /// The button on the machine, or `~`.
    void cycle_start() {
        held_ = false;
        if (std::exchange(paused_, false)) said_ += "ok\r\n";
    }
    /// Works until `now` and returns what it said.
    std::string run(double now) {
        next_line_ = std::max(next_line_, now - 0.05);
        for (; next_line_ <= now; next_line_ += options_.line_time) run_line();
        return std::exchange(said_, {});
    }
    const std::vector<std::string>& executed() const { return executed_; }
    bool held() const { return held_; }
    /// Nothing is left to do.
    bool idle() const { return ring_.empty(); }

    std::string alarm_at;  ///< the line that runs into a limit
    std::size_t fullest = 0;
    bool overflowed = false, settings_alone = true, reset_while_held = false;
    int resets = 0, holds = 0, cycle_starts = 0;  ///< by bytes from the host

  private:
    void run_line() {
        const auto end = ring_.find('\n');
        if (end == std::string::npos || held_) return;
        const std::string line = ring_.substr(0, end);
        ring_.erase(0, end + 1);
        if (line[0] == '$' && !ring_.empty()) settings_alone = false;
        if (line == "$X" || line == "$H") options_.locked = false;
        if (line == "$I") {
            said_ += "[VER:1.1h.20190830:]\r\n[OPT:V,15,128]\r\nok\r\n";
        } else if (options_.locked) {
            said_ += "error:9\r\n";
        } else if (line == alarm_at) {
            said_ += "ALARM:2\r\nok\r\n";
        } else if (line == "G99") {
            said_ += "error:20\r\n";
        } else {
            executed_.push_back(line);
            // M0 holds, and is answered when the cycle is started again.
            held_ = paused_ = line == "M0";
            if (!paused_) said_ += "ok\r\n";
        }
    }

    GrblOptions options_;
    std::string ring_, said_;
    std::vector<std::string> executed_;
    bool held_ = false, paused_ = false;
    double next_line_ = 0;
};

}  // namespace lamella::test
