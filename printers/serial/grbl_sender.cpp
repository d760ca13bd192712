// Character counting, status reports, and the controlled stop.
#include "printers/serial/grbl_sender.h"

#include <algorithm>

#include "printers/serial/gcode_line.h"

namespace lamella {
namespace {

constexpr double grbl_status_interval = 0.2;  // s; more frequent requests load the reply line
constexpr double ask_patience = 2;            // s
constexpr int max_tries = 10;
constexpr int hopeless_tries = 3;    // where what arrives is no answer of GRBL
constexpr double idle_patience = 3;  // s that GRBL may be idle with lines unanswered
constexpr double hold_interval = 0.1;
constexpr double hold_patience = 5;  // s from the hold to standstill

bool goes_alone(const std::string& command) {
    const std::string word = command_word(command);
    return command[0] == '$' || word == "G10" || word == "G28.1" || word == "G30.1";
}

/// Returns a remedy for an error whose cause is not the line itself.
std::string error_hint(std::int64_t error) {
    if (error == 9) return " (it is locked: home it with $H, or unlock it with $X)";
    return {};
}

}  // namespace

void GrblSender::connect(double now) {
    state_ = State::greeting;
    state_until_ = now + settings_.greeting;
}

void GrblSender::take_up_dialogue(double now) {
    if (state_ == State::idle || state_ == State::greeting || state_ == State::asking) {
        tries_ = 0;
        connect(now);
        return;
    }
    stop(StopKind::unanswered,
         "the line to GRBL was lost: without line numbers nobody knows what it has received");
}

void GrblSender::hold_motion(bool held) {
    motion_held_ = held;
    machine_status_.clear();
    transmit_raw(held ? "!" : "~", false);
}

std::optional<UserWait> GrblSender::user_wait() const {
    const bool held = machine_status_.starts_with("Hold") || machine_status_.starts_with("Door");
    if (!held || motion_held_ || state_ != State::running) return std::nullopt;
    if (machine_status_.starts_with("Door")) return UserWait{"the safety door is open"};
    const bool pause = !sent_.empty() && command_word(sent_.front().command) == "M0";
    return UserWait{pause ? "M0: a pause that the job asks for" : "the machine is held"};
}

LineWait GrblSender::line_wait() const {
    if (sent_.empty()) return LineWait::none;
    const std::string word = command_word(sent_.front().command);
    if (word == "M0") return LineWait::person;
    return sent_.front().command.starts_with('$') ? LineWait::other : LineWait::none;
}

bool GrblSender::finished() const { return finishing_ && dwelt_ && idle(); }

double GrblSender::next_wake() const {
    if (state_ == State::idle) return never;
    return state_ == State::running || state_ == State::holding ? next_status_ : state_until_;
}

void GrblSender::check_time(double now) {
    if (state_ == State::idle) return;
    if (state_ == State::holding) {
        if (now >= state_until_) return reset("reset, but it was not seen to stand still: home it");
        if (now >= next_status_) transmit_raw("?", false), next_status_ = now + hold_interval;
        return;
    }
    if (state_ != State::running && now < state_until_) return;
    if (state_ == State::running) {
        if (now >= next_status_) {
            transmit_raw("?", false);
            next_status_ = now + grbl_status_interval;
        }
        if (idle_since_ >= 0 && bytes_ > 0 && now - idle_since_ > idle_patience) {
            stop(StopKind::lost_count, "GRBL is idle but has not answered line \"" + sent_.front().command +
                                           "\": bytes were lost on the line, and it cannot be told which");
        }
        return;
    }
    const FirstWordsKind heard = first_words_.kind();
    const bool hopeless = heard == FirstWordsKind::garbage || heard == FirstWordsKind::echo;
    if (++tries_ > (hopeless ? hopeless_tries : max_tries)) {
        stop(StopKind::unanswered, first_words_.failure(baud()));
        return;
    }
    state_ = State::asking;
    state_until_ = now + ask_patience;
    sent_ = {{"$I", 3, false, true}};
    bytes_ = 3;
    transmit("$I\n", now);
}

void GrblSender::refuse(const std::string& why) {
    stop(StopKind::refused, why);
    // The lines after it already wait in the machine: hold it before it runs them.
    transmit_raw("!", false);
}

void GrblSender::answer(const Reply& reply) {
    if (sent_.empty()) {
        ++statistics_.surplus;
        return;
    }
    const Sent first = sent_.front();
    sent_.pop_front();
    bytes_ -= first.size;
    idle_since_ = -1;
    if (first.job) ++answered_job_;
    if (reply.kind == ReplyKind::grbl_error && state_ == State::running) {
        const std::string which =
            first.job ? "line " + std::to_string(answered_job_) + " of the job" : "a line";
        refuse("GRBL refuses " + which + " (\"" + first.command + "\"): error " +
               std::to_string(*reply.number) + error_hint(*reply.number) + ". The machine is held");
    }
    if (state_ == State::asking) state_ = State::running;
}

void GrblSender::handle(const Reply& reply, double now) {
    switch (reply.kind) {
        case ReplyKind::ok:
        case ReplyKind::grbl_error:
            answer(reply);
            break;
        case ReplyKind::grbl_alarm:
            refuse("GRBL raises alarm " + std::to_string(*reply.number) + " near \"" +
                   (sent_.empty() ? std::string("the end") : sent_.front().command) +
                   "\": its position may be lost; unlock with $X or home with $H");
            break;
        case ReplyKind::grbl_banner:
            firmware_ = reply.text;
            if (state_ == State::running) {
                stop(StopKind::reset, "GRBL was reset (\"" + reply.text +
                                          "\"): work offset and modes are lost; nothing more is sent");
            } else {
                state_ = State::greeting;
                state_until_ = now + 0.1;
            }
            break;
        case ReplyKind::grbl_version:
            if (firmware_.empty()) firmware_ = "Grbl " + reply.text;
            break;
        case ReplyKind::reset:
        case ReplyKind::firmware:
            if (state_ != State::running &&
                (reply.kind == ReplyKind::reset || reply.text.starts_with("Marlin")))
                stop(StopKind::refused, "this machine does not run GRBL: it says \"" + reply.text +
                                            "\"; accepted: --firmware marlin, or a machine with GRBL");
            break;
        case ReplyKind::grbl_options:
            // One byte less than the buffer is safe, however GRBL counts.
            if (*reply.number > 16)
                settings_.window = std::min(settings_.window, static_cast<std::size_t>(*reply.number) - 1);
            break;
        case ReplyKind::grbl_status:
            machine_status_ = reply.text;
            // At standstill the reset loses no steps.
            if (state_ == State::holding && (reply.text == "Hold:0" || reply.text == "Idle"))
                return reset("held, then reset: its position is kept");
            if (reply.text != "Idle" || bytes_ == 0) {
                idle_since_ = -1;
            } else if (idle_since_ < 0) {
                idle_since_ = now;
            }
            break;
        default:
            break;
    }
}

bool GrblSender::send_next(std::deque<std::string>& lines, bool of_job, double now) {
    if (lines.empty()) return false;
    const std::string& command = lines.front();
    const std::size_t size = command.size() + 1;
    const bool alone = settings_.ping_pong || goes_alone(command);
    if (!sent_.empty() && (alone || sent_.back().alone || bytes_ + size > settings_.window)) return false;
    sent_.push_back({command, size, of_job, alone});
    bytes_ += size;
    machine_.apply(command);
    transmit(command + "\n", now);
    lines.pop_front();
    return true;
}

void GrblSender::feed(double now) {
    if (state_ != State::running) return;
    while (send_next(urgent_, false, now) || (!held_ && send_next(pending_, true, now))) {
    }
    if (!finishing_ || dwelt_ || !pending_.empty() || !urgent_.empty()) return;
    // Is answered when all earlier motion is done.
    urgent_.emplace_back("G4 P0.01");
    dwelt_ = true;
    send_next(urgent_, false, now);
}

void GrblSender::halt(double now) {
    transmit_raw("!", false);
    state_ = State::holding;
    next_status_ = now;
    state_until_ = now + hold_patience;
}

void GrblSender::reset(const char* how) {
    stop(StopKind::halted, std::string("the machine was ") + how);
    transmit_raw("\x18", false);
}

}  // namespace lamella
