// MarlinSender: numbered lines with checksums, a window of unanswered bytes, and every way of losing count.
#pragma once

#include "printers/serial/line_sender.h"

namespace lamella {

/// Keeps at most a window of bytes unanswered, so that the receive buffer never overflows and the printer
/// never waits for the host. Every line is numbered; the printer alone decides which line is next, and
/// executes none twice. Oks only pace the stream; since they carry no number, their count drifts when some
/// are lost or surplus. A numbered M105, whose answer is told apart from any other ok, puts it right: after
/// every disturbance, and now and then. Firmware with ADVANCED_OK tells the number in each ok.
///
/// Lines that do not count as sent until known: the printer's line number starts at N0 M110 N0, then M115 and
/// M105 in single file tell what it can do.
class MarlinSender : public LineSender {
  public:
    using LineSender::LineSender;

    void connect(double now) override;
    void reconnect(double now) override;
    double wake_at() const override;
    std::size_t unanswered() const override;
    bool connected() const override { return state_ == State::running; }
    bool finished() const override;
    void halt(double now) override;
    bool halts_at_once() const override { return emergency_parser_; }
    void end_waiting() override;
    std::optional<UserWait> user_wait() const override;
    void choose(std::size_t button) override;

    /// Number of the next line that was never sent.
    std::int64_t next_number() const { return next_; }

  protected:
    void handle(const Reply& reply, double now) override;
    void check_time(double now) override;
    void feed(double now) override;

  private:
    enum class State : unsigned char { idle, greeting, syncing, asking, running, relinking };
    /// A line that was sent, kept for the printer to ask for again.
    struct Sent {
        std::string command;
        std::int64_t job = 0;  ///< lines of the job up to and including it
        bool marker = false;   ///< an M105, whose ok tells temperatures
        bool slow = false;     ///< may take minutes
        bool waits = false;    ///< for heat or for a person: nothing is sent behind it until it is answered
        std::size_t size = 0;  ///< bytes on the wire
    };

    void on_ok(const Reply& reply, double now);
    void on_resend(std::int64_t number, double now);
    void go_back(std::int64_t number, double now);
    void on_impossible(std::int64_t number, double now);
    void on_capability(const std::string& text);
    void on_firmware(const std::string& text);
    void on_action(const std::string& text);
    void on_prompt(std::string_view text);
    void acknowledge(std::int64_t number);
    void note_planner(const Reply& reply);
    void sync(double now);
    void settle();
    void probe();
    void tickle(double now);
    bool send_new(double now);
    bool send_command(const std::string& command, bool of_job, double now, bool forced);
    void send(std::int64_t number, double now);
    bool fits(std::size_t bytes, double now) const;
    bool has_more() const;
    double wire_gap() const;
    bool paced() const { return real_wire_ && settings_.byte_time > 0; }
    double patience() const;
    bool slow_unanswered() const;
    bool waits_unanswered() const;
    std::optional<std::int64_t> marker_answered() const;
    void drop_history();
    Sent& sent(std::int64_t number) { return sent_[static_cast<std::size_t>(number - base_)]; }
    const Sent& sent(std::int64_t number) const { return sent_[static_cast<std::size_t>(number - base_)]; }

    State state_ = State::idle;
    double state_until_ = 0;
    int sync_tries_ = 0;

    // Lines base_ .. next_-1 are kept; up to acked_ they are answered; cursor_ is the one to send next.
    std::deque<Sent> sent_;
    std::int64_t base_ = 1;
    std::int64_t acked_ = 0;
    std::int64_t cursor_ = 1;
    std::int64_t next_ = 1;
    std::int64_t job_lines_ = 0;
    std::int64_t dropped_job_ = 0;  // Sent::job of line base_ - 1

    // The oks of resends, which answer nothing.
    bool swallow_ok_ = false;
    double swallow_until_ = 0;
    // Going back waits until the wire is quiet: what is still on it makes the printer ask again and throw
    // away what it has received.
    bool going_back_ = false;
    double go_back_at_ = 0;
    std::int64_t asked_ = -1;  // the line asked for last
    int asked_times_ = 0;
    double asked_sent_ = -1;  // when it was sent again; < 0: not yet
    double recheck_at_ = never;
    std::int64_t impossible_ = -1;
    double probe_at_ = never;
    // A printer that asks for a line throws away what it has received. Where that cuts the line behind in two
    // between its number and its command, it executes the rest as a command without a number. Therefore no
    // line follows another on the wire without a gap in which the printer can look at it; and on a link with
    // faults hardly any line follows one that is unanswered.
    std::int64_t careful_until_ = 0;
    double last_start_ = 0;
    double wire_free_ = 0;
    double last_fed_ = 0;
    bool real_wire_ = true;  // answers never come sooner than bytes could go over a wire of this speed

    bool paused_for_user_ = false;  // the last busy line said so
    std::optional<UserWait> dialog_;
    bool dialog_shown_ = false;

    bool busy_seen_ = false;
    double sign_of_work_ = 0;  // last ok, busy or heating line, or the first line after a pause
    int tickles_ = 0;          // in a row without an ok
    double first_tickle_ = 0;
    std::int64_t tickled_ = -1;
    bool tells_temperatures_ = false;  // M105 is answered by "ok T:"
    bool marker_due_ = false;
    std::int64_t last_marker_ = 0;
    bool numbers_oks_ = false;  // ADVANCED_OK

    bool emergency_parser_ = false;
    bool reports_temperatures_ = false;
    bool known_firmware_ = false;
    bool asked_again_ = false;
    int max_planner_free_ = 0;
    int max_slots_free_ = -1;

    // The end: reports off, all motion done, and an answer that can only be that of the last line.
    std::size_t finish_step_ = 0;
    int barriers_ = 0;
};

}  // namespace lamella
