// PrintLink: bytes to and from the port, and what happens when it is lost.
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/number_format.h"
#include "printers/serial/print_link.h"

namespace lamella {
namespace {

constexpr double retry_interval = 0.5;  // s

}  // namespace

MachinePort PrintLink::open_port(const std::string& path) const {
    return is_klipper() ? MachinePort::open_socket(path) : MachinePort::open_serial(path, settings_.baud);
}

void PrintLink::read_bytes(double now) {
    if (!port_.is_open()) return reopen(now);
    std::string came;
    const PortOutcome outcome = port_.read(came);
    if (!came.empty()) silent_since_ = -1;
    sender_->receive(came, now);
    if (phase_ != Phase::done && outcome.lost) lose_port(now);
}

void PrintLink::write_bytes(double now) {
    const std::string_view out = sender_->output();
    if (!port_.is_open() || out.empty()) return;
    const PortOutcome outcome = port_.write(out);
    sender_->wrote(outcome.bytes);
    if (outcome.lost) lose_port(now);
}

void PrintLink::lose_port(double now) {
    port_.close();
    ++losses_;
    lost_at_ = now;
    // A port that can be opened but is lost again before the printer was heard is not back.
    if (silent_since_ < 0) silent_since_ = now;
    next_try_ = now + retry_interval;
    sender_->disconnect();
    remark(now, "the port is lost");
}

void PrintLink::reopen(double now) {
    if (phase_ != Phase::printing)
        return end(std::make_exception_ptr(
            FaultError((refusal_.empty() ? "" : refusal_ + "; ") +
                       "the print was to be stopped, but the port is gone; look after the machine: its "
                       "heaters may be on")));
    if (now < next_try_) return;
    next_try_ = now + retry_interval;
    const auto give_up = [&](const std::string& why) {
        if (now - silent_since_ < settings_.reconnect_for) return false;
        end(std::make_exception_ptr(
            FaultError(fmt::format("the port {} was lost and did not come back within {} s ({}){}",
                                   lasting_name_, settings_.reconnect_for, why, where()))));
        return true;
    };
    try {
        port_ = open_port(lasting_name_);
    } catch (const Error& error) {
        give_up(error.what());
        return;
    }
    if (give_up("it opens, but is lost again before the printer is heard")) return;
    const double away = now - lost_at_;
    lost_seconds_ += away;
    if (dry_since_ >= 0) dry_since_ += away;  // the time without a port is no time without a layer
    lost_at_ = -1;
    remark(now, fmt::format("the port is open again after {:.1f} s", away));
    sender_->reconnect(now);
}

void PrintLink::remark(double now, const std::string& text) {
    if (log_) log_->add(now, '#', sender_->unanswered(), text);
}

std::string PrintLink::where() const {
    std::string text = fmt::format("; {} line{} answered", sender_->answered(),
                                   sender_->answered() == 1 ? " was" : "s were");
    if (source_lines_ && source_line_ > 0) text += fmt::format(" (to line {} of the file)", source_line_);
    if (is_grbl()) return text;
    return text + ", the nozzle was sent to Z " + format_number(sender_->machine().z(), 3);
}

}  // namespace lamella
