// Drawing the line and reading the keys.
#include "app/print_view.h"

#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

namespace lamella {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(200);
constexpr double line_interval = 10;  // seconds between two lines in a log

std::string clock_text(double seconds) {
    const auto s = static_cast<std::int64_t>(std::lround(std::min(seconds, 3.6e8)));
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string starved_text(const SenderStatistics& statistics) {
    if (statistics.advanced == 0) return {};
    return fmt::format("  {:.0f} % starved", 100.0 * static_cast<double>(statistics.starved) /
                                                 static_cast<double>(statistics.advanced));
}

/// Keys one by one, without an echo, while it lives; signals stay.
class KeyMode {
  public:
    KeyMode() {
        tcgetattr(STDIN_FILENO, &before_);
        termios mode = before_;
        mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        tcsetattr(STDIN_FILENO, TCSANOW, &mode);
    }
    ~KeyMode() { tcsetattr(STDIN_FILENO, TCSANOW, &before_); }
    KeyMode(const KeyMode&) = delete;
    KeyMode& operator=(const KeyMode&) = delete;

  private:
    termios before_{};
};

}  // namespace

std::string status_text(const LinkStatus& status, int last_layer) {
    std::string text;
    if (status.lost) {
        text += "the port is gone, trying to open it again  ";
    } else if (status.paused) {
        text += "paused  ";
    } else if (status.parked) {
        text += "waiting for a layer  ";
    }
    if (status.layer >= 0) {
        text += last_layer > 0 ? fmt::format("layer {}/{}", status.layer + 1, last_layer)
                               : fmt::format("part {}", status.layer + 1);
        text += "  ";
    }
    const Temperatures& t = status.temperatures;
    text += fmt::format("{} lines  Z {:.2f}  nozzle {:.0f}/{:.0f}  bed {:.0f}/{:.0f}  {} layers ready",
                        status.lines_answered, status.z, t.nozzle, t.nozzle_target, t.bed, t.bed_target,
                        status.layers_ready);
    text += starved_text(status.statistics);
    if (last_layer > 0 && status.layer > 0) {
        const double left = status.seconds / status.layer * (last_layer - status.layer);
        text += "  about " + clock_text(left) + " left";
    }
    return text;
}

std::string summary_text(const LinkStatus& status) {
    const SenderStatistics& s = status.statistics;
    const double rate = status.seconds > 0 ? static_cast<double>(s.lines) / status.seconds : 0;
    return fmt::format(
        "{} lines in {} ({:.1f} lines/s, {} bytes), longest gap {:.1f} s; {} resends, {} lines sent again, "
        "{} "
        "timeouts, {} surplus answers; no layer ready {} times ({:.1f} s){}",
        s.lines, clock_text(status.seconds), rate, s.bytes, s.longest_gap, s.resends, s.repeated, s.timeouts,
        s.surplus, status.underruns, status.underrun_seconds,
        s.advanced > 0 ? ";" + starved_text(s) + " of the time" : "");
}

PrintView::PrintView(std::shared_ptr<PrintLink> link, int last_layer, bool quiet)
    : link_(std::move(link)),
      last_layer_(last_layer),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      keys_(isatty(STDIN_FILENO) != 0),
      thread_([this] { work(); }) {}

PrintView::~PrintView() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    ended_.notify_all();
    thread_.join();
    if (line_open_) std::fputs("\n", stderr);
}

void PrintView::work() {
    std::optional<KeyMode> mode;
    if (keys_) mode.emplace();
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, redraw_interval, [&] { return ending_; })) {
        if (keys_) read_keys();
        if (!quiet_) show(link_->status());
    }
}

void PrintView::read_keys() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    char key = 0;
    while (poll(&input, 1, 0) > 0 && (input.revents & POLLIN) != 0 && read(STDIN_FILENO, &key, 1) == 1) {
        if (key == 'p') link_->pause();
        if (key == 'r') link_->resume();
        if (key == 's') link_->stop();
    }
}

void PrintView::show(const LinkStatus& status) {
    if (!status.connected) return;
    if (!told_) {
        told_ = true;
        std::fputs(
            fmt::format("printer: {}; Ctrl-C {}{}\n",
                        status.firmware.empty() ? "unknown firmware, one line at a time" : status.firmware,
                        status.emergency_parser
                            ? "stops it at once"
                            : "stops it when the moves it has got are done (it has no emergency parser; in "
                              "danger use its reset button)",
                        keys_ ? "; keys: p pause, r resume, s stop" : "")
                .c_str(),
            stderr);
    }
    const std::string text = status_text(status, last_layer_);
    if (terminal_) {
        std::fputs(("\r" + text + "\x1b[K").c_str(), stderr);
        std::fflush(stderr);
        line_open_ = true;
    } else if (status.seconds - last_line_ >= line_interval) {
        last_line_ = status.seconds;
        std::fputs((text + "\n").c_str(), stderr);
    }
}

}  // namespace lamella
