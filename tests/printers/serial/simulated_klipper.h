// A klippy as its published text describes it: requests in JSON over a connection, scripts one after another,
// motion that is queued a little ahead, errors that end a script but not the ones behind it.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamella::test {

struct KlipperOptions {
    double look_ahead = 2;     ///< s of queued motion beyond which a script stalls
    double line_time = 5e-5;   ///< s to run a line, without its motion
    double heating_rate = 50;  ///< degrees a second
    double startup = 0;        ///< s until it is ready
    bool force_move = true;    ///< has SET_KINEMATIC_POSITION
    bool pause_resume = true;
    bool old_words = false;  ///< says "action:pause" where newer ones say "action:paused"
    std::string trouble;     ///< state "error" with this message
    std::string own_file;    ///< it prints this file by itself
};

class SimulatedKlipper {
  public:
    using Options = KlipperOptions;
    explicit SimulatedKlipper(KlipperOptions options) : options_(std::move(options)) {}

    /// Begins to start up.
    void boot(double now);
    /// Bytes from the connection.
    void receive(std::string_view bytes, double now);
    /// Works until `now` and returns what it said.
    std::string run(double now);
    /// The connection is gone. Scripts that were received are still run.
    void disconnect();
    /// Ends and starts again: axes, heaters and scripts are forgotten.
    void restart(double now);
    /// Shuts down by itself.
    void shut_down(const std::string& why, double now);
    /// Another client runs a script.
    void run_of_another(const std::string& script) { scripts_.push_back({std::nullopt, lines_of(script)}); }
    /// The next line like this one is refused.
    void refuse_next(std::string line, std::string why) { refused_[std::move(line)] = std::move(why); }

    /// Lines in the order they were executed, of all clients.
    const std::vector<std::string>& executed() const { return executed_; }
    /// Scripts as they came in.
    const std::vector<std::vector<std::string>>& scripts() const { return received_; }
    bool heating() const { return nozzle_.target > 0 || bed_.target > 0; }
    bool is_shut_down() const { return state_ == "shutdown"; }
    double shut_down_at() const { return shut_down_at_; }
    bool paused() const { return paused_; }
    bool idle(double now) const { return scripts_.empty() && !running_ && print_time_ <= now; }
    /// Time in which the machine stood still between two moves of a stream, s.
    double dry() const { return dry_; }
    int malformed() const { return malformed_; }
    std::size_t most_scripts() const { return most_scripts_; }
    void cool_down() { nozzle_.degrees = bed_.degrees = 25; }

  private:
    using Json = nlohmann::ordered_json;
    struct Script {
        std::optional<std::int64_t> id;  // empty: of another client
        std::vector<std::string> lines;
        std::size_t next = 0;
    };
    struct Heater {
        double degrees = 25, target = 0;
    };
    static std::vector<std::string> lines_of(const std::string& script);
    void take_request(std::string_view text, double now);
    Json answer_to(const std::string& method, const Json& params, double now);
    void subscribe(const Json& params, double now);
    void say(const Json& message);
    void tell(const std::string& line);
    void reply(const std::optional<std::int64_t>& id, const Json& result);
    void fail(const std::optional<std::int64_t>& id, const std::string& why);
    Json status_of(const std::string& object, double now) const;
    void report(double now);
    void heat(double seconds);
    /// Works at the first script. Returns false if it has to wait.
    bool step(double now);
    /// Executes a line; returns why it is refused, or nothing.
    std::string execute(const std::string& line, double now);
    std::string move(const std::string& line, double now);
    std::string pause_command(const std::string& name);
    /// Returns true while the line just executed keeps the script from going on.
    bool waits(double now);

    KlipperOptions options_;
    std::string state_ = "startup";
    std::string message_;
    double ready_at_ = 0;
    double at_ = 0;  // worked up to here
    double busy_until_ = 0;
    double print_time_ = 0;  // end of the queued motion
    bool streams_ = false;   // the queued motion is followed by more
    double dry_ = 0;
    double shut_down_at_ = -1;
    std::string bytes_;
    std::string said_;
    std::deque<Script> scripts_;
    bool running_ = false;  // the first script has begun
    std::string waiting_;   // command that waits
    bool hears_ = false;    // subscribed to output
    std::string output_topic_, status_topic_;
    Json wanted_;
    std::map<std::string, Json> told_;
    double next_report_ = 0;
    std::map<std::string, std::string> refused_;
    std::vector<std::string> executed_;
    std::vector<std::vector<std::string>> received_;
    std::size_t most_scripts_ = 0;
    int malformed_ = 0;
    Heater nozzle_, bed_;
    bool homed_[3] = {false, false, false};
    double place_[4] = {0, 0, 0, 0};
    bool relative_ = false, relative_e_ = false;
    double feed_ = 1500;
    bool paused_ = false;
};

}  // namespace lamella::test
