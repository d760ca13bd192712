// Code shared by all dialects: received lines, output bytes, statistics.
#include "printers/serial/line_sender.h"

#include <algorithm>
#include <cmath>

namespace lamella {

int LineSender::baud() const {
    return settings_.byte_time > 0 ? static_cast<int>(std::lround(10 / settings_.byte_time)) : 0;
}

void LineSender::disconnect() {
    lost_ = true;
    forget_wire();
    last_line_ = -1;  // the time without a port is no gap between two lines
    if (!stop_) drop_dialogue();
}

void LineSender::reconnect(double now) {
    lost_ = false;
    forget_wire();
    if (!stop_) take_up_dialogue(now);
}

void LineSender::receive(std::string_view bytes, double now) {
    if (lost_) return;
    if (!bytes.empty()) heard_ = now;
    if (!connected()) first_words_.take(bytes);
    read(bytes, now);
    if (!stop_) feed(now);
}

void LineSender::read(std::string_view bytes, double now) {
    replies_.feed(bytes);
    while (const auto line = replies_.next()) {
        log_received(*line);
        if (stop_) continue;
        const Reply reply = parse_reply(*line);
        if (reply.temperatures) temperatures_ = *reply.temperatures;
        if (const std::string text = message_of(reply); listener_.on_message && !text.empty())
            listener_.on_message(text);
        handle(reply, now);
    }
}

void LineSender::tick(double now) {
    if (stop_ || lost_) return;
    check_time(now);
    if (!stop_) feed(now);
}

void LineSender::wrote(std::size_t bytes) {
    out_at_ += bytes;
    if (out_at_ < out_.size()) return;
    out_.clear();
    out_at_ = 0;
}

void LineSender::log_received(std::string_view line) const {
    if (listener_.on_line) listener_.on_line('<', line, unanswered());
}

void LineSender::log_sent(std::string_view line, double now) {
    ++statistics_.lines;
    if (last_line_ >= 0) statistics_.longest_gap = std::max(statistics_.longest_gap, now - last_line_);
    last_line_ = now;
    if (listener_.on_line) listener_.on_line('>', line, unanswered());
}

void LineSender::put(std::string_view bytes) {
    out_ += bytes;
    statistics_.bytes += static_cast<std::int64_t>(bytes.size());
}

void LineSender::transmit(std::string_view line, double now) {
    put(line);
    log_sent(line.substr(0, line.find('\n')), now);
}

void LineSender::transmit_raw(std::string_view bytes, bool on_own_line) {
    if (lost_) return;
    if (on_own_line && line_cut_) out_ += end_of_line_;
    line_cut_ = false;
    out_ += bytes;
    if (listener_.on_line) listener_.on_line('>', bytes.substr(0, bytes.find(end_of_line_)), unanswered());
}

void LineSender::stop(StopKind kind, std::string why) {
    if (stop_) return;
    stop_ = SenderStop{kind, std::move(why)};
    // Bytes that are not written yet must not be written any more.
    line_cut_ = out_at_ > 0 && out_[out_at_ - 1] != end_of_line_;
    out_.clear();
    out_at_ = 0;
}

/// Discards the bytes that a lost connection has swallowed.
void LineSender::forget_wire() {
    line_cut_ = false;
    out_.clear();
    out_at_ = 0;
    replies_.clear();
}

}  // namespace lamella
