// Draws the status line and reads the keys.
#include "app/console/print_view.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

namespace lamella {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(200);
constexpr double log_interval = 10;  // seconds between two lines in a log

std::string hours_text(double seconds) {
    const auto s = static_cast<std::int64_t>(std::lround(std::min(seconds, 3.6e8)));
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string starved_text(const SenderStatistics& statistics) {
    if (statistics.advanced == 0) return {};
    return fmt::format("  {:.0f} % starved", 100.0 * static_cast<double>(statistics.starved) /
                                                 static_cast<double>(statistics.advanced));
}

/// While it lives, the terminal delivers keys one by one without echo; signals still work.
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

/// Truncates a line to the terminal's width: a longer one would wrap, and the next be drawn below it.
std::string fitting(const std::string& text) {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return text;
    return text.substr(0, size.ws_col - 1U);
}

}  // namespace

std::string wait_text(const LinkStatus& status) {
    if (!status.waits) return {};
    std::string text = "the printer waits for you: " + status.waits->text + " (r: done";
    int key = 0;
    for (const std::string& button : status.waits->buttons) text += fmt::format(", {}: {}", ++key, button);
    return text + ")";
}

std::string status_text(const LinkStatus& status, int last_layer) {
    std::string text;
    if (status.lost) {
        text += "the port is gone, trying to open it again  ";
    } else if (status.stopping) {
        text += "stopping  ";
    } else if (status.waits) {
        text += "waiting for you  ";
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
        text += "  about " + hours_text(left) + " left";
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
        s.lines, hours_text(status.seconds), rate, s.bytes, s.longest_gap, s.resends, s.repeated, s.timeouts,
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

void PrintView::close() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    ended_.notify_all();
    if (thread_.joinable()) thread_.join();
    if (line_open_) std::fputs("\n", stderr);
    line_open_ = false;
}

void PrintView::show_message(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (!quiet_) write_line(text);
}

void PrintView::work() {
    std::optional<KeyMode> mode;
    if (keys_) mode.emplace();
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, redraw_interval, [&] { return ending_; })) {
        if (mode) read_keys();
        const LinkStatus status = link_->status();
        // A second Ctrl-C ends the process at once: the terminal must be restored before.
        if (status.stopping) mode.reset();
        tell_trouble(status);
        if (!quiet_) show(status);
    }
}

void PrintView::read_keys() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    char key = 0;
    while (poll(&input, 1, 0) > 0 && (input.revents & POLLIN) != 0 && read(STDIN_FILENO, &key, 1) == 1) {
        if (key == 'p') link_->pause();
        if (key == 'r') link_->resume();
        if (key == 's') link_->stop();
        if (key == 'x') link_->halt();
        if ('1' <= key && key <= '9') link_->choose(static_cast<std::size_t>(key - '1'));
    }
}

void PrintView::write_line(const std::string& text) {
    std::fputs(((line_open_ ? "\r\x1b[K" : "") + text + "\n").c_str(), stderr);
    line_open_ = false;
}

/// Prints what needs the user's attention, even when quiet.
void PrintView::tell_trouble(const LinkStatus& status) {
    if (const std::string text = wait_text(status); text != told_wait_) {
        told_wait_ = text;
        if (!text.empty()) write_line(text);
    }
    if (status.journal_trouble != told_trouble_) {
        told_trouble_ = status.journal_trouble;
        if (!told_trouble_.empty())
            write_line("the journal cannot be written, --resume will not go on from here: " + told_trouble_);
    }
}

void PrintView::greet(const LinkStatus& status) {
    const char* stops = status.emergency_parser
                            ? "stops it at once"
                            : "stops it when the moves it has got are done (it has no emergency parser; in "
                              "danger press x or its reset button)";
    write_line(fmt::format("printer: {}; Ctrl-C {}{}",
                           status.firmware.empty() ? "unknown firmware, one line at a time" : status.firmware,
                           stops, keys_ ? "; keys: p pause, r resume, s stop, x halt at once" : ""));
}

void PrintView::show(const LinkStatus& status) {
    if (!status.connected) return;
    if (!std::exchange(greeted_, true)) greet(status);
    const std::string text = status_text(status, last_layer_);
    if (terminal_) {
        std::fputs(("\r" + fitting(text) + "\x1b[K").c_str(), stderr);
        std::fflush(stderr);
        line_open_ = true;
    } else if (status.seconds - last_line_ >= log_interval) {
        last_line_ = status.seconds;
        std::fputs((text + "\n").c_str(), stderr);
    }
}

}  // namespace lamella
