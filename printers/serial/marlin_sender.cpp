// MarlinSender: window, kept lines, and timeouts.
#include "printers/serial/marlin_sender.h"

#include <algorithm>
#include <array>

#include "printers/serial/gcode_line.h"

namespace lamella {
namespace {

constexpr std::int64_t history = 1000;         // answered lines that are kept
constexpr std::int64_t marker_interval = 256;  // lines between two M105 that check the count
constexpr double sync_patience = 2;            // s to wait for an answer to the first line
constexpr int sync_most = 10;
constexpr int sync_hopeless = 3;        // where what arrives is no answer of a printer
constexpr double impatient = 3;         // s without an ok from firmware that reports when it is busy
constexpr double patient = 30;          // s without an ok from any other firmware
constexpr double slow_impatient = 4.5;  // s for slow commands: busy lines come every 2 s
constexpr double slow_patient = 60;
constexpr int max_tickles = 20;
constexpr int silent_tickles = 5;
constexpr double careful_pause = 0.1;  // s between lines on a link with faults, unless all lines are answered
constexpr double relink_patience = 3;  // s within which a restarted board reports it

bool is_any(const std::string& command, std::initializer_list<const char*> names) {
    const std::string word = command_word(command);
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return word == name; });
}

bool waits_for_person(const std::string& command) {
    return is_any(command, {"M0", "M1", "M226", "M600", "M701", "M702"});
}

bool waits_for_heat(const std::string& command) { return is_any(command, {"M109", "M190", "M191", "M303"}); }

bool takes_long(const std::string& command) {
    return waits_for_person(command) || waits_for_heat(command) ||
           is_any(command, {"G28", "G29", "G30", "G32", "G33", "G34", "G4", "M48", "M400"});
}

std::size_t wire_size(std::int64_t number, const std::string& command) {
    return numbered_line(number, command).size();
}

std::string first_line() {
    const std::string line = numbered_line(0, "M110 N0");
    return line.substr(0, line.size() - 1);
}

}  // namespace

MarlinSender::MarlinSender(SenderSettings settings, SenderListener listener)
    : LineSender(settings, std::move(listener), first_line()) {}

void MarlinSender::connect(double now) {
    state_ = State::greeting;
    state_until_ = now + settings_.greeting;
}

void MarlinSender::take_up_dialogue(double now) {
    // A port that is lost again while the printer is awaited must not begin the numbers anew.
    if (state_ != State::running && state_ != State::relinking) {
        sync_tries_ = 0;
        connect(now);
        return;
    }
    state_ = State::relinking;
    state_until_ = now + relink_patience;
    going_back_ = swallow_ok_ = false;
    recheck_at_ = probe_at_ = never;
    tickles_ = 0;
    sign_of_work_ = now;
}

void MarlinSender::sync(double now) {
    const FirstWordsKind heard = first_words_.kind();
    const bool hopeless = heard == FirstWordsKind::garbage || heard == FirstWordsKind::echo;
    if (++sync_tries_ > (hopeless ? sync_hopeless : sync_most)) {
        stop(StopKind::unanswered, first_words_.failure(baud()));
        return;
    }
    state_ = State::syncing;
    state_until_ = now + sync_patience;
    swallow_ok_ = false;
    transmit(first_line() + "\n", now);
}

void MarlinSender::probe() {
    state_ = State::asking;
    sent_.clear();
    base_ = cursor_ = next_ = 1;
    acked_ = last_marker_ = 0;
    urgent_.push_front("M105");
    urgent_.push_front("M115");
}

void MarlinSender::settle() {
    if (!known_firmware_ && !asked_again_) {
        asked_again_ = true;
        urgent_.push_front("M115");
        return;
    }
    // Unknown firmware may have a receive buffer of any size.
    if (!known_firmware_) settings_.ping_pong = true;
    if (reports_temperatures_) urgent_.push_front("M155 S1");
    state_ = State::running;
}

std::size_t MarlinSender::unanswered() const {
    std::size_t bytes = 0;
    for (std::int64_t n = acked_ + 1; n < cursor_; ++n) bytes += sent(n).size;
    return bytes;
}

bool MarlinSender::fits(std::size_t bytes, double now) const {
    if (paced() && now < wire_free_ + wire_gap()) return false;
    const std::size_t before = unanswered();
    if (before == 0) return true;
    if (settings_.ping_pong || state_ != State::running) return false;
    // Without an emergency parser, firmware reads the M108 that ends a wait only if no other line is before
    // it.
    if (waits_unanswered()) return false;
    if (cursor_ < careful_until_ && now < last_start_ + careful_pause) return false;
    // Send no more lines than free slots, if the printer reports their number, plus the line that runs.
    if (settings_.within_slots && max_slots_free_ >= 0 && cursor_ - 1 - acked_ > max_slots_free_)
        return false;
    return before + bytes <= settings_.window;
}

void MarlinSender::send(std::int64_t number, double now) {
    if (unanswered() == 0) sign_of_work_ = now;
    // After a pause the count of oks is uncertain.
    if (unanswered() > 0 && cursor_ < careful_until_) marker_due_ = !sent(number).marker;
    last_start_ = now;
    wire_free_ = std::max(now, wire_free_) + static_cast<double>(sent(number).size) * settings_.byte_time;
    const std::string line = numbered_line(number, sent(number).command);
    cursor_ = number + 1;
    if (number == asked_ && asked_sent_ < 0) asked_sent_ = now;
    transmit(line, now);
}

bool MarlinSender::send_command(const std::string& command, bool of_job, double now, bool forced) {
    const std::size_t size = wire_size(next_, command);
    if (!forced && !fits(size, now)) return false;
    if (of_job) ++job_lines_;
    const bool marker = command == "M105";
    if (marker) last_marker_ = next_, marker_due_ = false;
    machine_.apply(command);
    const bool waits = waits_for_heat(command) || waits_for_person(command);
    sent_.push_back({command, job_lines_, marker, takes_long(command), waits, size});
    send(next_++, now);
    drop_history();
    return true;
}

void MarlinSender::drop_history() {
    while (base_ + history <= acked_) {
        dropped_job_ = sent_.front().job;
        sent_.pop_front();
        ++base_;
    }
}

bool MarlinSender::send_new(double now) {
    const bool has_job = state_ == State::running && !held_ && !pending_.empty();
    const bool check = tells_temperatures_ && !numbers_oks_ && state_ == State::running;
    if (check && (marker_due_ || (has_job && next_ - last_marker_ >= marker_interval)))
        return send_command("M105", false, now, false);
    if (!urgent_.empty()) {
        if (!send_command(urgent_.front(), false, now, false)) return false;
        urgent_.pop_front();
        return true;
    }
    if (has_job) {
        if (!send_command(pending_.front(), true, now, false)) return false;
        pending_.pop_front();
        return true;
    }
    constexpr std::array<const char*, 3> last_lines{"M155 S0", "M400", "M105"};
    if (finishing_ && !held_ && state_ == State::running && finish_step_ < last_lines.size()) {
        if (finish_step_ == 0 && !reports_temperatures_) ++finish_step_;
        if (!send_command(last_lines[finish_step_], false, now, false)) return false;
        ++finish_step_;
        return true;
    }
    return false;
}

void MarlinSender::feed(double now) {
    last_fed_ = now;
    if (stop_ || going_back_) return;
    if (state_ == State::asking && urgent_.empty() && unanswered() == 0 && cursor_ == next_) settle();
    if (state_ != State::asking && state_ != State::running) return;
    while (cursor_ < next_) {
        if (!fits(sent(cursor_).size, now)) return;
        ++statistics_.repeated;
        send(cursor_, now);
    }
    while (send_new(now)) {
    }
}

bool MarlinSender::has_more() const {
    return cursor_ < next_ || !urgent_.empty() || marker_due_ || (!held_ && !pending_.empty()) ||
           (finishing_ && finish_step_ < 3);
}

double MarlinSender::wire_gap() const { return 10 * settings_.byte_time + 0.0001; }

bool MarlinSender::slow_unanswered() const {
    for (std::int64_t n = acked_ + 1; n < cursor_; ++n) {
        if (sent(n).slow) return true;
    }
    return false;
}

bool MarlinSender::waits_unanswered() const {
    for (std::int64_t n = acked_ + 1; n < cursor_; ++n) {
        if (sent(n).waits) return true;
    }
    return false;
}

double MarlinSender::patience() const {
    if (unanswered() == 0) return never;
    if (slow_unanswered()) return busy_seen_ ? slow_impatient : slow_patient;
    const bool busy_known = busy_seen_ || known_firmware_ || state_ == State::asking;
    // Firmware that is only assumed to report when it is busy gets more time before it is asked again.
    return busy_seen_ || (busy_known && tickles_ == 0) ? impatient : patient;
}

double MarlinSender::next_wake() const {
    if (state_ == State::idle) return never;
    if (state_ != State::running && state_ != State::asking) return state_until_;
    double at = going_back_ ? go_back_at_ : sign_of_work_ + patience();
    if (swallow_ok_) at = std::min(at, swallow_until_);
    if (!going_back_ && has_more()) {
        at = std::min(at, paced() ? wire_free_ + wire_gap() : never);
        if (cursor_ < careful_until_) at = std::min(at, last_start_ + careful_pause);
        // A step that is already due waits for an answer.
        if (at <= last_fed_) at = std::min({sign_of_work_ + patience(), recheck_at_, probe_at_});
    }
    return std::min({at, recheck_at_, probe_at_});
}

void MarlinSender::check_time(double now) {
    if (state_ == State::greeting || state_ == State::syncing) {
        if (now >= state_until_) sync(now);
        return;
    }
    if (state_ == State::relinking) {
        if (now < state_until_) return;
        state_ = State::running;
        sign_of_work_ = now;
        ask_for_answer(now);
        return;
    }
    if (state_ == State::idle) return;
    if (swallow_ok_ && now >= swallow_until_) swallow_ok_ = false;
    if (going_back_ && now >= go_back_at_) {
        going_back_ = false;
        sign_of_work_ = now;
    }
    if (now >= recheck_at_) {
        recheck_at_ = never;
        if (acked_ < asked_) go_back(asked_, now);
    }
    if (going_back_) return;
    const bool probe = now >= probe_at_;
    if (probe) probe_at_ = never;
    if (probe || now >= sign_of_work_ + patience()) tickle(now);
}

void MarlinSender::tickle(double now) {
    // Firmware that never reports when it is busy may be silent during homing, levelling or a wait for a
    // person. It is asked again while there is room, in case an answer was lost, but is not given up.
    const bool may_be_silent = !busy_seen_ && slow_unanswered();
    if (may_be_silent && tickles_ > 0 && heard_ < first_tickle_) {
        sign_of_work_ = now;
        return;
    }
    ++statistics_.timeouts;
    if (++tickles_ == 1) first_tickle_ = now;
    sign_of_work_ = now;
    if (tickles_ > silent_tickles && heard_ < first_tickle_) {
        stop(StopKind::unanswered, "the printer is silent: it answered none of the last " +
                                       std::to_string(silent_tickles) + " lines");
        return;
    }
    if (tickles_ > max_tickles) {
        stop(StopKind::unanswered, "the printer talks but answers no line any more");
        return;
    }
    ask_for_answer(now);
}

/// Sends a line whose answer tells what was lost. Does not repeat the unanswered line: Marlin 2 silently
/// drops a line that it has already accepted. The next line gets an answer in either case.
void MarlinSender::ask_for_answer(double now) {
    if (cursor_ < next_) {
        ++statistics_.repeated;
        send(cursor_, now);
    } else {
        tickled_ = next_;
        send_command("M105", false, now, true);
    }
}

LineWait MarlinSender::line_wait() const {
    if (acked_ + 1 >= cursor_ || acked_ + 1 < base_) return LineWait::none;
    const Sent& oldest = sent(acked_ + 1);
    if (waits_for_heat(oldest.command)) return LineWait::heat;
    if (waits_for_person(oldest.command)) return LineWait::person;
    const bool dwells = is_any(oldest.command, {"G4", "M400"});
    return oldest.slow && !dwells ? LineWait::other : LineWait::none;
}

bool MarlinSender::finished() const {
    return finishing_ && !held_ && finish_step_ == 3 && idle() && cursor_ == next_ && !going_back_;
}

void MarlinSender::halt(double now) {
    stop(StopKind::halted, "halted");
    (void)now;
    // Sent without line numbers: the emergency parser matches only plain commands.
    transmit_raw("M108\nM112\n", true);
}

// Both commands go without a line number, ahead of the waiting lines. Their oks answer no numbered line, so
// the count is corrected afterwards.
void MarlinSender::end_waiting() {
    transmit_raw("M108\n", true);
    marker_due_ = true;
    dialog_.reset();
}

void MarlinSender::choose(std::size_t button) {
    if (!dialog_ || button >= dialog_->buttons.size()) return;
    transmit_raw("M876 S" + std::to_string(button) + "\n", true);
    marker_due_ = true;
    dialog_.reset();
}

std::optional<UserWait> MarlinSender::user_wait() const {
    if (dialog_ && dialog_shown_) return dialog_;
    const bool has_line = unanswered() > 0 && acked_ + 1 >= base_;
    const std::string command = has_line ? sent(acked_ + 1).command : std::string();
    if (!paused_for_user_ && !waits_for_person(command)) return std::nullopt;
    return UserWait{command.empty() ? "the printer is paused for a person" : command};
}

}  // namespace lamella
