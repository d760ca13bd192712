// Drawing the bar and pacing the lines.
#include "app/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lamella {

namespace {

constexpr double bar_interval = 0.1;  // seconds between two drawings of the bar
constexpr double line_interval = 5;   // seconds between two lines in a log
constexpr int bar_width = 30;

std::string clock_text(double seconds) {
    const int s = static_cast<int>(std::lround(std::min(seconds, 359999.0)));
    if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
    return fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

std::string progress_text(const Progress& progress, double seconds) {
    const double share = progress.total > 0 ? static_cast<double>(progress.done) / progress.total : 1;
    const double rate = seconds > 0 ? progress.done / seconds : 0;
    std::string text = fmt::format("{:3.0f} %  {}/{} layers  {:.1f} layers/s", std::floor(share * 100),
                                   progress.done, progress.total, rate);
    if (rate > 0) text += fmt::format("  {} left", clock_text((progress.total - progress.done) / rate));
    return text;
}

ProgressDisplay::ProgressDisplay(bool quiet, std::string what)
    : quiet_(quiet),
      what_(std::move(what)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

double ProgressDisplay::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ProgressDisplay::show(const Progress& progress) {
    const double now = seconds();
    if (first_layer_ == 0) first_layer_ = now;
    if (quiet_) return;
    const bool last = progress.done == progress.total;
    if (!last && now - last_shown_ < (terminal_ ? bar_interval : line_interval)) return;
    last_shown_ = now;
    const std::string text = what_ + progress_text(progress, now);
    if (terminal_) {
        const int full =
            progress.total > 0 ? static_cast<int>(1LL * progress.done * bar_width / progress.total) : 0;
        const std::string bar(static_cast<std::size_t>(full), '#');
        std::fputs(fmt::format("\r[{:.<{}}] {}\x1b[K", bar, bar_width, text).c_str(), stderr);
        std::fflush(stderr);
        line_open_ = true;
    } else {
        std::fputs((text + "\n").c_str(), stderr);
    }
}

void ProgressDisplay::finish() {
    if (line_open_) std::fputs("\n", stderr);
    line_open_ = false;
}

}  // namespace lamella
