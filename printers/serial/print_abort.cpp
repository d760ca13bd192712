// PrintLink: ending a print early.
#include "engine/base/error.h"
#include "printers/serial/print_link.h"

namespace lamella {
namespace {

constexpr double end_waiting_interval = 1;  // s between two requests to end a wait

}  // namespace

void PrintLink::halt_at_once(double now) {
    if (phase_ == Phase::halting) return;
    write_journal(now);
    if (connected_ && sender_->halts_at_once()) {
        sender_->halt(now);
        phase_ = Phase::halting;
        phase_until_ = now + (is_grbl() ? 6.0 : 0.5);
        abort_words_ =
            is_klipper()
                ? "Klipper was halted at once by its emergency stop: heaters and motors are off, and "
                  "it needs FIRMWARE_RESTART before it prints again"
                : "the printer was halted at once (M112): heaters and motors are off, and it has to "
                  "be reset before it prints again";
        return;
    }
    if (!port_.is_open() || !port_.reset_board()) {
        return end(
            std::make_exception_ptr(FaultError("this port cannot reset the board; switch the printer off")));
    }
    end(std::make_exception_ptr(Interrupted(
        "the board was told to reset (DTR), which switches heaters and motors off on most; look whether "
        "it did")));
}

void PrintLink::abort(double now) {
    // GRBL is always stopped by a reset, which switches off a laser or a spindle.
    if (is_grbl() && connected_) return halt_at_once(now);
    // A nozzle that is off the part, or on its way, is not drawn back and lifted once more.
    const bool on_the_way = away_ || (returning_ && sender_->host_lines() > 0);
    if (!on_the_way) left_ = sender_->machine();
    sender_->drop_pending();
    current_ = {};
    current_at_ = 0;
    write_journal(now);
    if (!connected_) {
        return end(std::make_exception_ptr(
            Interrupted("interrupted before the printer was known; nothing was printed")));
    }
    sender_->hold(true);
    phase_ = Phase::aborting;
    phase_until_ = now + 60;
    end_waiting_at_ = now;
    abort_words_ =
        "the printer went on with the moves it had already got, for it cannot be stopped in the midst "
        "of them; then ";
    abort_words_ += is_klipper()
                        ? "its heaters were switched off. Its motors hold until Klipper's idle timeout, "
                          "so that it knows where it is"
                        : "heaters and motors were switched off";
}

void PrintLink::go_on_aborting(double now) {
    const bool late = now >= phase_until_;
    if (phase_ == Phase::halting) {
        // GRBL must stand still before it is reset; Marlin is given time to report its halt.
        const bool gone = sender_->output().empty() && (!is_grbl() || sender_->stopped());
        if (!late && !(is_grbl() && gone)) return;
        if (is_grbl()) abort_words_ = sender_->stopped() ? sender_->stopped()->why : "GRBL is silent";
        return end_aborted();
    }
    if (late && is_klipper() && !sender_->stopped()) {
        // A macro, or a heater, may take longer than a person can be asked to wait.
        halt_at_once(now);
        abort_words_ = "it did not come to an end of what it was doing, so " + abort_words_;
        return;
    }
    if (sender_->stopped() || late) {
        const std::string why = sender_->stopped() ? sender_->stopped()->why : "the printer does not answer";
        return end(std::make_exception_ptr(
            FaultError((refusal_.empty() ? "" : refusal_ + "; ") + "the print was to be stopped, but " + why +
                       "; look after the machine: its heaters may be on. Switch it off, or reset it")));
    }
    // Nobody waits for heat or for a person any more, not even for a line that is still on its way.
    const bool waits = sender_->line_wait() == LineWait::heat || sender_->user_wait();
    if (waits && now >= end_waiting_at_) {
        sender_->end_waiting();
        end_waiting_at_ = now + end_waiting_interval;
    }
    if (!sender_->quiet()) return;
    if (phase_ == Phase::aborting && !is_grbl()) return switch_off();
    end_aborted();
}

/// Parks the nozzle and switches off what is on.
void PrintLink::switch_off() {
    for (std::string& line :
         sender_->machine().leave_from(left_, settings_.park_x, settings_.park_y, settings_.highest))
        sender_->interject(std::move(line));
    // Without its motors Klipper would not know its height any more, and the print could not be resumed.
    for (std::string& line : sender_->machine().switch_off(!is_klipper()))
        sender_->interject(std::move(line));
    if (is_klipper()) sender_->interject("M400");
    sender_->forget_pause();
    phase_ = Phase::switching_off;
}

/// Ends a print that was stopped. One that nobody has stopped has failed.
void PrintLink::end_aborted() {
    if (refusal_.empty()) return end(std::make_exception_ptr(Interrupted(abort_words_)));
    end(std::make_exception_ptr(FaultError(refusal_ + "; " + abort_words_)));
}

}  // namespace lamella
