// Draws the status line and reads the keys.
#include "app/console/print_view.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <utility>

#include "app/console/interrupt.h"
#include "app/console/print_texts.h"

namespace lamella {
namespace {

constexpr auto redraw_interval = std::chrono::milliseconds(200);
constexpr double log_interval = 10;  // seconds between two lines in a log

/// Returns true if the terminal at standard input gives its keys to this process. One in the background that
/// reads them or changes the terminal's mode would be stopped.
bool has_keys() { return isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) == getpgrp(); }

/// While it lives, the terminal delivers keys one by one without echo; signals still work.
class KeyMode {
  public:
    KeyMode() {
        tcgetattr(STDIN_FILENO, &before_);
        set();
    }
    ~KeyMode() {
        if (has_keys()) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
    }
    /// Sets the mode once more: a shell that continues a stopped process has set its own.
    void set() {
        termios mode = before_;
        mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        tcsetattr(STDIN_FILENO, TCSANOW, &mode);
    }
    KeyMode(const KeyMode&) = delete;
    KeyMode& operator=(const KeyMode&) = delete;

  private:
    termios before_{};
};

/// Returns the characters that fit on a line: a longer one would wrap, and the next be drawn below it.
std::size_t columns() {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 2) return any_width;
    return size.ws_col - 1U;
}

}  // namespace

PrintView::PrintView(std::shared_ptr<PrintLink> link, int last_layer, bool quiet)
    : link_(std::move(link)),
      last_layer_(last_layer),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      keys_(has_keys()),
      thread_([this] { work(); }) {}

void PrintView::close() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    ended_.notify_all();
    if (thread_.joinable()) thread_.join();
    // What became known between the last look and the end is told, too.
    if (!gone_) tell_trouble(link_->status());
    if (line_open_) std::fputs("\n", stderr);
    line_open_ = false;
}

void PrintView::show_message(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (!quiet_) write_line(text);
}

void PrintView::work() {
    std::optional<KeyMode> mode;
    std::unique_lock lock(mutex_);
    while (!ended_.wait_for(lock, redraw_interval, [&] { return ending_; })) {
        const bool continued = TerminalGuard::take_continue();
        watch_signals();
        if (gone_) continue;
        const LinkStatus status = link_->status();
        keys_ = has_keys();
        // A second Ctrl-C ends the process at once: the terminal must be restored before.
        if (!keys_ || status.stopping) {
            mode.reset();
        } else if (!mode) {
            mode.emplace();
        } else if (continued) {
            mode->set();
        }
        if (mode) read_keys();
        tell_trouble(status);
        if (!quiet_) show(status);
    }
}

void PrintView::watch_signals() {
    if (TerminalGuard::take_user()) link_->resume();
    // A view that goes into a file goes on.
    if (TerminalGuard::hung_up()) gone_ = terminal_;
    if (TerminalGuard::take_stop() && !gone_)
        write_line(
            "Ctrl-Z does not stop a print: a hot nozzle would rest on the part; p pauses it, s stops it");
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

/// Prints a text when it has changed.
void PrintView::tell_once(const std::string& text, std::string& told) {
    if (text == told) return;
    told = text;
    if (!text.empty()) write_line(text);
}

/// Prints what needs the user's attention, even when quiet.
void PrintView::tell_trouble(const LinkStatus& status) {
    tell_once(wait_text(status, keys_ ? std::nullopt : std::optional<int>(getpid())), told_wait_);
    const auto named = [](const char* what, const std::string& why) {
        return why.empty() ? std::string() : what + why;
    };
    tell_once(
        named("the journal cannot be written, --resume will not go on from here: ", status.journal_trouble),
        told_journal_);
    tell_once(named("the log is not complete, the print goes on: ", status.log_trouble), told_log_);
    if (status.notices != told_notices_ && !status.notice.empty()) write_line(status.notice);
    told_notices_ = status.notices;
}

void PrintView::show(const LinkStatus& status) {
    tell_once(status.awaiting, told_awaiting_);
    if (!status.connected) return;
    if (!std::exchange(greeted_, true)) write_line(greeting_text(status, keys_));
    if (terminal_) {
        std::fputs(("\r" + status_text(status, last_layer_, columns()) + "\x1b[K").c_str(), stderr);
        std::fflush(stderr);
        line_open_ = true;
    } else if (status.seconds - last_line_ >= log_interval) {
        last_line_ = status.seconds;
        std::fputs((status_text(status, last_layer_) + "\n").c_str(), stderr);
    }
}

}  // namespace lamella
