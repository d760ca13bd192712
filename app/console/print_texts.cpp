// Formats the state of a print.
#include "app/console/print_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lamella {
namespace {

std::string hours_text(double seconds) {
    const auto s = static_cast<std::int64_t>(std::lround(std::min(seconds, 3.6e8)));
    return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

/// Returns "1 timeout" or "3 timeouts".
template <typename Count>
std::string count_text(Count count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string starved_text(const SenderStatistics& statistics) {
    if (statistics.advanced == 0) return {};
    return fmt::format("{:.0f} % starved", 100.0 * static_cast<double>(statistics.starved) /
                                               static_cast<double>(statistics.advanced));
}

}  // namespace

std::string hindrance_text(const LinkStatus& status) {
    if (status.lost) return "the port is gone, trying it again";
    if (status.stopping) return "stopping";
    if (status.waits) return "waiting for you";
    if (status.paused) return "paused";
    if (status.line_wait == LineWait::heat) return "heating";
    if (status.parked) return "waiting for a layer";
    if (status.line_wait == LineWait::other) return "homing";
    return {};
}

std::string wait_text(const LinkStatus& status, std::optional<int> process) {
    if (!status.waits) return {};
    std::string text = "the printer waits for you: " + status.waits->text;
    if (process) {
        return text + fmt::format(
                          "; there are no keys here, so answer at the printer, or run kill -USR1 {0} to "
                          "go on or kill -INT {0} to stop",
                          *process);
    }
    text += " (r: done";
    int key = 0;
    for (const std::string& button : status.waits->buttons) text += fmt::format(", {}: {}", ++key, button);
    return text + ")";
}

std::string status_text(const LinkStatus& status, int last_layer, std::size_t columns) {
    std::vector<std::string> fields;
    if (const auto share = status.progress.share())
        fields.push_back(fmt::format("{:3.0f} %", std::floor(100 * std::clamp(*share, 0.0, 1.0))));
    if (const auto left = status.progress.left()) fields.push_back(hours_text(*left) + " left");
    if (std::string hinders = hindrance_text(status); !hinders.empty()) fields.push_back(std::move(hinders));
    if (status.layer >= 0) {
        const int last = last_layer > 0 ? last_layer : status.progress.layers;
        fields.push_back(fmt::format("{} {}/{}", last_layer > 0 ? "layer" : "part", status.layer + 1, last));
    }
    if (status.dialect != Dialect::grbl) {
        const Temperatures& t = status.temperatures;
        fields.push_back(fmt::format("nozzle {:.0f}/{:.0f}", t.nozzle, t.nozzle_target));
        fields.push_back(fmt::format("bed {:.0f}/{:.0f}", t.bed, t.bed_target));
        fields.push_back(fmt::format("Z {:.2f}", status.z));
    }
    fields.push_back(count_text(status.lines_answered, "line"));
    fields.push_back(count_text(status.layers_ready, last_layer > 0 ? "layer" : "part") + " ready");
    fields.push_back(starved_text(status.statistics));
    std::string text;
    for (const std::string& field : fields) {
        if (field.empty()) continue;
        const std::size_t gap = text.empty() ? 0 : 2;
        if (text.size() + gap + field.size() > columns) break;
        text += std::string(gap, ' ') + field;
    }
    return text;
}

std::string greeting_text(const LinkStatus& status, bool keys) {
    const std::string name = !status.firmware.empty()          ? status.firmware
                             : status.dialect == Dialect::grbl ? "GRBL"
                                                               : "unknown firmware";
    const bool klipper = status.dialect == Dialect::klipper;
    const std::string ahead = klipper ? "one script at a time"
                              : status.bytes_ahead == 0
                                  ? "one line at a time"
                                  : fmt::format("up to {} bytes ahead", status.bytes_ahead);
    const char* stops = klipper ? "stops it after the moves it has got, with its heaters off"
                        : status.emergency_parser
                            ? "stops it at once"
                            : "stops it when the moves it has got are done (it has no emergency parser; in "
                              "danger press x or its reset button)";
    return fmt::format("printer: {}, {}; Ctrl-C {}{}", name, ahead, stops,
                       keys ? "; keys: p pause, r resume, s stop, x halt at once" : "");
}

std::string summary_text(const LinkStatus& status) {
    const SenderStatistics& s = status.statistics;
    const double rate = status.seconds > 0 ? static_cast<double>(s.lines) / status.seconds : 0;
    std::string text = fmt::format(
        "{} in {} ({:.1f} lines/s, {}), longest gap {:.1f} s; {}, {} sent again, {}, {}; no layer ready {} "
        "({:.1f} s)",
        count_text(s.lines, "line"), hours_text(status.seconds), rate, count_text(s.bytes, "byte"),
        s.longest_gap, count_text(s.resends, "resend"), count_text(s.repeated, "line"),
        count_text(s.timeouts, "timeout"), count_text(s.surplus, "surplus answer"),
        count_text(status.underruns, "time"), status.underrun_seconds);
    if (status.losses > 0)
        text +=
            fmt::format("; port lost {} ({:.1f} s)", count_text(status.losses, "time"), status.lost_seconds);
    if (s.advanced > 0) text += "; " + starved_text(s) + " of the time";
    return text;
}

}  // namespace lamella
