// LineSender: protocol of sending G-code lines and reading the answers, without a port or a clock.
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

#include "printers/serial/first_words.h"
#include "printers/serial/machine_state.h"
#include "printers/serial/reply.h"

namespace lamella {

struct SenderSettings {
    std::size_t window = 127;   ///< most bytes unanswered; one less than the printer's receive buffer
    bool ping_pong = false;     ///< send one line at a time
    bool within_slots = false;  ///< send no more lines than the printer reports free slots (ADVANCED_OK)
    double greeting = 3;        ///< time that a board reset by opening the port may stay silent, s
    double byte_time = 10.0 / 250000;  ///< time of a byte on the wire, s
};

/// Why a sender has stopped for good.
enum class StopKind : unsigned char {
    fatal,       ///< the printer has halted itself
    reset,       ///< the printer's board has restarted
    unanswered,  ///< no answers arrive any more
    lost_count,  ///< the printer asks for a line that it cannot need
    refused,     ///< the machine refuses a line, has raised an alarm, or takes no job
    halted       ///< halted on request of the host
};

struct SenderStop {
    StopKind kind{};
    std::string why;
};

/// Counters of a sender.
struct SenderStatistics {
    std::int64_t lines = 0;     ///< lines sent, repeats included
    std::int64_t bytes = 0;     ///< bytes sent
    std::int64_t repeated = 0;  ///< lines that were repeats
    std::int64_t resends = 0;   ///< rewinds that the printer asked for
    std::int64_t timeouts = 0;  ///< timeouts while waiting for an answer
    std::int64_t surplus = 0;   ///< answers that matched no line
    std::int64_t advanced = 0;  ///< answers that reported the planner's free space
    std::int64_t starved = 0;   ///< of those: the planner was more than half empty
    double longest_gap = 0;     ///< longest time between two lines, s
};

/// Callbacks of a sender; each may be empty.
struct SenderListener {
    /// Called for each line sent ('>') or received ('<'), with the number of unanswered bytes at that time.
    std::function<void(char direction, std::string_view line, std::size_t in_flight)> on_line{};
    /// Called when the printer asks the host for an action: "pause", "paused", "resume", "resumed", "cancel",
    /// "disconnect".
    std::function<void(const std::string& action)> on_action{};
    /// Called with what the printer tells people (see message_of).
    std::function<void(const std::string& text)> on_message{};
};

/// A request to a person that the printer is waiting for.
struct UserWait {
    std::string text;                    ///< the printer's text, or the command that waits
    std::vector<std::string> buttons{};  ///< buttons to choose from, by index; may be empty
};

/// What the oldest unanswered line keeps the printer from going on for.
enum class LineWait : unsigned char {
    none,    ///< motion, or nothing
    heat,    ///< a temperature
    person,  ///< a person
    other    ///< homing, levelling, or another command whose time is not known
};

/// A state machine driven by received bytes and by the time (s, any origin). The caller writes `output` to
/// the port. Lines must be clean (see clean_command) and are sent in order.
///
/// A loop that sends one line over any port:
///
///     MarlinSender sender(SenderSettings{}, SenderListener{});
///     sender.connect(now());
///     sender.push(clean_command("G1 X10 F3000"));
///     sender.finish();
///     while (!sender.finished() && !sender.stopped()) {
///         sender.receive(read_port(), now());
///         sender.tick(now());
///         sender.wrote(write_port(sender.output()));
///     }
class LineSender {
  public:
    static constexpr double never = std::numeric_limits<double>::infinity();

    /// `request` is the line that asks the printer for its first answer.
    LineSender(SenderSettings settings, SenderListener listener, std::string request)
        : settings_(settings), listener_(std::move(listener)), first_words_(std::move(request)) {}
    virtual ~LineSender() = default;
    LineSender(const LineSender&) = delete;
    LineSender& operator=(const LineSender&) = delete;

    /// Starts the dialogue with the printer. Call when the port has been opened.
    virtual void connect(double now) = 0;
    /// Tells that the port is lost. Nothing is sent, counted or timed until `reconnect`.
    void disconnect();
    /// Resumes after the port was lost and opened again, at the line where the printer stands, unless the
    /// printer was reset. All timeouts begin anew.
    void reconnect(double now);
    /// Takes bytes received from the printer.
    void receive(std::string_view bytes, double now);
    /// Handles timeouts and sends the lines that may be sent.
    void tick(double now);
    /// Returns the latest time of the next call of `tick`; `never` if only an answer can change anything.
    double wake_at() const { return stop_ || lost_ ? never : next_wake(); }

    /// Appends a line of the job.
    void push(std::string command) { pending_.push_back(std::move(command)); }
    /// Tells that a part of the job, such as a layer, ends with the line that was appended last.
    virtual void end_part() {}
    /// Inserts a line of the host before those of the job. It does not count as a line of the job.
    void interject(std::string command) { urgent_.push_back(std::move(command)); }
    /// Returns the number of lines of the job that are not sent yet.
    std::size_t pending() const { return pending_.size(); }
    /// Holds back the lines of the job; lines of the host are still sent.
    void hold(bool held) { held_ = held; }
    /// Pauses or continues the motion itself, if the machine can do so.
    virtual void hold_motion(bool /*held*/) {}
    /// Ends a pause of the machine's own without going on.
    virtual void forget_pause() {}
    /// Returns the number of lines of the host that are not sent yet.
    std::size_t host_lines() const { return urgent_.size(); }
    void drop_host_lines() { urgent_.clear(); }
    /// Discards all lines that are not sent yet.
    void drop_pending() { pending_.clear(), urgent_.clear(); }
    /// Returns true if nothing is left to send and nothing is unanswered.
    bool idle() const { return pending_.empty() && urgent_.empty() && unanswered() == 0; }
    /// Returns true if no line of the host is left to send and nothing is unanswered.
    bool quiet() const { return urgent_.empty() && unanswered() == 0; }
    /// Returns the number of answered lines of the job, counted from its first line.
    std::int64_t answered() const { return answered_job_; }
    /// Returns the number of bytes sent and not answered.
    virtual std::size_t unanswered() const = 0;
    /// Returns true once the printer is known and accepts lines.
    virtual bool connected() const = 0;
    /// Ends the job: after its last line, sends a command that is answered only when all motion is done.
    void finish() { finishing_ = true; }
    virtual bool finished() const = 0;

    /// Stops immediately, as far as the printer supports it: Marlin halts until it is reset, GRBL holds and
    /// is then reset.
    virtual void halt(double now) = 0;
    /// Returns true if `halt` takes effect before the lines that are still waiting.
    virtual bool halts_at_once() const = 0;
    /// Returns true if a print that is cancelled is to be halted, false if it is to be ended cleanly.
    virtual bool cancel_halts() const { return halts_at_once(); }
    /// Ends a heat-up that the printer waits for, or its wait for a person.
    virtual void end_waiting() = 0;
    /// Returns the request to a person that the printer is waiting for; empty if there is none. Answer it by
    /// `end_waiting` (done) or `choose` (button pressed).
    virtual std::optional<UserWait> user_wait() const = 0;
    virtual void choose(std::size_t) {}
    /// Returns what the oldest unanswered line waits for.
    virtual LineWait line_wait() const = 0;
    /// Returns true if a pause can still keep a line of the job from being executed.
    virtual bool can_pause() const { return true; }
    /// Returns why no line of the job is sent any more, although the machine still takes lines of the host;
    /// empty if the job goes on.
    const std::optional<std::string>& refused() const { return refused_; }
    /// Returns the time at which the machine will have done all that it has answered, if it tells this.
    virtual double dry_at() const { return 0; }
    /// Returns true if the machine knows the height of its nozzle, so that it need not be told.
    virtual bool knows_height() const { return false; }
    /// Returns true if the machine can be told the height of its nozzle.
    virtual bool takes_height() const { return true; }
    /// Returns what is known of the port before the printer is, as a clause without a full stop.
    virtual std::string remark() const { return first_words_.remark(baud()); }
    /// Returns what the port has said before the printer was known.
    const FirstWords& first_words() const { return first_words_; }
    int baud() const;
    /// Returns the most bytes that may be unanswered; 0 if lines are sent one at a time.
    std::size_t bytes_ahead() const { return settings_.ping_pong ? 0 : settings_.window; }

    const std::optional<SenderStop>& stopped() const { return stop_; }
    /// Returns the bytes to send now. Call `wrote` with the number of bytes that were written.
    std::string_view output() const { return std::string_view(out_).substr(out_at_); }
    void wrote(std::size_t bytes);
    const SenderStatistics& statistics() const { return statistics_; }
    /// Returns the state of the machine after all lines sent so far.
    const MachineState& machine() const { return machine_; }
    const Temperatures& temperatures() const { return temperatures_; }
    const std::string& firmware() const { return firmware_; }
    bool held() const { return held_; }

  protected:
    virtual void handle(const Reply& reply, double now) = 0;
    virtual void check_time(double now) = 0;
    /// Returns the latest time of the next call of `tick` while the port is there.
    virtual double next_wake() const = 0;
    /// Resumes the dialogue over a port that is back.
    virtual void take_up_dialogue(double now) = 0;
    /// Notes that the port is lost.
    virtual void drop_dialogue() {}
    /// Takes bytes from the port apart and handles what they say.
    virtual void read(std::string_view bytes, double now);
    /// Tells the listener of a line from the printer.
    void log_received(std::string_view line) const;
    /// Counts a line that is sent, and tells the listener of it.
    void log_sent(std::string_view line, double now);
    /// Appends bytes to the output. They count as sent.
    void put(std::string_view bytes);
    /// Sends the lines that may be sent now.
    virtual void feed(double now) = 0;

    void transmit(std::string_view line, double now);
    /// Sends bytes outside the stream of lines. With `on_own_line`, a partly sent line is ended first.
    void transmit_raw(std::string_view bytes, bool on_own_line);
    void stop(StopKind kind, std::string why);

    SenderSettings settings_;
    SenderListener listener_;
    std::deque<std::string> pending_;
    std::deque<std::string> urgent_;
    bool held_ = false;
    bool finishing_ = false;
    std::int64_t answered_job_ = 0;
    std::optional<SenderStop> stop_;
    std::optional<std::string> refused_;
    char end_of_line_ = '\n';  // byte that ends what is sent as one
    SenderStatistics statistics_;
    MachineState machine_;
    Temperatures temperatures_;
    std::string firmware_;
    FirstWords first_words_;
    double heard_ = 0;  // time of the last received byte

  private:
    void forget_wire();

    std::string out_;
    std::size_t out_at_ = 0;
    bool lost_ = false;      // the port is lost
    bool line_cut_ = false;  // output stopped in the middle of a line
    ReplyLines replies_;
    double last_line_ = -1;
};

}  // namespace lamella
