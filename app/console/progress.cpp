// Draws the bar and paces the lines.
#include "app/console/progress.h"

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

bool ProgressDisplay::is_due(bool last, double now) {
    if (quiet_ || (!last && now - last_shown_ < (terminal_ ? bar_interval : line_interval))) return false;
    last_shown_ = now;
    return true;
}

void ProgressDisplay::show(const Progress& progress) {
    const double now = seconds();
    if (first_layer_ == 0) first_layer_ = now;
    if (!is_due(progress.done == progress.total, now)) return;
    draw(progress.total > 0 ? static_cast<double>(progress.done) / progress.total : 0,
         progress_text(progress, now));
}

void ProgressDisplay::show(double share) {
    const double now = seconds();
    if (!is_due(share >= 1, now)) return;
    std::string text = fmt::format("{:3.0f} %", std::floor(share * 100));
    if (share > 0.01) text += fmt::format("  {} left", clock_text(now / share - now));
    draw(share, text);
}

void ProgressDisplay::draw(double share, const std::string& text) {
    if (terminal_) {
        const std::string bar(static_cast<std::size_t>(share * bar_width), '#');
        std::fputs(fmt::format("\r[{:.<{}}] {}{}\x1b[K", bar, bar_width, what_, text).c_str(), stderr);
        std::fflush(stderr);
        line_open_ = true;
    } else {
        std::fputs((what_ + text + "\n").c_str(), stderr);
    }
}

void ProgressDisplay::finish() {
    if (line_open_) std::fputs("\n", stderr);
    line_open_ = false;
}

}  // namespace lamella
