// Polling: hosts differ in what they push, and all of them answer questions.
#include "hosts/watch_print.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "hosts/wait.h"

namespace lamella {

HostStatus watch_print(NetworkHost& host, const WatchSettings& settings) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point heard = Clock::now();
    bool troubled = false;
    for (;;) {
        try {
            HostStatus status = host.status();
            heard = Clock::now();
            troubled = false;
            if (settings.on_status) settings.on_status(status);
            if (!is_active(status.state) && status.state != PrintState::busy) return status;
        } catch (const HostError& error) {
            const double silent = std::chrono::duration<double>(Clock::now() - heard).count();
            if (error.failure() == HostFailure::refused || silent > settings.patience) throw;
            if (!troubled && settings.on_trouble) settings.on_trouble(error.what());
            troubled = true;
        }
        wait_for(settings.interval, settings.cancel);
    }
}

std::string status_text(const HostStatus& status) {
    std::string text = status.file.empty() ? "" : status.file + ": ";
    text += state_word(status.state);
    if (status.progress && is_active(status.state)) text += fmt::format(", {:.0f} %", *status.progress * 100);
    if (status.layer && is_active(status.state)) {
        text += fmt::format(", layer {}", *status.layer);
        if (status.layers) text += fmt::format(" of {}", *status.layers);
    }
    if (status.left && is_active(status.state)) {
        const auto minutes = std::llround(*status.left / 60);
        text += fmt::format(", {}:{:02} h left", minutes / 60, minutes % 60);
    }
    for (const HostHeater& heater : status.heaters) {
        text += fmt::format(", {} {:.0f}", heater.name, heater.now);
        if (heater.target > 0) text += fmt::format(" of {:.0f}", heater.target);
        text += " C";
    }
    if (!status.message.empty()) text += ": " + status.message;
    return text;
}

nlohmann::ordered_json status_json(const HostStatus& status) {
    nlohmann::ordered_json json{{"state", state_word(status.state)}, {"file", status.file}};
    if (status.progress) json["progress"] = *status.progress;
    if (status.layer) json["layer"] = *status.layer;
    if (status.layers) json["layers"] = *status.layers;
    if (status.elapsed) json["elapsed_s"] = *status.elapsed;
    if (status.left) json["left_s"] = *status.left;
    for (const HostHeater& heater : status.heaters)
        json["heaters"].push_back({{"name", heater.name}, {"now", heater.now}, {"target", heater.target}});
    if (!status.message.empty()) json["message"] = status.message;
    return json;
}

}  // namespace lamella
