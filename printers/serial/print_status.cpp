// PrintLink: what is told of a print: its journal, its status, its end.
#include <fmt/format.h>

#include "engine/base/error.h"
#include "printers/serial/print_link.h"

namespace lamella {
namespace {

constexpr double status_interval = 0.05;  // s
constexpr double longest_round = 5;       // s; a round that took longer was not printing, but stopped

}  // namespace

void PrintLink::write_journal(double now) {
    journaled_at_ = now;
    journaled_z_ = sender_->machine().z();
    if (!journal_ || resume_.is_null()) return;
    nlohmann::ordered_json text = {{"stamp", stamp_},
                                   {"resume", resume_},
                                   {"lines_answered", sender_->answered()},
                                   {"z", sender_->machine().z()},
                                   {"machine", sender_->machine().to_json()}};
    journal_->write(text.dump() + "\n");
}

/// Adds up the model's time of the answered lines.
void PrintLink::watch_lines(std::int64_t answered) {
    double seconds = 0;
    for (; facts_answered_ < answered && !facts_.empty(); ++facts_answered_, facts_.pop_front()) {
        seconds += static_cast<double>(facts_.front().seconds);
        source_line_ = facts_.front().source;
    }
    if (seconds <= 0) return;
    const std::lock_guard lock(mutex_);
    progress_.done_seconds += seconds;
}

/// Measures the time in which lines of motion are printed.
void PrintLink::measure(double now) {
    const double passed = measured_at_ < 0 ? 0 : now - measured_at_;
    measured_at_ = now;
    const bool prints = phase_ == Phase::printing && started_ && !paused_ && !away_ && port_.is_open() &&
                        sender_->connected() && sender_->unanswered() > 0 &&
                        sender_->line_wait() == LineWait::none && !sender_->user_wait();
    if (!prints || passed > longest_round) return;
    const std::lock_guard lock(mutex_);
    progress_.printing += passed;
}

std::string PrintLink::awaiting() const {
    const std::string remark = sender_->remark();
    const std::string speed = is_klipper() ? "" : fmt::format(", {} baud", settings_.baud);
    return fmt::format("waiting for {} at {}{}{}{}", is_klipper() ? "Klipper" : "the printer", settings_.port,
                       speed, remark.empty() ? "" : "; ", remark);
}

void PrintLink::notify(const std::string& text) {
    const std::lock_guard lock(mutex_);
    status_.notice = text;
    ++status_.notices;
}

void PrintLink::end(std::exception_ptr failure) {
    if (phase_ == Phase::done) return;  // the first reason counts
    phase_ = Phase::done;
    if (log_) log_->close();
    note_status(now(), true);
    {
        const std::lock_guard lock(mutex_);
        done_ = true;
        failure_ = std::move(failure);
    }
    changed_.notify_all();
    port_.close();
}

void PrintLink::note_status(double now, bool at_once) {
    if (!at_once && now - noted_at_ < status_interval) return;
    noted_at_ = now;
    const std::lock_guard lock(mutex_);
    if (connected_ && connected_at_ < 0) connected_at_ = now;
    if (connected_at_ >= 0) status_.seconds = now - connected_at_;
    status_.firmware = sender_->firmware();
    status_.emergency_parser = sender_->halts_at_once();
    status_.connected = connected_;
    status_.paused = paused_;
    status_.parked = parked_;
    status_.stopping = phase_ != Phase::printing;
    status_.waits = sender_->user_wait();
    status_.line_wait = sender_->line_wait();
    if (journal_) status_.journal_trouble = journal_->trouble();
    status_.resumable = journal_ && !resume_.is_null() && status_.journal_trouble.empty();
    if (log_) status_.log_trouble = log_->trouble();
    status_.awaiting = connected_ ? std::string() : awaiting();
    status_.dialect = settings_.dialect;
    status_.bytes_ahead = sender_->bytes_ahead();
    status_.knows_height = sender_->knows_height();
    status_.takes_height = sender_->takes_height();
    status_.lost = lost_at_ >= 0;
    status_.losses = losses_;
    status_.lost_seconds = lost_seconds_ + (lost_at_ >= 0 ? now - lost_at_ : 0);
    status_.layer = layer_;
    status_.lines_queued = queued_lines_;
    status_.lines_answered = sender_->answered();
    status_.layers_ready = queue_.size();
    status_.z = sender_->machine().z();
    status_.temperatures = sender_->temperatures();
    status_.statistics = sender_->statistics();
    status_.progress = progress_;
    status_.underruns = underruns_;
    const double until = lost_at_ >= 0 ? lost_at_ : now;
    status_.underrun_seconds = underrun_seconds_ + (dry_since_ >= 0 ? until - dry_since_ : 0);
}

}  // namespace lamella
