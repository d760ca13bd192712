// MarlinSender: sends numbered lines with checksums to Marlin and recovers from every loss of count.
#pragma once

#include "printers/serial/line_sender.h"

namespace lamella {

/// Keeps at most a window of bytes unanswered, so that the receive buffer never overflows and the printer
/// never waits for the host. Every line is numbered; the printer alone decides which line is next, and
/// executes none twice. Oks only pace the stream. They carry no number, so their count drifts when some are
/// lost or surplus. A numbered M105, whose answer differs from any other ok, corrects the count: after every
/// disturbance, and from time to time. Firmware with ADVANCED_OK reports the line number in each ok.
///
/// On connection N0 M110 N0 sets the printer's line number. M115 and M105, sent one at a time, then tell what
/// the firmware can do. Lines of the job follow only after that.
class MarlinSender : public LineSender {
  public:
    MarlinSender(SenderSettings settings, SenderListener listener);

    void connect(double now) override;
    std::size_t unanswered() const override;
    bool connected() const override { return state_ == State::running; }
    bool finished() const override;
    void halt(double now) override;
    bool halts_at_once() const override { return emergency_parser_; }
    void end_waiting() override;
    std::optional<UserWait> user_wait() const override;
    void choose(std::size_t button) override;
    LineWait line_wait() const override;
    bool can_pause() const override { return !pending_.empty() || finish_step_ == 0; }

    /// Returns the number of the next new line.
    std::int64_t next_number() const { return next_; }

  protected:
    void handle(const Reply& reply, double now) override;
    void check_time(double now) override;
    double next_wake() const override;
    void take_up_dialogue(double now) override;
    void feed(double now) override;

  private:
    enum class State : unsigned char { idle, greeting, syncing, asking, running, relinking };
    /// A sent line, kept in case the printer asks for it again.
    struct Sent {
        std::string command;
        std::int64_t job = 0;  ///< number of lines of the job up to and including this one
        bool marker = false;   ///< is an M105, whose ok reports temperatures
        bool slow = false;     ///< may take minutes
        bool waits = false;    ///< waits for heat or a person: nothing is sent after it until it is answered
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
    void note_reason(const Reply& reply, double now);
    void sync(double now);
    void settle();
    void probe();
    void tickle(double now);
    void ask_for_answer(double now);
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

    // Lines base_ .. next_-1 are kept. Lines up to acked_ are answered. cursor_ is the next line to send.
    std::deque<Sent> sent_;
    std::int64_t base_ = 1;
    std::int64_t acked_ = 0;
    std::int64_t cursor_ = 1;
    std::int64_t next_ = 1;
    std::int64_t job_lines_ = 0;
    std::int64_t dropped_job_ = 0;  // Sent::job of line base_ - 1

    // The ok that follows a resend request answers no line.
    bool swallow_ok_ = false;
    double swallow_until_ = 0;
    // A rewind waits until the wire is quiet. Bytes still on the wire make the printer ask again and discard
    // what it has received.
    bool going_back_ = false;
    double go_back_at_ = 0;
    std::int64_t asked_ = -1;  // line of the last resend request
    int asked_times_ = 0;
    double asked_sent_ = -1;  // when that line was sent again; < 0: not yet
    double recheck_at_ = never;
    std::int64_t impossible_ = -1;
    double probe_at_ = never;
    // A printer that asks for a line discards its receive buffer. If that cuts the next line between its
    // number and its command, the printer executes the rest as a command without a number. Therefore each
    // line on the wire is followed by a gap in which the printer can process it, and on a link with faults a
    // line is rarely sent while another one is unanswered.
    std::int64_t careful_until_ = 0;
    double last_start_ = 0;
    double wire_free_ = 0;
    double last_fed_ = 0;
    bool real_wire_ = true;  // false once an answer came sooner than the bytes could travel at this baud rate

    bool paused_for_user_ = false;  // the last busy line reported a wait for a person
    std::optional<UserWait> dialog_;
    std::int64_t dialog_line_ = 0;  // the line whose answer ends the dialog at the latest
    bool dialog_shown_ = false;

    bool busy_seen_ = false;
    double sign_of_work_ = 0;  // last ok, busy or heating line, or first line after a pause
    int tickles_ = 0;          // timeouts in a row without an ok
    double first_tickle_ = 0;
    std::int64_t tickled_ = -1;
    bool tells_temperatures_ = false;  // M105 is answered by "ok T:"
    bool marker_due_ = false;
    std::int64_t last_marker_ = 0;
    bool numbers_oks_ = false;  // the firmware has ADVANCED_OK

    std::string reason_;       // what the printer said last beside its answers
    double reason_at_ = -1e9;  // when

    bool emergency_parser_ = false;
    bool reports_temperatures_ = false;
    bool known_firmware_ = false;
    bool asked_again_ = false;
    int max_planner_free_ = 0;
    int max_slots_free_ = -1;

    // Steps of the end: reports off, all motion done, and an answer that can only belong to the last line.
    std::size_t finish_step_ = 0;
    int barriers_ = 0;
};

}  // namespace lamella
