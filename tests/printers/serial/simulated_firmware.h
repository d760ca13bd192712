// A Marlin as its real builds behave on the wire: a receive ring that overflows, checks of numbers and sums,
// resends that throw the ring away, a few command slots, a planner. It records what it executes.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace lamella::test {

struct FirmwareOptions {
    bool old = false;               ///< 1.1.9: a repeated line is an error; 2.1 drops it without a word
    bool advanced_ok = false;       ///< N, P and B behind each ok
    bool emergency_parser = false;  ///< M108 and M112 work past a full ring
    bool resend_has_ok = true;      ///< some builds leave it out
    bool keepalive = true;          ///< "busy: processing" every 2 s
    double line_time = 0.0005;      ///< s to read and run a line, without its motion
    double heating_rate = 50;       ///< degrees a second
    bool host_prompts = false;      ///< M0 opens a dialog, which M876 answers
    std::string name = "Marlin";    ///< told by M115
    double spurious = 0;            ///< share of good lines that it errs about by itself
    unsigned seed = 1;
};

class SimulatedMarlin {
  public:
    using Options = FirmwareOptions;
    explicit SimulatedMarlin(FirmwareOptions options) : options_(options), random_(options.seed) {}

    /// Turned on, or reset: says its greeting.
    void boot(double now);
    /// Bytes from the wire.
    void receive(std::string_view bytes, double now);
    /// Works until `now` and returns what it said.
    std::string run(double now);

    /// Commands in the order they were executed, without numbers and sums.
    const std::vector<std::string>& executed() const { return executed_; }
    bool killed() const { return killed_; }
    double killed_at() const { return killed_at_; }
    /// Whether all that it got is executed, but for moves.
    bool idle() const { return ring_.empty() && slots_.empty(); }
    /// A person presses the printer's own knob.
    void press_knob() { end_wait(); }
    /// The nozzle has cooled down in a long pause, and gets warm again by that many degrees a second.
    void cool_down(double heating_rate) { nozzle_ = 25, options_.heating_rate = heating_rate; }
    bool waits_for_user() const { return wait_for_user_; }
    bool heating() const { return nozzle_target_ > 0 || bed_target_ > 0; }
    std::int64_t errors() const { return errors_; }
    std::int64_t lost_bytes() const { return lost_bytes_; }
    std::size_t fullest() const { return fullest_; }
    /// Says something of its own.
    void say(const std::string& line) { said_ += line + "\n"; }

  private:
    struct Command {
        std::string text;
        std::int64_t number = -1;
    };
    void read_line(double now);
    void line_error(const std::string& what);
    void start_command(double now);
    void kill(double now);
    void answer(const Command& command);
    std::string temperatures() const;
    void emergency(char c, double now);
    void end_wait();

    FirmwareOptions options_;
    std::mt19937 random_;
    std::string ring_;
    std::string line_;
    std::string early_;
    std::deque<Command> slots_;
    std::deque<double> planner_;  // when each move ends
    bool running_ = false;
    double run_until_ = 0;
    double next_busy_ = 0;
    double next_report_ = 0;
    double ready_at_ = 0;
    bool wait_for_heat_ = false;
    bool wait_for_user_ = false;
    bool reports_ = false;
    std::int64_t last_number_ = 0;
    double nozzle_ = 25, nozzle_target_ = 0, bed_target_ = 0;
    double x_ = 0, y_ = 0, feed_ = 1500;
    bool killed_ = false;
    double killed_at_ = 0;
    std::int64_t errors_ = 0;
    std::int64_t lost_bytes_ = 0;
    std::size_t fullest_ = 0;
    std::string said_;
    std::vector<std::string> executed_;
};

/// The job's part of what was executed: without what a sender asks for itself.
std::vector<std::string> job_lines(const std::vector<std::string>& executed);

/// Where two lists part first, in words; empty when they are the same.
std::string first_difference(const std::vector<std::string>& executed,
                             const std::vector<std::string>& wanted);

}  // namespace lamella::test
