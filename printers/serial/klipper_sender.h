// KlipperSender: sends a job to Klipper's API socket in scripts.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "printers/serial/klipper_message.h"
#include "printers/serial/line_sender.h"

namespace lamella {

/// Sends lines in scripts of some dozen. Klipper answers a script when all its lines are executed or lie in
/// its buffer of motion, so the answers pace the stream. That buffer holds one to two seconds of motion when
/// the answer comes, and the next script, which is ready, follows at once: motion does not pause.
///
/// Only one script of the job is on its way. Klipper executes a second one even if the first one has failed,
/// and after a pause that somebody else has asked for in between; nothing can call it back. With one script,
/// no line is executed behind a refused one. Commands that may wait, pause or ask (heating, homing, macros)
/// are scripts of their own, and a script does not reach beyond a layer.
///
/// Klipper cannot be called off while it waits for a heater. Therefore the sender sets the temperature, waits
/// for it by the reported temperatures, and sends the command that waits only when little is left to wait
/// for.
///
/// When the socket is lost, klippy has ended or restarted, and has forgotten where the axes are: the job
/// ends.
class KlipperSender : public LineSender {
  public:
    KlipperSender(SenderSettings settings, SenderListener listener);

    void connect(double now) override;
    void end_part() override { part_ends_.push_back(sent_job_ + static_cast<std::int64_t>(pending_.size())); }
    std::size_t unanswered() const override { return script_ ? script_->bytes : 0; }
    bool connected() const override { return state_ == State::running; }
    bool finished() const override {
        return finishing_ && finish_sent_ && idle() && !held_ && !failing_ && !refused_;
    }
    /// Shuts Klipper down by its emergency stop, which does not wait for scripts.
    void halt(double now) override;
    bool halts_at_once() const override { return true; }
    bool cancel_halts() const override { return false; }
    /// Has Klipper resume if it has paused by itself: its own RESUME restores where it was.
    void hold_motion(bool held) override;
    void forget_pause() override;
    void end_waiting() override;
    std::optional<UserWait> user_wait() const override;
    void choose(std::size_t button) override;
    LineWait line_wait() const override;
    bool can_pause() const override { return !pending_.empty() || !finish_sent_; }
    double dry_at() const override { return dry_at_; }
    bool knows_height() const override { return homed_axes_.find('z') != std::string::npos; }
    bool takes_height() const override { return takes_height_; }
    std::string remark() const override { return remark_; }

  protected:
    void handle(const Reply&, double) override {}
    void read(std::string_view bytes, double now) override;
    void check_time(double now) override;
    double next_wake() const override;
    void take_up_dialogue(double now) override;
    void drop_dialogue() override;
    void feed(double now) override;

  private:
    static constexpr double answer_patience = 10;    // s to wait for an answer before the job begins
    static constexpr double startup_interval = 0.5;  // s between two questions whether Klipper is ready
    enum class State : unsigned char { idle, asking, starting, subscribing, running };
    enum class Asked : unsigned char { info, output, objects, status, commands, script, sign_of_life, cause };
    struct Script {
        std::string first, last;  ///< commands
        std::int64_t lines = 0;
        bool of_job = false;
        std::size_t bytes = 0;
    };
    struct Failure {
        Script script;
        std::string why;
    };
    struct Heater {
        double degrees = 0, target = 0;
    };
    /// A command that waits for a heater, and how it is waited for.
    struct HeatWait {
        std::string command;
        std::string heater;
        double degrees = 0;
        std::string heat;  ///< the command that sets the temperature only
        double since = 0;
    };
    struct Dialog {
        UserWait wait;
        std::vector<std::string> commands{};  ///< of each button
        bool shown = false;
    };

    void ask(Asked what, const char* method, const nlohmann::ordered_json& params);
    void on_answer(Asked what, const KlipperMessage& message, double now);
    void on_info(const nlohmann::ordered_json& info, double now);
    void on_objects(const nlohmann::ordered_json& content);
    void on_subscribed(const nlohmann::ordered_json& status, double now);
    void on_status(const nlohmann::ordered_json& status, double now);
    void on_heaters(const nlohmann::ordered_json& status);
    void on_output(std::string_view text);
    void on_action(std::string_view text);
    void on_prompt(std::string_view text);
    void on_script(const KlipperMessage& message, double now);
    void on_cause(const nlohmann::ordered_json& info);
    void refuse(const Failure& failure);
    void note_pause(bool paused);

    bool awaits(Asked what) const;
    /// Returns true if Klipper has nothing to do although the job goes on.
    bool rests() const { return !script_ && !failing_ && sent_job_ > 0 && !finish_sent_; }
    void send_script(std::deque<std::string>& lines, bool of_job, double now);
    bool waits_for_heat(const std::string& command, double now);
    std::optional<HeatWait> heat_wait(const std::string& command) const;

    State state_ = State::idle;
    double state_until_ = 0;
    double give_up_at_ = 0;
    std::string remark_;
    std::int64_t next_id_ = 1;
    std::map<std::int64_t, Asked> asked_;  // requests that are not answered
    KlipperFrames frames_;

    std::optional<Script> script_;    // on its way
    std::optional<Failure> failing_;  // a script that has failed, while the cause is asked for
    std::int64_t sent_job_ = 0;
    std::deque<std::int64_t> part_ends_;  // numbers of the last lines of parts that are not sent
    bool finish_sent_ = false;
    double rests_since_ = 0;  // when the last script was answered
    std::optional<HeatWait> warming_;

    std::map<std::string, Heater> heaters_;
    std::string extruder_ = "extruder";  // the active one
    std::string homed_axes_;
    bool takes_height_ = false;
    bool pauses_ = false;  // has pause_resume
    bool paused_ = false;  // Klipper has paused by itself
    double print_time_ = 0, machine_time_ = 0;
    double dry_at_ = 0;
    std::string busy_with_;  // a print of Klipper's own
    std::optional<Dialog> dialog_;
    std::set<std::string> unknown_;  // texts on unknown commands that were told
};

}  // namespace lamella
