// LineSender: a dialect of sending G-code lines and hearing their answers, without any port or clock.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "printers/serial/machine_state.h"
#include "printers/serial/reply.h"

namespace lamella {

struct SenderSettings {
    std::size_t window = 127;   ///< bytes that may be unanswered; one less than the printer's receive buffer
    bool ping_pong = false;     ///< one line at a time
    bool within_slots = false;  ///< no more lines than the printer has slots for, if it tells (ADVANCED_OK)
    double greeting = 3;        ///< s that a board which was reset by opening the port may stay silent
    double byte_time = 10.0 / 250000;  ///< s that a byte takes on the wire
};

/// Why a sender has stopped for good.
enum class StopKind : unsigned char {
    fatal,       ///< the printer has given up
    reset,       ///< its board has begun anew
    unanswered,  ///< no answer comes any more
    lost_count,  ///< it asks for a line that it cannot want
    refused,     ///< GRBL has refused a line or raised an alarm
    halted       ///< on our demand
};

struct SenderStop {
    StopKind kind{};
    std::string why;
};

/// What is counted on the way.
struct SenderStatistics {
    std::int64_t lines = 0;     ///< sent, repeats included
    std::int64_t bytes = 0;     ///< sent
    std::int64_t repeated = 0;  ///< of `lines`
    std::int64_t resends = 0;   ///< rounds of going back that the printer asked for
    std::int64_t timeouts = 0;  ///< answers that did not come
    std::int64_t surplus = 0;   ///< answers to nothing
    std::int64_t advanced = 0;  ///< answers that told how full the planner is
    std::int64_t starved = 0;   ///< of these: more than half of it was empty
    double longest_gap = 0;     ///< s between two lines
};

/// Told as things happen; each may be empty.
struct SenderListener {
    /// A line that went out ('>') or came in ('<'), with the bytes then unanswered.
    std::function<void(char direction, std::string_view line, std::size_t in_flight)> on_line{};
    /// What the printer asks of the host: "pause", "paused", "resume", "resumed", "cancel", "disconnect".
    std::function<void(const std::string& action)> on_action{};
};

/// What a printer waits for a person to do.
struct UserWait {
    std::string text;                    ///< in the printer's words, or the command that waits
    std::vector<std::string> buttons{};  ///< to choose from, in the order of their numbers; may be none
};

/// Driven by bytes that came, by the time (s, any origin), and by taking the bytes to send. Lines are given
/// clean (clean_command) and are sent in order.
class LineSender {
  public:
    static constexpr double never = std::numeric_limits<double>::infinity();

    LineSender(SenderSettings settings, SenderListener listener)
        : settings_(settings), listener_(std::move(listener)) {}
    virtual ~LineSender() = default;
    LineSender(const LineSender&) = delete;
    LineSender& operator=(const LineSender&) = delete;

    /// The port is open: gets to know the printer.
    virtual void connect(double now) = 0;
    /// The port was lost and is open again. Goes on where the printer stands, unless it was reset.
    virtual void reconnect(double now) = 0;
    /// What came from the printer.
    void receive(std::string_view bytes, double now);
    /// Does what has become due.
    void tick(double now);
    /// When `tick` is to be called at the latest; `never` while only an answer can change anything.
    virtual double wake_at() const = 0;

    /// Appends a line of the job.
    void push(std::string command) { pending_.push_back(std::move(command)); }
    /// Puts a line of the host's own before those of the job; it does not count as one of them.
    void interject(std::string command) { urgent_.push_back(std::move(command)); }
    /// Lines of the job not sent yet.
    std::size_t pending() const { return pending_.size(); }
    /// While held, no line of the job is sent; the host's own are.
    void hold(bool held) { held_ = held; }
    /// Stops or goes on with the motion itself, where the machine can.
    virtual void hold_motion(bool /*held*/) {}
    /// Forgets what was not sent yet.
    void drop_pending() { pending_.clear(), urgent_.clear(); }
    /// Nothing to send and nothing unanswered.
    bool idle() const { return pending_.empty() && urgent_.empty() && unanswered() == 0; }
    /// Nothing of the host's own to send, nothing unanswered.
    bool quiet() const { return urgent_.empty() && unanswered() == 0; }
    /// Lines of the job that are answered, from its first one on.
    std::int64_t answered() const { return answered_job_; }
    /// Bytes that are sent and unanswered.
    virtual std::size_t unanswered() const = 0;
    /// The printer is known and lines are taken.
    virtual bool connected() const = 0;
    /// Makes sure of the last answers: sends what waits for the end of all motion.
    void finish() { finishing_ = true; }
    virtual bool finished() const = 0;

    /// Stops at once, as far as the printer can: Marlin halts until it is reset, GRBL holds.
    virtual void halt(double now) = 0;
    /// Whether `halt` works past lines that wait.
    virtual bool halts_at_once() const = 0;
    /// Ends a heat-up that the printer waits in, and its waiting for a person.
    virtual void end_waiting() = 0;
    /// What the printer waits for a person to do; empty while it waits for none. `end_waiting` says that it
    /// is done, `choose` which button was pressed.
    virtual std::optional<UserWait> user_wait() const = 0;
    virtual void choose(std::size_t) {}

    const std::optional<SenderStop>& stopped() const { return stop_; }
    /// The bytes to send now; `wrote` says how many of them are gone.
    std::string_view output() const { return std::string_view(out_).substr(out_at_); }
    void wrote(std::size_t bytes);
    const SenderStatistics& statistics() const { return statistics_; }
    /// What the machine does once it has done all that was sent.
    const MachineState& machine() const { return machine_; }
    const Temperatures& temperatures() const { return temperatures_; }
    const std::string& firmware() const { return firmware_; }
    bool held() const { return held_; }

  protected:
    virtual void handle(const Reply& reply, double now) = 0;
    virtual void check_time(double now) = 0;
    /// Sends what may be sent.
    virtual void feed(double now) = 0;

    void transmit(std::string_view line, double now);
    /// Bytes that are no line of the stream; what is half out is ended first when `on_own_line`.
    void transmit_raw(std::string_view bytes, bool on_own_line);
    void stop(StopKind kind, std::string why);
    /// Throws away what the wire has lost.
    void forget_wire();

    SenderSettings settings_;
    SenderListener listener_;
    std::deque<std::string> pending_;
    std::deque<std::string> urgent_;
    bool held_ = false;
    bool finishing_ = false;
    std::int64_t answered_job_ = 0;
    std::optional<SenderStop> stop_;
    SenderStatistics statistics_;
    MachineState machine_;
    Temperatures temperatures_;
    std::string firmware_;
    double heard_ = 0;  // when the last byte came

  private:
    std::string out_;
    std::size_t out_at_ = 0;
    bool line_cut_ = false;  // stopped in the middle of a line
    ReplyLines replies_;
    double last_line_ = -1;
};

}  // namespace lamella
