// MarlinSender: handling of the printer's replies.
#include <algorithm>
#include <utility>

#include "printers/serial/gcode_line.h"
#include "printers/serial/marlin_sender.h"

namespace lamella {
namespace {

constexpr int max_askings = 10;              // resend requests for one line
constexpr std::int64_t believable = 32;      // lines by which the count of oks may be ahead of the printer
constexpr std::int64_t careful_lines = 256;  // after a resend
constexpr double missing_ok = 0.5;           // s to wait for the ok of a resend request, which may not come
constexpr double straggling = 0.05;          // s after which a resend request refers to the repeated line
constexpr double reason_age = 2;             // s for which a printer's word may be why it stops
constexpr double boot_quiet = 0.5;           // s from a board's first word until it is ready

}  // namespace

/// Remembers why the printer may be about to stop: its last word often is only that it has.
void MarlinSender::note_reason(const Reply& reply, double now) {
    // Positions and states are reported between everything else.
    const bool report = reply.text.starts_with("X:") || reply.text.starts_with("S_XYZ");
    const bool tells = reply.kind == ReplyKind::error || (reply.kind == ReplyKind::other && !report);
    if (!tells || reply.text.empty()) return;
    reason_ = reply.text;
    reason_at_ = now;
}

void MarlinSender::handle(const Reply& reply, double now) {
    note_reason(reply, now);
    switch (reply.kind) {
        case ReplyKind::ok:
            on_ok(reply, now);
            break;
        case ReplyKind::resend:
            on_resend(*reply.number, now);
            break;
        case ReplyKind::busy:
        case ReplyKind::heating:
            busy_seen_ = true;
            paused_for_user_ = reply.text.find("paused for") != std::string::npos;
            sign_of_work_ = now;
            tickles_ = 0;
            break;
        case ReplyKind::fatal:
            stop(StopKind::fatal, "the printer has stopped: " +
                                      (now - reason_at_ < reason_age ? reason_ + " / " : std::string()) +
                                      reply.text);
            break;
        case ReplyKind::reset:
            if (state_ == State::running || state_ == State::relinking) {
                stop(StopKind::reset, "the printer was reset (\"" + reply.text + "\"): its position is lost");
            } else {
                state_ = State::greeting;
                state_until_ = now + boot_quiet;
            }
            break;
        case ReplyKind::grbl_banner:
            stop(StopKind::refused, "this machine runs GRBL; pass --firmware grbl");
            break;
        case ReplyKind::action:
            on_action(reply.text);
            break;
        case ReplyKind::capability:
            on_capability(reply.text);
            break;
        case ReplyKind::firmware:
            on_firmware(reply.text);
            break;
        default:
            if (reply.text.starts_with("Marlin ")) on_firmware(reply.text);
            break;
    }
}

void MarlinSender::on_capability(const std::string& text) {
    if (text == "EMERGENCY_PARSER:1") emergency_parser_ = true;
    if (text == "AUTOREPORT_TEMP:1") reports_temperatures_ = true;
}

void MarlinSender::on_firmware(const std::string& text) {
    for (const char* name : {"Marlin", "Prusa", "Klipper", "Repetier"})
        known_firmware_ = known_firmware_ || text.find(name) != std::string::npos;
    if (firmware_.empty()) firmware_ = text.substr(0, text.find(" SOURCE_CODE_URL"));
}

void MarlinSender::on_action(const std::string& text) {
    if (text.starts_with("prompt_")) return on_prompt(text);
    if (listener_.on_action) listener_.on_action(text);
}

/// Handles a prompt, which arrives line by line: prompt_begin TEXT, prompt_button LABEL for each button,
/// prompt_show. Only a person can answer it: Marlin asks whether filament was loaded, or whether to purge
/// more.
void MarlinSender::on_prompt(std::string_view text) {
    const std::string_view word = text.substr(0, text.find(' '));
    const std::string rest(text.substr(std::min(text.size(), word.size() + 1)));
    if (word == "prompt_begin") {
        dialog_ = UserWait{rest};
        dialog_shown_ = false;
        // Marlin does not end the dialogs of M600: they end with the command.
        dialog_line_ = acked_ + 1;
    } else if (word == "prompt_end") {
        dialog_.reset();
    } else if (dialog_ && (word == "prompt_button" || word == "prompt_choice")) {
        dialog_->buttons.push_back(rest);
    } else if (dialog_ && word == "prompt_show") {
        dialog_shown_ = true;
    }
}

void MarlinSender::note_planner(const Reply& reply) {
    if (reply.slots_free) max_slots_free_ = std::max(max_slots_free_, *reply.slots_free);
    if (!reply.planner_free || held_ || acked_ + 1 >= cursor_) return;
    // The planner is empty by rights while the printer heats, homes or is paused: only moves of the job
    // count.
    const std::string word = command_word(sent(acked_ + 1).command);
    const bool moves = word == "G0" || word == "G1" || word == "G2" || word == "G3";
    if (!moves || sent(acked_ + 1).job == (acked_ < base_ ? dropped_job_ : sent(acked_).job)) return;
    max_planner_free_ = std::max(max_planner_free_, *reply.planner_free);
    ++statistics_.advanced;
    if (2 * *reply.planner_free > max_planner_free_) ++statistics_.starved;
}

void MarlinSender::acknowledge(std::int64_t number) {
    acked_ = number;
    answered_job_ = number < base_ ? dropped_job_ : sent(number).job;
    impossible_ = -1;
    if (number >= dialog_line_) dialog_.reset();
}

std::optional<std::int64_t> MarlinSender::marker_answered() const {
    if (tickled_ > acked_ && tickled_ < cursor_) return tickled_;
    for (std::int64_t n = acked_ + 1; n < cursor_; ++n) {
        if (sent(n).marker) return n;
    }
    return std::nullopt;
}

void MarlinSender::on_ok(const Reply& reply, double now) {
    if (state_ == State::syncing) {
        const bool of_resend = std::exchange(swallow_ok_, false);
        of_resend ? sync(now) : probe();
        return;
    }
    if (state_ != State::running && state_ != State::asking) return;
    note_planner(reply);
    if (cursor_ - acked_ == 2 && now - last_start_ < 0.5 * (wire_free_ - last_start_)) real_wire_ = false;
    if (swallow_ok_ && !reply.number && !reply.temperatures) {
        swallow_ok_ = false;
        if (going_back_) go_back_at_ = now + 0.02 + 128 * settings_.byte_time;
        return;
    }
    sign_of_work_ = now;
    tickles_ = 0;
    paused_for_user_ = false;
    if (reply.number && *reply.number < next_) {
        numbers_oks_ = true;
        if (*reply.number > acked_ && *reply.number < cursor_) {
            acknowledge(*reply.number);
        } else {
            ++statistics_.surplus;
        }
        return;
    }
    if (reply.temperatures) {
        tells_temperatures_ = true;
        const auto marker = marker_answered();
        if (!marker) {
            ++statistics_.surplus;
            return;
        }
        // After a timeout this may be the answer to an earlier M105, so it does not count as the end.
        if (*marker == tickled_ && finishing_ && finish_step_ == 3 && barriers_++ < 5) finish_step_ = 2;
        acknowledge(*marker);
        return;
    }
    const bool answers = acked_ + 1 < cursor_ && !(tells_temperatures_ && sent(acked_ + 1).marker);
    if (answers) {
        acknowledge(acked_ + 1);
    } else {
        ++statistics_.surplus;
    }
}

void MarlinSender::on_resend(std::int64_t number, double now) {
    swallow_ok_ = true;
    swallow_until_ = now + missing_ok;
    if (state_ != State::running && state_ != State::asking) return;
    sign_of_work_ = now;
    if (number == cursor_) {
        // Belongs to the same burst, or to a line that is about to be sent anyway.
        if (going_back_) go_back_at_ = now + missing_ok;
        return;
    }
    const bool again = number == asked_ && number < cursor_ && acked_ < number && asked_sent_ >= 0;
    if (again && now - asked_sent_ < straggling) {
        recheck_at_ = now + missing_ok;
        return;
    }
    if (number > next_ || number < base_ || number <= acked_ - believable) {
        on_impossible(number, now);
    } else if (number > cursor_) {
        acknowledge(number - 1);
        cursor_ = number;
        marker_due_ = true;
    } else {
        go_back(number, now);
    }
}

void MarlinSender::go_back(std::int64_t number, double now) {
    asked_times_ = number == asked_ ? asked_times_ + 1 : 1;
    asked_ = number;
    asked_sent_ = -1;
    recheck_at_ = never;
    if (asked_times_ > max_askings) {
        stop(StopKind::lost_count, "the printer has asked " + std::to_string(asked_times_) +
                                       " times for line " + std::to_string(number) + " (" +
                                       sent(number).command + ") and still cannot read it");
        return;
    }
    ++statistics_.resends;
    careful_until_ = next_ + careful_lines;
    if (number <= acked_) acknowledge(number - 1);
    cursor_ = number;
    going_back_ = true;
    go_back_at_ = now + missing_ok;
    marker_due_ = true;
}

void MarlinSender::on_impossible(std::int64_t number, double now) {
    // Noise can produce any number, so the request must be repeated once.
    if (impossible_ != number) {
        impossible_ = number;
        probe_at_ = now + missing_ok;
        return;
    }
    stop(StopKind::lost_count, "the printer asks for line " + std::to_string(number) +
                                   " although it has answered all up to " + std::to_string(acked_) +
                                   " (lines from " + std::to_string(base_) +
                                   " on are kept): it was reset or has lost count");
}

}  // namespace lamella
